#include "scarp/step/node_rates.hpp"

#include <algorithm>
#include <array>

#include "scarp/step/chunks.hpp"
#include "scarp/step/element.hpp"
#include "scarp/step/phases.hpp"
#include "scarp/transfer/means.hpp"
#include "scarp/transfer/simd/fields.hpp"

namespace scarp::step {
namespace {

/// Ω̂ |B_i|² of an element, of its mean gradients.
template <class Basis>
void add_stiffness(const typename Basis::Cell& cell, double volume, const int* accumulator, double* nodes) {
  const transfer::Means<Basis> means(cell);
  std::array<double, transfer::nodal_size<Basis>> B, B2{};
  for (const auto& component : means.gradient) {
    transfer::store_nodal<Basis>(component, B.data());
    for (int i = 0; i < Basis::nodes; ++i) B2[i] += B[i] * B[i];
  }
  for (int i = 0; i < Basis::nodes; ++i) nodes[accumulator[i]] += volume * B2[i];
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
void bound_by_nodes(Body<Dim>& body, VelocityField<Dim>& field, Bounded which) {
  auto& momentum = field.buffers.momentum;
  auto& bounds = field.buffers.bounds;
  if (which == Bounded::all) bounds.age = 0;
  for_each_chunk(field, [&](const exec::Chunk& chunk) {
    clear_accumulators(chunk, momentum, 1);
    for_each_element(body, field, chunk, [&]<class Basis>(Basis, int slot, int e) {
      const typename Basis::Cell cell(*body.mesh, e);
      add_stiffness<Basis>(cell, bounds.filled[slot], field.assembly.accumulators_of(slot), momentum.data());
    });
  });
  gather<1>(field, momentum);
  for_each_chunk(field, [&](const exec::Chunk& chunk) {
    for (int k = chunk.nodes.first; k < chunk.nodes.last; ++k)
      bounds.stiffness[k] = 0.5 * gathered<1>(field, k, momentum)[0] * field.nodes.node[k].per_mass;
  });
  for_each_chunk(field, [&](const exec::Chunk& chunk) {
    for_each_element(body, field, chunk, [&]<class Basis>(Basis, int slot, int e) {
      if constexpr (is_simplex<Basis>) {
        if (which == Bounded::due && !bounds.is_due[e]) return;
        const int* k = field.assembly.nodes_of(slot);
        transfer::NodeRows<Basis> rows;
        for (int i = 0; i < Basis::nodes; ++i) rows[i] = &bounds.stiffness[k[i]];
        const typename Basis::Cell cell(*body.mesh, e);
        bounds.least_per_mass[e] = largest_at_points<Basis>(field, cell, slot, rows);
      }
    });
  });
  for (const int e : bounds.due) bounds.is_due[e] = 0;
  bounds.due.clear();
}

template <int Dim>
void bound_by_nodes_when_due(Body<Dim>& body, VelocityField<Dim>& field) {
  auto& bounds = field.buffers.bounds;
  if (++bounds.age >= bounds.every) {
    bound_by_nodes(body, field, Bounded::all);
  } else if (!bounds.due.empty()) {
    bound_by_nodes(body, field, Bounded::due);
  }
}

template void bound_by_nodes<2>(Body<2>&, VelocityField<2>&, Bounded);
template void bound_by_nodes<3>(Body<3>&, VelocityField<3>&, Bounded);
template void bound_by_nodes_when_due<2>(Body<2>&, VelocityField<2>&);
template void bound_by_nodes_when_due<3>(Body<3>&, VelocityField<3>&);

}  // namespace scarp::step
