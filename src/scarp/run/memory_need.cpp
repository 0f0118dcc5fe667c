#include "scarp/run/memory_need.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

#include "scarp/base/error.hpp"
#include "scarp/base/memory.hpp"
#include "scarp/mesh/grid.hpp"
#include "scarp/step/body.hpp"

namespace scarp::run {
namespace {

/// Nodes along an axis, and local nodes of an element along it.
struct AlongAxis {
  int more, local;
};
AlongAxis along_axis(GridFunctions functions) {
  switch (functions) {
    case GridFunctions::gimp:
      return {1, 4};
    case GridFunctions::b_spline:
      return {2, 3};
    default:
      return {1, 2};
  }
}

}  // namespace

template <int Dim>
MemoryNeed memory_need(const input::CaseOf<Dim>& input) {
  MemoryNeed need;
  if (input.mesh.grid) {
    const auto along = along_axis(input.method.shape);
    double elements = 1, nodes = 1, local = 1;
    for (int k = 0; k < Dim; ++k) {
      elements *= input.mesh.grid->elements[k];
      nodes *= input.mesh.grid->elements[k] + along.more;
      local *= along.local;
    }
    if (elements > most_grid_elements) elements = nodes = 0;  // make_grid() will say so
    // Mesh: types, offsets, connectivity, size; ActiveElements::slot, Buffers::is_changed. Mesh::nodes, and of
    // Conditions what is fixed and which way walls look.
    const double bytes = sizeof(ElementType) + (1 + local + 1) * sizeof(int) + sizeof(double) + 1;
    const double of_node = sizeof(Vec<Dim>) + 2;
    need.grid = elements * bytes + nodes * of_node;
    need.addresses = nodes * static_cast<double>(sizeof(Node<Dim>) + sizeof(transfer::Motion<Dim>) +
                                                 2 * sizeof(Vec<Dim>) + sizeof(Resistance<Dim>) + 4 * sizeof(double));
  }
  // Points: mass, volumes, eps_q, four vectors, σ and σ*, whole numbers; of their elements what a step keeps, and
  // lists.
  constexpr double of_points = 4 + 4 * Dim + 2 * sym_size<Dim> + 2, of_element = Dim == 2 ? 150 : 250;
  for (const auto& region : input.regions) {
    const double count = volume(region.shape()) / std::pow(region.spacing, Dim);
    const int columns = std::visit([](const auto& m) { return state_columns<sym_size<Dim>>(m); },
                                   input.materials[region.material].model);
    need.points += count * (sizeof(double) * (of_points + columns) + of_element);
  }
  return need;
}

template <int Dim>
void check_memory(const input::CaseOf<Dim>& input) {
  const auto need = memory_need(input);
  const auto free = free_memory();
  const double memory = need.grid + need.points, addresses = memory + need.addresses;
  if (memory <= free.memory && addresses <= free.addresses) return;
  const bool is_grid = need.grid + need.addresses > need.points;
  const std::string what =
      memory > free.memory
          ? fmt::format("{} (grid {}, points {}), where {} are free", as_bytes(memory), as_bytes(need.grid),
                        as_bytes(need.points), as_bytes(free.memory))
          : fmt::format("{} of address space, where a limit of this shell or job (ulimit -v) leaves {}",
                        as_bytes(addresses), as_bytes(free.addresses));
  throw InputError(is_grid ? "the grid does not fit into memory" : "the points do not fit into memory", what,
                   is_grid ? "take larger elements, or a grid that ends nearer to the soil"
                           : "take a larger spacing, or a smaller region",
                   is_grid ? input.mesh.position : input.regions.front().position);
}

template MemoryNeed memory_need<2>(const input::CaseOf<2>&);
template MemoryNeed memory_need<3>(const input::CaseOf<3>&);
template void check_memory<2>(const input::CaseOf<2>&);
template void check_memory<3>(const input::CaseOf<3>&);

}  // namespace scarp::run
