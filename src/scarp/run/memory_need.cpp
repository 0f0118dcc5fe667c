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

}  // namespace

template <int Dim>
double expected_points(const input::RegionInputOf<Dim>& region) {
  return volume(region.shape()) / std::pow(region.spacing, Dim);
}

template <int Dim>
MemoryNeed memory_need(const input::CaseOf<Dim>& input) {
  MemoryNeed need;
  if (input.mesh.grid) {
    const auto functions = input.method.shape;
    double elements = 1, nodes = 1, local = 1;
    for (int k = 0; k < Dim; ++k) {
      elements *= input.mesh.grid->elements[k];
      nodes *= functions_along(functions, input.mesh.grid->elements[k]);
      local *= local_functions_along(functions);
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
  constexpr double of_element = Dim == 2 ? 150 : 250;  // a point's part of what a step keeps for elements, and of lists
  const double of_point = bytes_of_point<Dim>(input.method.scheme == input::SchemeName::apic) + of_element;
  for (const auto& region : input.regions) {
    const int columns = std::visit([](const auto& m) { return state_columns<sym_size<Dim>>(m); },
                                   input.materials[region.material].model);
    need.points += expected_points(region) * (of_point + static_cast<double>(sizeof(double)) * columns);
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

template double expected_points<2>(const input::RegionInputOf<2>&);
template double expected_points<3>(const input::RegionInputOf<3>&);
template MemoryNeed memory_need<2>(const input::CaseOf<2>&);
template MemoryNeed memory_need<3>(const input::CaseOf<3>&);
template void check_memory<2>(const input::CaseOf<2>&);
template void check_memory<3>(const input::CaseOf<3>&);

}  // namespace scarp::run
