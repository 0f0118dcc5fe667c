#include "scarp/mesh/grid.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "scarp/base/error.hpp"
#include "scarp/mesh/build.hpp"

namespace scarp {
namespace {

template <int Dim>
void check(const Vec<Dim>& origin, const Vec<Dim>& size, const std::array<int, Dim>& elements,
           std::int64_t nodes_each) {
  // Local nodes of all elements are counted by int.
  const std::int64_t most_elements = std::min<std::int64_t>(most_grid_elements, 2'000'000'000 / nodes_each);
  std::int64_t total = 1;
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
    total *= elements[k];
    if (total > most_elements)
      throw InputError(fmt::format("the grid may have at most {} elements", most_elements),
                       fmt::format("{}", fmt::join(elements, " x ")), "use larger elements");
  }
}

/// Calls f with each place of a lattice of so many along each axis, x fastest.
template <int Dim, class F>
void for_lattice(const std::array<int, Dim>& counts, F&& f) {
  std::array<int, Dim> at{};
  while (true) {
    f(at);
    int k = 0;
    while (++at[k] == counts[k]) {
      at[k] = 0;
      if (++k == Dim) return;
    }
  }
}

/// Place of function i along an axis, in elements from the origin: a line, or the mean of two inner knots (Greville).
double place_along(GridFunctions functions, int n, int i) {
  return functions == GridFunctions::b_spline ? std::clamp(i - 0.5, 0.0, static_cast<double>(n)) : i;
}

/// The first function that element `at` touches along an axis, beyond the grid if negative, and how many.
struct Touched {
  int first, count;
};
Touched touched_along(GridFunctions functions, int at) {
  switch (functions) {
    case GridFunctions::gimp:
      return {at - 1, 4};
    case GridFunctions::b_spline:
      return {at, 3};
    default:
      return {at, 2};
  }
}

/// Adds the local nodes of element `at`, x fastest; those of linear functions in the order of their element type.
template <int Dim>
void add_local_nodes(const Grid<Dim>& grid, const std::array<int, Dim>& lines, const std::array<int, Dim>& at,
                     std::vector<int>& connectivity) {
  std::array<Touched, Dim> touched;
  std::array<int, Dim> counts;
  for (int k = 0; k < Dim; ++k) {
    touched[k] = touched_along(grid.functions, at[k]);
    counts[k] = touched[k].count;
  }
  const auto first = connectivity.size();
  for_lattice<Dim>(counts, [&](const std::array<int, Dim>& i) {
    int node = 0;
    for (int k = Dim - 1; k >= 0; --k) node = node * lines[k] + std::clamp(touched[k].first + i[k], 0, lines[k] - 1);
    connectivity.push_back(node);
  });
  if (grid.functions != GridFunctions::linear) return;
  for (auto face = first; face < connectivity.size(); face += 4)
    std::swap(connectivity[face + 2], connectivity[face + 3]);
}

/// The functions at the ends of open knots are narrower than the others. With lumped mass the largest eigenvalue of a
/// free end is 5.4 c²/h² (1.5 between inner cells, 4 with linear functions; docs/theory.md), and the size of the
/// elements there is what has the same critical time step in a linear mesh.
template <int Dim>
void shorten_side_elements(Mesh<Dim>& mesh) {
  const double shorter = std::sqrt(4 / 5.4);
  for (int e = 0; e < mesh.element_count(); ++e) {
    const auto at = mesh.grid->cell(e);
    bool at_side = false;
    for (int k = 0; k < Dim; ++k) at_side = at_side || at[k] == 0 || at[k] + 1 == mesh.grid->elements[k];
    if (at_side) mesh.size[e] *= shorter;
  }
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
  std::size_t nodes_each = 1;
  for (int k = 0; k < Dim; ++k) nodes_each *= static_cast<std::size_t>(local_functions_along(functions));
  check<Dim>(origin, size, elements, static_cast<std::int64_t>(nodes_each));
  std::array<int, Dim> lines;  // of nodes along each axis
  std::size_t element_count = 1, node_count = 1;
  Mesh<Dim> mesh;
  mesh.grid = Grid<Dim>{origin, {}, elements, functions, {}};
  for (int k = 0; k < Dim; ++k) {
    lines[k] = functions_along(functions, elements[k]);
    mesh.grid->spacing[k] = size[k] / elements[k];
    mesh.grid->per_spacing[k] = 1 / mesh.grid->spacing[k];
    element_count *= elements[k];
    node_count *= lines[k];
  }
  mesh.nodes.reserve(node_count);
  for_lattice<Dim>(lines, [&](const std::array<int, Dim>& at) {
    // i * size / n, not i * spacing: the last line then lies on the box's side to the last bit.
    Vec<Dim> x;
    for (int k = 0; k < Dim; ++k) x[k] = origin[k] + place_along(functions, elements[k], at[k]) * size[k] / elements[k];
    mesh.nodes.push_back(x);
  });
  mesh.types.assign(element_count, Dim == 2 ? ElementType::Q4 : ElementType::H8);
  mesh.offsets.reserve(element_count + 1);
  mesh.offsets.push_back(0);
  mesh.connectivity.reserve(element_count * nodes_each);
  for_lattice<Dim>(elements, [&](const std::array<int, Dim>& at) {
    add_local_nodes<Dim>(*mesh.grid, lines, at, mesh.connectivity);
    mesh.offsets.push_back(static_cast<int>(mesh.connectivity.size()));
  });
  complete(mesh);
  if (functions == GridFunctions::b_spline) shorten_side_elements(mesh);
  return mesh;
}

template Mesh<2> make_grid<2>(const Vec<2>&, const Vec<2>&, const std::array<int, 2>&, GridFunctions);
template Mesh<3> make_grid<3>(const Vec<3>&, const Vec<3>&, const std::array<int, 3>&, GridFunctions);

}  // namespace scarp
