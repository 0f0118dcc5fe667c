#include "scarp/run/memory_need.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "scarp/base/error.hpp"
#include "scarp/base/memory.hpp"
#include "scarp/mesh/grid.hpp"
#include "scarp/step/body.hpp"

namespace scarp::run {
namespace {

/// Of the arrays of points without their state; gradients of velocity are those of an affine scheme.
template <int Dim>
double bytes_of_point(bool affine) {
  double bytes = 0;
  const Points<Dim> none;
  Points<Dim>::each(none, [&](const PointArray& info, const auto& member) {
    if (info.kind == PointKind::matrix && !affine) return;
    detail::for_each_in(
        member, [&]<class Array>(const Array&) { bytes += static_cast<double>(sizeof(typename Array::value_type)); });
  });
  return bytes;
}

/// Of the lines of a grid, and of the nodes of its sides: their numbers, and pages of what is fixed there. A side is
/// pieces of nodes that follow each other.
template <std::size_t Dim>
double of_lines_and_sides(const std::array<double, Dim>& lines, double nodes) {
  constexpr double page = 4096;
  double bytes = 0, piece = 1;
  for (const double count : lines) {
    const double on_side = nodes / count, pages = std::min(nodes / page, on_side / piece * (1 + piece / page));
    bytes += count * sizeof(double) + 2 * (on_side * sizeof(int) + pages * page);
    piece *= count;
  }
  return bytes;
}

}  // namespace

template <int Dim>
double expected_points(const input::RegionInputOf<Dim>& region) {
  return volume(region.shape()) / std::pow(region.spacing, Dim);
}

template <int Dim>
MemoryNeed memory_need(const input::CaseOf<Dim>& input) {
  MemoryNeed need;
  if (input.mesh.grid) {
    double elements = 1, nodes = 1;
    Vec<Dim> lines;
    for (int k = 0; k < Dim; ++k) {
      lines[k] = functions_along(input.method.shape, input.mesh.grid->elements[k]);
      elements *= input.mesh.grid->elements[k];
      nodes *= lines[k];
    }
    if (std::max(elements, nodes) > most_grid_numbers) return need;  // make_grid() will say so
    need.grid = of_lines_and_sides(lines, nodes);
    // What an entry for each element or node is kept of costs memory where there is soil or a condition:
    // ActiveElements::slot, Buffers::changed and is_changed; Conditions, Assembly::latest_.
    need.addresses = elements * (2 * sizeof(int) + 1) + nodes * (2 + 2 * sizeof(double) + 2 * sizeof(int));
  }
  constexpr double of_element = Dim == 2 ? 150 : 250;  // a point's part of what a step keeps for elements, and of lists
  const double of_arrays = bytes_of_point<Dim>(input.method.scheme == input::SchemeName::apic);
  for (const auto& region : input.regions) {
    const int columns = std::visit([](const auto& m) { return state_columns<sym_size<Dim>>(m); },
                                   input.materials[region.material].model);
    const double of_state = of_arrays + static_cast<double>(sizeof(double)) * columns;
    need.points += expected_points(region) * (of_state + of_element);
    need.checkpoint += expected_points(region) * of_state;
  }
  return need;
}

template <int Dim>
void check_memory(const input::CaseOf<Dim>& input) {
  const auto need = memory_need(input);
  const auto free = free_memory();
  const double memory = need.grid + need.points + need.checkpoint, addresses = memory + need.addresses;
  if (memory <= free.memory && addresses <= free.addresses) return;
  double count = 0;
  for (const auto& region : input.regions) count += expected_points(region);
  const bool is_grid = need.grid + need.addresses > need.points;
  const std::string what =
      memory > free.memory
          ? fmt::format("{} (grid {}, about {:.3g} points {}, the copy that is a checkpoint {}), where {} are free",
                        as_bytes(memory), as_bytes(need.grid), count, as_bytes(need.points), as_bytes(need.checkpoint),
                        as_bytes(free.memory))
          : fmt::format("{} of address space, where a limit of this shell or job (ulimit -v) leaves {}",
                        as_bytes(addresses), as_bytes(free.addresses));
  throw InputError(is_grid ? "the grid does not fit into memory" : "the points do not fit into memory", what,
                   is_grid ? "take larger elements, or a grid that ends nearer to the soil"
                           : "take a larger spacing, or a smaller region",
                   is_grid ? input.mesh.position : input.regions.front().position);
}

template double expected_points<2>(const input::RegionInputOf<2>&);
template double expected_points<3>(const input::RegionInputOf<3>&);
template MemoryNeed memory_need<2>(const input::CaseOf<2>&);
template MemoryNeed memory_need<3>(const input::CaseOf<3>&);
template void check_memory<2>(const input::CaseOf<2>&);
template void check_memory<3>(const input::CaseOf<3>&);

}  // namespace scarp::run
