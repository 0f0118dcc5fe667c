#include "scarp/step/node_rates.hpp"

#include <algorithm>
#include <array>

#include "scarp/exec/parallel.hpp"
#include "scarp/mesh/with_basis.hpp"
#include "scarp/step/element.hpp"
#include "scarp/step/phases.hpp"
#include "scarp/transfer/transfer.hpp"

namespace scarp::step {
namespace {

/// f(basis, slot, element, its cell) for all active elements, in the chunks of the assembly.
template <int Dim, class F>
void for_each_element(Body<Dim>& body, VelocityField<Dim>& field, StepBooks<Dim>& books, F&& f) {
  exec::sum_over_chunks(field.active.size(), field.assembly.chunk(), field.buffers.books, books,
                        [&](int first, int last, StepBooks<Dim>&) {
                          clear_places(field, first, field.buffers.momentum, 1);
                          with_basis<Dim>(*body.mesh, field.active.element.data(), first, last,
                                          [&]<class Basis>(Basis basis, int slot, int e) {
                                            f(basis, slot, typename Basis::Cell(*body.mesh, e));
                                          });
                        });
}

/// Ω̂ |B_i|² of an element, of its mean gradients.
template <class Basis>
void add_stiffness(const typename Basis::Cell& cell, double volume, const int* place, double* nodes) {
  const transfer::Means<Basis> means(cell);
  std::array<double, transfer::nodal_size<Basis>> B, B2{};
  for (const auto& component : means.gradient) {
    transfer::store_nodal<Basis>(component, B.data());
    for (int i = 0; i < Basis::nodes; ++i) B2[i] += B[i] * B[i];
  }
  for (int i = 0; i < Basis::nodes; ++i) nodes[place[i]] += volume * B2[i];
}

/// The largest value of a nodal field at the points of an element.
template <class Basis>
double largest_at_points(const VelocityField<Basis::dim>& field, const typename Basis::Cell& cell, int slot,
                         const transfer::NodeRows<Basis>& rows) {
  using T = PointBatch<Basis::dim>;
  const transfer::Field<Basis, 1, transfer::Rows::just> of_nodes(cell, rows);
  double largest = 0;
  for (const auto& block : field.blocks) {
    for_each_batch_of_element<T>(points_of(block, slot), [&](const auto& p, int) {
      const T value = of_nodes.at(transfer::local_coordinates<Basis>(cell, block.points, p)).value(0);
      for (int l = 0; l < p.count(); ++l) largest = std::max(largest, value.get(static_cast<std::size_t>(l)));
    });
  }
  return largest;
}

}  // namespace

template <int Dim>
void bound_by_nodes(Body<Dim>& body, VelocityField<Dim>& field, StepBooks<Dim>& books) {
  auto& buffers = field.buffers;
  buffers.bounds.age = 0;
  for_each_element(body, field, books, [&]<class Basis>(Basis, int slot, const typename Basis::Cell& cell) {
    add_stiffness<Basis>(cell, buffers.bounds.filled[slot], field.assembly.places_of(slot), buffers.momentum.data());
  });
  exec::sum_over_chunks(
      field.assembly.size(), node_chunk, buffers.books, books, [&](int first, int last, StepBooks<Dim>&) {
        for (int k = first; k < last; ++k) {
          buffers.bounds.stiffness[k] = 0.5 * gathered<1>(field, k, buffers.momentum)[0] * field.nodes.node[k].per_mass;
        }
      });
  exec::sum_over_chunks(
      field.active.size(), element_chunk, buffers.books, books, [&](int first, int last, StepBooks<Dim>&) {
        with_basis<Dim>(*body.mesh, field.active.element.data(), first, last, [&]<class Basis>(Basis, int slot, int e) {
          if constexpr (is_simplex<Basis>) {
            const int* k = field.assembly.nodes_of(slot);
            transfer::NodeRows<Basis> rows;
            for (int i = 0; i < Basis::nodes; ++i) rows[i] = &buffers.bounds.stiffness[k[i]];
            const typename Basis::Cell cell(*body.mesh, e);
            buffers.bounds.least_per_mass[slot] = largest_at_points<Basis>(field, cell, slot, rows);
          }
        });
      });
}

template void bound_by_nodes<2>(Body<2>&, VelocityField<2>&, StepBooks<2>&);
template void bound_by_nodes<3>(Body<3>&, VelocityField<3>&, StepBooks<3>&);

}  // namespace scarp::step
