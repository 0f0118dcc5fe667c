#include "scarp/mesh/grid.hpp"

#include <fmt/format.h>

#include <fmt/ranges.h>
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "scarp/base/error.hpp"
#include "scarp/mesh/build.hpp"

namespace scarp {
namespace {

/// The numbers of elements and of nodes, which are ints.
struct Counts {
  int elements, nodes;
};

template <int Dim>
Counts checked_counts(const Vec<Dim>& origin, const Vec<Dim>& size, const std::array<int, Dim>& elements,
                      GridFunctions functions) {
  std::int64_t element_count = 1, node_count = 1;
  for (int k = 0; k < Dim; ++k) {
    const char axis = "xyz"[k];
    if (!std::isfinite(origin[k]))
      throw InputError(fmt::format("the grid's origin must be finite in {}", axis), fmt::format("{}", origin[k]),
                       "give a number");
    if (!(size[k] > 0) || !std::isfinite(size[k]))
      throw InputError(fmt::format("the grid's size in {} must be positive and finite", axis),
                       fmt::format("{}", size[k]), "give the length of the mesh in metres");
    if (elements[k] < 1)
      throw InputError(fmt::format("the grid needs at least one element in {}", axis), fmt::format("{}", elements[k]),
                       "give a whole number from 1");
    const double spacing = size[k] / elements[k];
    if (!(std::abs(origin[k]) + size[k] < 1e12 * spacing))
      throw InputError(fmt::format("the grid's elements are too small beside its coordinates in {}", axis),
                       fmt::format("elements of {} m at coordinates up to {} m", spacing, origin[k] + size[k]),
                       "use fewer elements or an origin nearer to zero");
    element_count *= elements[k];
    node_count *= functions_along(functions, elements[k]);
    if (std::max(element_count, node_count) > most_grid_numbers)
      throw InputError(
          fmt::format("the grid may have at most {} elements and as many nodes, which are numbered in 32 bits",
                      most_grid_numbers),
          fmt::format("{} elements", fmt::join(elements, " x ")),
          "take larger elements, or a grid that ends nearer to the soil");
  }
  return {static_cast<int>(element_count), static_cast<int>(node_count)};
}

/// Place of function i along an axis, in elements from the origin: a line, or the mean of two inner knots (Greville).
double place_along(GridFunctions functions, int n, int i) {
  return functions == GridFunctions::b_spline ? std::clamp(i - 0.5, 0.0, static_cast<double>(n)) : i;
}

/// The nodes on the first or last line across an axis, ascending.
template <int Dim>
std::vector<int> side_of(const Grid<Dim>& grid, int axis, bool last) {
  std::array<int, Dim> line{}, end;
  for (int k = 0; k < Dim; ++k) end[k] = static_cast<int>(grid.lines[k].size());
  if (last) line[axis] = end[axis] - 1;
  end[axis] = line[axis] + 1;
  const int first = line[axis];
  std::vector<int> nodes;
  nodes.reserve(static_cast<std::size_t>(grid.node_count) / grid.lines[axis].size());
  while (true) {
    nodes.push_back(grid.node_at(line));
    int k = 0;
    while (++line[k] >= end[k]) {
      line[k] = k == axis ? first : 0;
      if (++k == Dim) return nodes;
    }
  }
}

template <int Dim>
void add_sides(Mesh<Dim>& mesh) {
  for (const auto& [name, axis, last] : sides_of_box<Dim>) mesh.node_sets[name] = side_of(*mesh.grid, axis, last);
}

}  // namespace

int functions_along(GridFunctions functions, int n) {
  return functions == GridFunctions::b_spline ? n + 2 : n + 1;
}
int local_functions_along(GridFunctions functions) {
  return touched_along(functions, 0).count;
}

template <int Dim>
Mesh<Dim> make_grid(const std::type_identity_t<Vec<Dim>>& origin, const std::type_identity_t<Vec<Dim>>& size,
                    const std::type_identity_t<std::array<int, Dim>>& elements, GridFunctions functions) {
  const Counts counts = checked_counts<Dim>(origin, size, elements, functions);
  Mesh<Dim> mesh;
  auto& grid = mesh.grid.emplace();
  grid.origin = origin;
  grid.elements = elements;
  grid.functions = functions;
  grid.element_count = counts.elements;
  grid.node_count = counts.nodes;
  for (int k = 0; k < Dim; ++k) {
    const int lines = functions_along(functions, elements[k]);
    grid.spacing[k] = size[k] / elements[k];
    grid.per_spacing[k] = 1 / grid.spacing[k];
    grid.lines[k].reserve(lines);
    // i * size / n, not i * spacing: the last line then lies on the box's side to the last bit.
    for (int i = 0; i < lines; ++i)
      grid.lines[k].push_back(origin[k] + place_along(functions, elements[k], i) * size[k] / elements[k]);
    if (k + 1 == Dim) break;
    grid.by_elements[k] = WholeDivision(elements[k]);
    grid.by_lines[k] = WholeDivision(lines);
  }
  add_sides(mesh);
  return mesh;
}

template Mesh<2> make_grid<2>(const Vec<2>&, const Vec<2>&, const std::array<int, 2>&, GridFunctions);
template Mesh<3> make_grid<3>(const Vec<3>&, const Vec<3>&, const std::array<int, 3>&, GridFunctions);

}  // namespace scarp
