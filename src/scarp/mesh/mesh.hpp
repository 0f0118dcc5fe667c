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

enum class ElementType : std::uint8_t { T3, Q4, T4, H8 };

/// The elements around one, ascending: a range of ints that may be copied and kept as long as its mesh.
template <int Dim>
class ElementsAround {
 public:
  /// Those of a list that outlives this.
  explicit ElementsAround(std::span<const int> list) : list_(list.data()), size_(static_cast<int>(list.size())) {}
  /// None yet; at most the 3^Dim - 1 of a grid may be added.
  ElementsAround() = default;
  void add(int e) { own_[size_++] = e; }

  const int* begin() const { return list_ ? list_ : own_.data(); }
  const int* end() const { return begin() + size_; }
  int size() const { return size_; }

 private:
  const int* list_ = nullptr;
  int size_ = 0;
  std::array<int, (Dim == 2 ? 9 : 27) - 1> own_;  // set up to size_ only
};

/// The shape functions of a grid (mesh/grid_bases.hpp).
enum class GridFunctions : std::uint8_t { linear, gimp, b_spline };

/// A structured grid of equal rectangles or boxes, elements and nodes numbered x fastest, then y (, then z). The
/// geometry is here; the nodes of its mesh are those of its functions, which need not be corners of elements.
template <int Dim>
struct Grid {
  Vec<Dim> origin{};
  Vec<Dim> spacing{};
  std::array<int, Dim> elements{};
  GridFunctions functions = GridFunctions::linear;
  Vec<Dim> per_spacing{};  ///< 1 / spacing

  /// Place of element e along each axis.
  std::array<int, Dim> cell(int e) const {
    std::array<int, Dim> at;
    for (int k = 0; k + 1 < Dim; ++k) {
      at[k] = e % elements[k];
      e /= elements[k];
    }
    at[Dim - 1] = e;
    return at;
  }

  /// The elements that share a corner with e, from its place alone.
  ElementsAround<Dim> around(int e) const {
    const std::array<int, Dim> at = cell(e);
    const int left = at[0] > 0 ? -1 : 0, right = at[0] + 1 < elements[0] ? 1 : 0;
    ElementsAround<Dim> all;
    constexpr int rows = Dim == 2 ? 3 : 9;  // along x, in ascending order
    for (int row = 0; row < rows; ++row) {
      bool within = true;
      int middle = e, stride = elements[0], digits = row;
      for (int k = 1; k < Dim; ++k) {
        const int step = digits % 3 - 1;
        within = within && at[k] + step >= 0 && at[k] + step < elements[k];
        middle += step * stride;
        stride *= elements[k];
        digits /= 3;
      }
      if (!within) continue;
      for (int other = middle + left; other <= middle + right; ++other)
        if (other != e) all.add(other);
    }
    return all;
  }
};

/// A finite element mesh as plain arrays. Local nodes run anticlockwise in the plane; in space as Gmsh and VTK have
/// them, so that det dx/dxi is positive. Those of a grid with other functions than linear ones: see grid_bases.hpp.
template <int Dim>
struct Mesh {
  std::vector<Vec<Dim>> nodes;     ///< what carries the shape functions: corners of elements, or control points
  std::vector<ElementType> types;  ///< one per element
  std::vector<int> offsets;        ///< elements + 1; local nodes of e are connectivity[offsets[e] ... offsets[e+1])
  std::vector<int> connectivity;
  std::vector<double> size;  ///< one per element, for the critical time step: least height, or less (make_grid) [m]
  std::vector<int> around_offsets;  ///< elements + 1; elements that share a node with e (e itself not) ...
  std::vector<int> around;          ///< ... ascending. Both empty in a grid, where they follow from the index
  std::map<std::string, std::vector<int>> node_sets;  ///< ascending; the sides (add_side_sets) and named groups
  std::optional<Grid<Dim>> grid;                      ///< set when the mesh is a structured grid
  bool axisymmetric = false;  ///< the plane is the meridian plane of a body of revolution: x is the distance from its
                              ///< vertical axis, and volumes, masses and forces are those of one radian

  int element_count() const { return static_cast<int>(types.size()); }
  int node_count() const { return static_cast<int>(nodes.size()); }
  std::span<const int> element_nodes(int e) const {
    return {connectivity.data() + offsets[e], static_cast<std::size_t>(offsets[e + 1] - offsets[e])};
  }
  /// The elements that share a corner with e, ascending, e itself not.
  ElementsAround<Dim> elements_around(int e) const {
    if (grid) return grid->around(e);
    return ElementsAround<Dim>(
        {around.data() + around_offsets[e], static_cast<std::size_t>(around_offsets[e + 1] - around_offsets[e])});
  }
};

}  // namespace scarp
