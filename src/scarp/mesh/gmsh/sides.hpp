// The edges (in space: faces) of elements, by their nodes.
#pragma once

#include <algorithm>
#include <array>
#include <compare>
#include <span>
#include <vector>

#include "scarp/mesh/shapes.hpp"

namespace scarp::gmsh {

/// An edge or face of an element, from its lowest node on and then towards the lower of the two beside that; the last
/// entries are -1 when it has less than four.
struct Side {
  std::array<int, 4> nodes;
  bool backwards;  ///< the element goes round it the other way
  int element;

  auto operator<=>(const Side&) const = default;

  template <std::size_t Count>
  Side(const std::array<int, Count>& local, std::span<const int> of, int e) : nodes{-1, -1, -1, -1}, element(e) {
    for (std::size_t i = 0; i < Count; ++i) nodes[i] = of[local[i]];
    const auto end = nodes.begin() + Count;
    const auto lowest = std::min_element(nodes.begin(), end);
    if constexpr (Count == 2) {
      backwards = lowest != nodes.begin();
      if (backwards) std::swap(nodes[0], nodes[1]);
    } else {
      std::rotate(nodes.begin(), lowest, end);
      backwards = nodes[Count - 1] < nodes[1];
      if (backwards) std::reverse(nodes.begin() + 1, end);
    }
  }

  bool same_place(const Side& other) const { return nodes == other.nodes; }
  int count() const { return nodes[2] < 0 ? 2 : nodes[3] < 0 ? 3 : 4; }
};

/// All sides, those at the same place one after the other.
template <int Dim>
std::vector<Side> sorted_sides(const Mesh<Dim>& mesh) {
  std::vector<Side> sides;
  sides.reserve(mesh.lists.connectivity.size());
  for (int e = 0; e < mesh.element_count(); ++e)
    with_shape<Dim>(mesh.type_of(e), [&]<class Shape>(Shape) {
      for (const auto& side : Shape::sides) sides.emplace_back(side, mesh.element_nodes(e), e);
    });
  std::sort(sides.begin(), sides.end());
  return sides;
}

/// Is side i of the sorted ones that of one element only?
inline bool is_outer(const std::vector<Side>& sides, std::size_t i) {
  return !(i > 0 && sides[i].same_place(sides[i - 1])) && !(i + 1 < sides.size() && sides[i].same_place(sides[i + 1]));
}

}  // namespace scarp::gmsh
