// The parts of a step, in the order of step.cpp. Not for use outside step/.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "scarp/step/step.hpp"

namespace scarp::step {

/// The sum at active node k, n numbers, that gather() has left.
template <int n, int Dim>
std::array<double, n> gathered(const VelocityField<Dim>& field, int k, const Column& numbers) {
  const double* sum = numbers.data() + static_cast<std::size_t>(field.assembly.first_accumulator(k)) * n;
  std::array<double, n> copy;
  std::copy_n(sum, n, copy.begin());
  return copy;
}

/// Step 2: what active node k has from step 1.
template <int Dim>
transfer::NodeSums<Dim> gathered_sums(const VelocityField<Dim>& field, int k) {
  return {gathered<transfer::node_sums<Dim>>(field, k, field.buffers.sums)};
}

/// Step 1: every element adds up mass, momentum and internal force for its own local nodes from its own points, which
/// first get the columns that the scheme needs; then simplices add the mean stress of their patches. All forces of the
/// soil are there then, for whoever asks for them between steps, too.
template <int Dim>
void map_points_to_elements(Body<Dim>& body, VelocityField<Dim>& field, const StepSettings& settings);

/// Steps 2 and 3 for all active nodes: their sums, acceleration and conditions.
template <int Dim>
void accelerate_nodes(Body<Dim>& body, VelocityField<Dim>& field, double dt, const StepSettings& settings);

/// Σ_j M_ij w_j over the elements, for the first n components w of the nodes' Motion: those of c, or all. Of all only
/// those from `from` on need be there.
template <int n, int Dim>
void sum_with_mass_matrix(Body<Dim>& body, VelocityField<Dim>& field, int from);

/// Step 4 of a scheme of two terms, after the sums of a dt and ṽ: c = P [φ a dt + (1 − φ) ṽ].
template <int Dim>
void filter_changes(VelocityField<Dim>& field, double dt, const StepSettings& settings);

/// Step 5, end, after the sums of c: v_n^{t+dt} = p_n / m_n (eq. 8) with the conditions.
template <int Dim>
void velocities_of_nodes(Body<Dim>& body, VelocityField<Dim>& field, double dt, const StepSettings& settings);

/// The same of a scheme of two terms, after the sums of v dt: du = P v dt.
template <int Dim>
void filter_displacements(Body<Dim>& body, VelocityField<Dim>& field, const StepSettings& settings);

/// Step 4 for the points themselves, and steps 6 to 11 for the points of one chunk of elements after the other, so that
/// what one step hands to the next stays in the cache.
template <int Dim>
void strain_stress_and_motion(Body<Dim>& body, VelocityField<Dim>& field, double dt, const StepSettings& settings);

/// Step 3, end: what the interactions of the body's fields do at their nodes.
template <int Dim>
void interact(Body<Dim>& body, double dt, const StepSettings& settings);

/// The books of a step of dt, once all of it is in those of the fields and threads.
template <int Dim>
StepTotals<Dim> close_totals(Body<Dim>& body, double dt, const StepSettings& settings);

}  // namespace scarp::step
