#include "scarp/mesh/grid.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>

#include "scarp/base/error.hpp"
#include "scarp/mesh/build.hpp"

namespace scarp {
namespace {

// Each element has up to 8 around it, and those are counted by int.
constexpr std::int64_t most_elements = 200'000'000;

void check(const Vec<2>& origin, const Vec<2>& size, const std::array<int, 2>& elements) {
  for (int k = 0; k < 2; ++k) {
    const char axis = "xy"[k];
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
  }
  const std::int64_t total = std::int64_t{elements[0]} * elements[1];
  if (total > most_elements)
    throw InputError(fmt::format("the grid may have at most {} elements", most_elements), fmt::format("{}", total),
                     "use larger elements");
}

}  // namespace

Mesh<2> make_grid(const Vec<2>& origin, const Vec<2>& size, const std::array<int, 2>& elements) {
  check(origin, size, elements);
  const auto [nx, ny] = elements;
  Mesh<2> mesh;
  mesh.grid = Grid<2>{origin, {size[0] / nx, size[1] / ny}, elements};
  mesh.nodes.reserve((std::size_t{1} + nx) * (std::size_t{1} + ny));
  // i * size / nx, not i * spacing: the last line then lies on the box's side to the last bit.
  for (int j = 0; j <= ny; ++j)
    for (int i = 0; i <= nx; ++i) mesh.nodes.push_back({origin[0] + i * size[0] / nx, origin[1] + j * size[1] / ny});
  mesh.offsets.push_back(0);
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i) {
      const int n = j * (nx + 1) + i;
      mesh.types.push_back(ElementType::Q4);
      mesh.connectivity.insert(mesh.connectivity.end(), {n, n + 1, n + nx + 2, n + nx + 1});
      mesh.offsets.push_back(static_cast<int>(mesh.connectivity.size()));
    }
  complete(mesh);
  return mesh;
}

}  // namespace scarp
