// What an element has for the strain of its points, from the buffers of the step. Not for use outside step/.
#pragma once

#include "scarp/step/element.hpp"
#include "scarp/step/patches.hpp"
#include "scarp/transfer/nodes_to_points.hpp"

namespace scarp::step {

/// The volume strain of all points of an element.
template <class Basis>
double mean_dilation(const Body<Basis::dim>& body, const VelocityField<Basis::dim>& field, int slot,
                     const typename Basis::Cell& cell, const transfer::NodeRows<Basis>& motion) {
  using Means = transfer::Means<Basis>;
  if constexpr (is_simplex<Basis>) {
    return mean_over_patch(body, field, field.active.element[slot], &PatchShare::theta);
  } else if constexpr (transfer::keeps_means<Basis>) {
    return Means::dilation(field.buffers.mean_gradient.data() + slot * Means::size, motion, Basis::dim);
  } else {
    return transfer::mean_dilation<Basis>(cell, motion);
  }
}

/// The motion of its nodes and its quadrature. Nodes without mass are mended with `mends_massless`, for which
/// `mean_motion` is room that must outlive the answer; with `averaged` the volume strain of its points is a mean.
template <class Basis, class Averaged>
transfer::ElementMotion<Basis> element_motion(const Body<Basis::dim>& body, const VelocityField<Basis::dim>& field,
                                              int slot, const typename Basis::Cell& cell, bool mends_massless,
                                              Averaged averaged, transfer::Motion<Basis::dim>& mean_motion) {
  const auto& buffers = field.buffers;
  transfer::ElementMotion<Basis> element{motion_of_nodes<Basis>(field, slot),
                                         buffers.correction.data() + slot * buffers.correction_row,
                                         buffers.weight[slot], buffers.size[slot]};
  if constexpr (is_simplex<Basis>) element.least_per_mass = buffers.bounds.least_per_mass[field.active.element[slot]];
  if constexpr (is_axisymmetric<Basis>) {
    element.hoop_correction = buffers.hoop_correction.data() + slot * padded_row(field.assembly.row());
  }
  if (mends_massless) mend_massless<Basis>(field, slot, element.motion, mean_motion);
  if (averaged) element.mean_dilation = mean_dilation<Basis>(body, field, slot, cell, element.motion);
  return element;
}

/// The change of velocity of pure FLIP of each of its nodes, where points book PIC.
template <bool pic, class Basis>
transfer::NodeRows<Basis> flip_changes(const VelocityField<Basis::dim>& field, int slot) {
  transfer::NodeRows<Basis> a_dt{};
  if constexpr (pic) {
    const int* k = field.assembly.nodes_of(slot);
    for (int i = 0; i < Basis::nodes; ++i) a_dt[i] = field.nodes.a_dt[k[i]].data();
  }
  return a_dt;
}

}  // namespace scarp::step
