#include "scarp/mesh/grid.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>

#include "scarp/base/error.hpp"
#include "scarp/mesh/build.hpp"

namespace scarp {
namespace {

// Each element has up to 8 nodes, and those are counted by int.
constexpr std::int64_t most_elements = 200'000'000;

template <int Dim>
void check(const Vec<Dim>& origin, const Vec<Dim>& size, const std::array<int, Dim>& elements) {
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

/// What to add to the number of an element's first node for each of its nodes.
template <int Dim>
std::array<int, (1 << Dim)> corner_offsets(const std::array<int, Dim>& lines) {
  std::array<int, (1 << Dim)> offsets{0, 1, lines[0] + 1, lines[0]};
  if constexpr (Dim == 3)
    for (int i = 0; i < 4; ++i) offsets[i + 4] = offsets[i] + lines[0] * lines[1];
  return offsets;
}

}  // namespace

template <int Dim>
Mesh<Dim> make_grid(const std::type_identity_t<Vec<Dim>>& origin, const std::type_identity_t<Vec<Dim>>& size,
                    const std::type_identity_t<std::array<int, Dim>>& elements) {
  check<Dim>(origin, size, elements);
  std::array<int, Dim> lines;  // of nodes along each axis
  std::size_t element_count = 1, node_count = 1;
  Mesh<Dim> mesh;
  mesh.grid = Grid<Dim>{origin, {}, elements, {}};
  for (int k = 0; k < Dim; ++k) {
    lines[k] = elements[k] + 1;
    mesh.grid->spacing[k] = size[k] / elements[k];
    mesh.grid->per_spacing[k] = 1 / mesh.grid->spacing[k];
    element_count *= elements[k];
    node_count *= lines[k];
  }
  mesh.nodes.reserve(node_count);
  for_lattice<Dim>(lines, [&](const std::array<int, Dim>& at) {
    // i * size / n, not i * spacing: the last line then lies on the box's side to the last bit.
    Vec<Dim> x;
    for (int k = 0; k < Dim; ++k) x[k] = origin[k] + at[k] * size[k] / elements[k];
    mesh.nodes.push_back(x);
  });
  constexpr int nodes_each = 1 << Dim;
  const std::array<int, nodes_each> offsets = corner_offsets<Dim>(lines);
  mesh.types.assign(element_count, Dim == 2 ? ElementType::Q4 : ElementType::H8);
  mesh.offsets.reserve(element_count + 1);
  mesh.offsets.push_back(0);
  mesh.connectivity.reserve(element_count * nodes_each);
  for_lattice<Dim>(elements, [&](const std::array<int, Dim>& at) {
    int first = 0;
    for (int k = Dim - 1; k >= 0; --k) first = first * lines[k] + at[k];
    for (int offset : offsets) mesh.connectivity.push_back(first + offset);
    mesh.offsets.push_back(static_cast<int>(mesh.connectivity.size()));
  });
  complete(mesh);
  return mesh;
}

template Mesh<2> make_grid<2>(const Vec<2>&, const Vec<2>&, const std::array<int, 2>&);
template Mesh<3> make_grid<3>(const Vec<3>&, const Vec<3>&, const std::array<int, 3>&);

}  // namespace scarp
