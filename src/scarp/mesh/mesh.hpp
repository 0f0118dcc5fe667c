// Background mesh: nodes, elements of several types, and what the step asks of them.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "scarp/base/vec.hpp"

namespace scarp {

enum class ElementType : std::uint8_t { T3, Q4 };

/// A structured grid of equal rectangles, elements and nodes numbered x fastest.
template <int Dim>
struct Grid {
  Vec<Dim> origin{};
  Vec<Dim> spacing{};
  std::array<int, Dim> elements{};
};

/// A finite element mesh as plain arrays. Local nodes run anticlockwise.
template <int Dim>
struct Mesh {
  std::vector<Vec<Dim>> nodes;
  std::vector<ElementType> types;  ///< one per element
  std::vector<int> offsets;        ///< elements + 1; local nodes of e are connectivity[offsets[e] ... offsets[e+1])
  std::vector<int> connectivity;
  std::vector<double> size;         ///< one per element: its least height [m], for the critical time step
  std::vector<int> around_offsets;  ///< elements + 1; elements that share a node with e (e itself not) ...
  std::vector<int> around;          ///< ... ascending
  std::map<std::string, std::vector<int>> node_sets;  ///< ascending; "left" "right" "bottom" "top" and named groups
  std::optional<Grid<Dim>> grid;                      ///< set when the mesh is a structured grid

  int element_count() const { return static_cast<int>(types.size()); }
  int node_count() const { return static_cast<int>(nodes.size()); }
  std::span<const int> element_nodes(int e) const {
    return {connectivity.data() + offsets[e], static_cast<std::size_t>(offsets[e + 1] - offsets[e])};
  }
  std::span<const int> elements_around(int e) const {
    return {around.data() + around_offsets[e], static_cast<std::size_t>(around_offsets[e + 1] - around_offsets[e])};
  }
};

}  // namespace scarp
