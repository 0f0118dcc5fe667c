// What several sweeps over elements ask of one. Not for use outside step/.
#pragma once

#include <algorithm>

#include "scarp/mesh/with_basis.hpp"
#include "scarp/step/body.hpp"

namespace scarp::step {

template <int Dim>
PointRange points_of(const Block<Dim>& block, int slot) {
  return {block.order.data() + block.begin[slot], block.begin[slot + 1] - block.begin[slot]};
}

/// The points of a chunk.
template <int Dim>
PointRange points_of(const Block<Dim>& block, const exec::Chunk& chunk) {
  const int first = block.begin[chunk.slots.first];
  return {block.order.data() + first, block.begin[chunk.slots.last] - first};
}

/// Zero in the accumulators of a chunk, n numbers each.
inline void clear_accumulators(const exec::Chunk& chunk, Column& numbers, int n) {
  std::fill(numbers.begin() + static_cast<std::ptrdiff_t>(chunk.accumulators.first) * n,
            numbers.begin() + static_cast<std::ptrdiff_t>(chunk.accumulators.last) * n, 0.0);
}

/// f(basis, slot, element) for the active elements of a chunk.
template <int Dim, class F>
[[gnu::always_inline]] inline void for_each_element(const Body<Dim>& body, const VelocityField<Dim>& field,
                                                    const exec::Chunk& chunk, F&& f) {
  with_basis<Dim>(*body.mesh, field.active.element.data(), chunk.slots.first, chunk.slots.last, f);
}

/// The Motion of the local nodes of an element, from component `first` on.
template <class Basis>
transfer::NodeRows<Basis> motion_of_nodes(const VelocityField<Basis::dim>& field, int slot, int first = 0) {
  const int* k = field.assembly.nodes_of(slot);
  transfer::NodeRows<Basis> rows;
  for (int i = 0; i < Basis::nodes; ++i) rows[i] = field.nodes.motion[k[i]].row.data() + first;
  return rows;
}

/// A node that no point has a share in, in an element whose points lie on a line, has no velocity of its own. In place
/// of none it takes the mean of the element's other nodes: a body that moves is not strained where it ends on a line.
template <class Basis>
void mend_massless(const VelocityField<Basis::dim>& field, int slot, transfer::NodeRows<Basis>& rows,
                   transfer::Motion<Basis::dim>& mean) {
  const int* k = field.assembly.nodes_of(slot);
  int heavy = 0;
  for (int i = 0; i < Basis::nodes; ++i) {
    if (field.nodes.node[k[i]].m == 0) continue;
    ++heavy;
    for (std::size_t c = 0; c < mean.row.size(); ++c) mean.row[c] += rows[i][c];
  }
  for (double& x : mean.row) x /= std::max(heavy, 1);
  for (int i = 0; i < Basis::nodes; ++i) {
    if (field.nodes.node[k[i]].m == 0) rows[i] = mean.row.data();
  }
}

}  // namespace scarp::step
