// Structured grids: all that is known of their elements and nodes follows from numbers.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "scarp/base/numbers.hpp"
#include "scarp/base/vec.hpp"
#include "scarp/base/whole_division.hpp"

namespace scarp {

enum class ElementType : std::uint8_t { T3, Q4, T4, H8 };

/// The local nodes of an element: at most the 4^Dim of a cell of GIMP.
template <int Dim>
using ElementNodes = Numbers<Dim == 2 ? 16 : 64>;

/// The elements around one, ascending: at most 3^Dim - 1 of a grid.
template <int Dim>
using ElementsAround = Numbers<(Dim == 2 ? 9 : 27) - 1>;

/// The shape functions of a grid (mesh/grid_bases.hpp).
enum class GridFunctions : std::uint8_t { linear, gimp, b_spline };

/// Functions along an axis that element `at` touches: the first, which is beyond the grid if negative, and how many.
struct Touched {
  int first, count;
};
constexpr Touched touched_along(GridFunctions functions, int at) {
  switch (functions) {
    case GridFunctions::gimp:
      return {at - 1, 4};
    case GridFunctions::b_spline:
      return {at, 3};
    default:
      return {at, 2};
  }
}

/// A structured grid of equal rectangles or boxes (make_grid makes it), elements and nodes numbered x fastest, then y
/// (, then z). Nodes are those of its functions, which need not be corners of elements: each lies where a line of nodes
/// along each axis crosses the others. Nothing is kept for each element or node.
template <int Dim>
struct Grid {
  Vec<Dim> origin{};
  Vec<Dim> spacing{};
  std::array<int, Dim> elements{};
  GridFunctions functions = GridFunctions::linear;
  Vec<Dim> per_spacing{};                                    ///< 1 / spacing
  std::array<std::vector<double>, Dim> lines;                ///< of nodes: their places along each axis, ascending [m]
  std::array<WholeDivision, Dim - 1> by_elements, by_lines;  ///< by the numbers of both along x (and y)
  int element_count = 0, node_count = 0;

  /// Place of element e along each axis.
  std::array<int, Dim> cell(int e) const {
    std::array<int, Dim> at;
    for (int k = 0; k + 1 < Dim; ++k) {
      const int rest = by_elements[k](e);
      at[k] = e - rest * elements[k];
      e = rest;
    }
    at[Dim - 1] = e;
    return at;
  }

  /// The element at a place.
  int element_at(const std::array<int, Dim>& at) const {
    int e = 0;
    for (int k = Dim - 1; k >= 0; --k) e = e * elements[k] + at[k];
    return e;
  }

  /// Number of the node on a line along each axis.
  int node_at(const std::array<int, Dim>& line) const {
    int n = 0;
    for (int k = Dim - 1; k >= 0; --k) n = n * static_cast<int>(lines[k].size()) + line[k];
    return n;
  }

  /// Where node n is.
  Vec<Dim> node(int n) const {
    Vec<Dim> x;
    for (int k = 0; k + 1 < Dim; ++k) {
      const int rest = by_lines[k](n);
      x[k] = lines[k][n - rest * static_cast<int>(lines[k].size())];
      n = rest;
    }
    x[Dim - 1] = lines[Dim - 1][n];
    return x;
  }

  /// Where the node on a line along each axis is.
  Vec<Dim> crossing(const std::array<int, Dim>& line) const {
    Vec<Dim> x;
    for (int k = 0; k < Dim; ++k) x[k] = lines[k][line[k]];
    return x;
  }

  /// f(line along each axis) for the local nodes of element e in their order: x fastest, those of linear functions as
  /// their element type has them. A line beyond the grid is that on its side.
  template <class F>
  void for_local_nodes(int e, F&& f) const {
    const std::array<int, Dim> at = cell(e);
    const int each = touched_along(functions, 0).count, count = Dim == 2 ? each * each : each * each * each;
    for (int i = 0; i < count; ++i) {
      // Linear functions go round each face of four.
      int rest = functions == GridFunctions::linear ? i ^ (i >> 1 & 1) : i;
      std::array<int, Dim> line;
      for (int k = 0; k < Dim; ++k) {
        const int first = touched_along(functions, at[k]).first, last = static_cast<int>(lines[k].size()) - 1;
        line[k] = std::clamp(first + rest % each, 0, last);
        rest /= each;
      }
      f(line);
    }
  }

  ElementNodes<Dim> element_nodes(int e) const {
    ElementNodes<Dim> nodes;
    for_local_nodes(e, [&](const std::array<int, Dim>& line) { nodes.add(node_at(line)); });
    return nodes;
  }

  /// Mesh::size_of.
  double size_of(int e) const;

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

namespace detail {

/// The least height of a rectangle, or of a box, of these edges: its measure over that of its largest side. Rounded as
/// element_size() does it with the same corners.
inline double least_height(const Vec<2>& edge) {
  return edge[0] * edge[1] / std::max(edge[0], edge[1]);
}
inline double least_height(const Vec<3>& edge) {
  const auto& [a, b, c] = edge;
  const double bc = b * c, ca = c * a, ab = a * b;
  return std::min(a * bc, b * ca) / std::max({bc, ca, ab});
}

}  // namespace detail

template <int Dim>
double Grid<Dim>::size_of(int e) const {
  const std::array<int, Dim> at = cell(e);
  if (functions == GridFunctions::linear) {
    Vec<Dim> edge;
    for (int k = 0; k < Dim; ++k) edge[k] = lines[k][at[k] + 1] - lines[k][at[k]];
    return detail::least_height(edge);
  }
  const double size = *std::min_element(spacing.begin(), spacing.end());
  if (functions == GridFunctions::gimp) return size;
  bool at_side = false;
  for (int k = 0; k < Dim; ++k) at_side = at_side || at[k] == 0 || at[k] + 1 == elements[k];
  // The functions at the ends of open knots are narrower than the others. With lumped mass the largest eigenvalue of a
  // free end is 5.4 c²/h² (1.5 between inner cells, 4 with linear functions; docs/theory.md), and the size of the
  // elements there is what has the same critical time step in a linear mesh: √(4 / 5.4).
  constexpr double shorter = 0.8606629658238704;
  return at_side ? size * shorter : size;
}

}  // namespace scarp
