// The nodes and elements of a part of a mesh: of a grid found without looking at the others.
#pragma once

#include <algorithm>
#include <limits>
#include <span>

#include "scarp/mesh/mesh.hpp"

namespace scarp {

namespace detail {

/// f(number along each axis) for those from first to last, x fastest; nothing where a last is below its first.
template <int Dim, class F>
void for_range(const std::array<int, Dim>& first, const std::array<int, Dim>& last, F&& f) {
  for (int k = 0; k < Dim; ++k)
    if (last[k] < first[k]) return;
  std::array<int, Dim> at = first;
  while (true) {
    f(at);
    int k = 0;
    while (++at[k] > last[k]) {
      at[k] = first[k];
      if (++k == Dim) return;
    }
  }
}

}  // namespace detail

/// f(n, where it is) for the nodes in a closed box, ascending.
template <int Dim, class F>
void for_nodes_in(const Mesh<Dim>& mesh, const BoxOf<Dim>& box, F&& f) {
  if (mesh.grid) {
    std::array<int, Dim> first, last;
    for (int k = 0; k < Dim; ++k) {
      const auto& lines = mesh.grid->lines[k];
      first[k] = static_cast<int>(std::lower_bound(lines.begin(), lines.end(), box.low[k]) - lines.begin());
      last[k] = static_cast<int>(std::upper_bound(lines.begin(), lines.end(), box.high[k]) - lines.begin()) - 1;
    }
    detail::for_range<Dim>(first, last,
                           [&](const auto& line) { f(mesh.grid->node_at(line), mesh.grid->crossing(line)); });
    return;
  }
  for (int n = 0; n < mesh.node_count(); ++n) {
    const Vec<Dim>& x = mesh.lists.nodes[n];
    bool inside = true;
    for (int k = 0; k < Dim; ++k) inside = inside && x[k] >= box.low[k] && x[k] <= box.high[k];
    if (inside) f(n, x);
  }
}

/// f(e), ascending, for all elements that touch the box or have a node in it, and for others.
template <int Dim, class F>
void for_elements_near(const Mesh<Dim>& mesh, const BoxOf<Dim>& box, F&& f) {
  if (!mesh.grid) {
    for (int e = 0; e < mesh.element_count(); ++e) f(e);
    return;
  }
  const auto& grid = *mesh.grid;
  std::array<int, Dim> first, last;
  for (int k = 0; k < Dim; ++k) {
    // A node is no further from its elements than two cells: a control point, or a line before a cell of GIMP.
    const double from = (box.low[k] - grid.origin[k]) * grid.per_spacing[k] - 3;
    const double to = (box.high[k] - grid.origin[k]) * grid.per_spacing[k] + 3;
    const auto end = static_cast<double>(grid.elements[k] - 1);
    first[k] = static_cast<int>(std::clamp(from, 0.0, end));
    last[k] = static_cast<int>(std::clamp(to, 0.0, end));
  }
  detail::for_range<Dim>(first, last, [&](const auto& at) { f(grid.element_at(at)); });
}

/// The box around some nodes.
template <int Dim>
BoxOf<Dim> box_around(const Mesh<Dim>& mesh, std::span<const int> nodes) {
  BoxOf<Dim> box;
  box.low.fill(std::numeric_limits<double>::infinity());
  box.high.fill(-std::numeric_limits<double>::infinity());
  for (const int n : nodes) {
    const Vec<Dim> x = mesh.node(n);
    for (int k = 0; k < Dim; ++k) {
      box.low[k] = std::min(box.low[k], x[k]);
      box.high[k] = std::max(box.high[k], x[k]);
    }
  }
  return box;
}

}  // namespace scarp
