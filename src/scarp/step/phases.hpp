// The parts of a step, in the order of step.cpp. Not for use outside step/.
#pragma once

#include <array>
#include <cstddef>

#include "scarp/step/step.hpp"

namespace scarp::step {

/// Sweeps over the active nodes go in chunks of so many.
inline constexpr int node_chunk = 256;

/// Step 2: the sum over the places of active node k, n numbers each.
template <int n, int Dim>
std::array<double, n> gathered(const Body<Dim>& body, int k, const Column& numbers) {
  std::array<double, n> sum{};
  body.assembly.gather(k, [&](int place) {
    const double* part = numbers.data() + static_cast<std::size_t>(place) * n;
    for (int q = 0; q < n; ++q) sum[q] += part[q];
  });
  return sum;
}

/// Step 1: every element adds up mass, momentum and internal force for its own local nodes from its own points, which
/// first get the columns that the scheme needs; then simplices add the mean stress of their patches. All forces of the
/// soil are there then, for whoever asks for them between steps, too.
template <int Dim>
void map_points_to_elements(Body<Dim>& body, const StepSettings& settings, StepBooks<Dim>& books);

/// Steps 2 and 3 for all active nodes: their sums, acceleration and conditions.
template <int Dim>
void accelerate_nodes(Body<Dim>& body, double dt, const StepSettings& settings, StepBooks<Dim>& books);

/// Σ_j M_ij w_j over the elements, for the first n components w of the nodes' Motion: those of c, or all. Of all only
/// those from `from` on need be there.
template <int n, int Dim>
void sum_with_mass_matrix(Body<Dim>& body, int from, StepBooks<Dim>& books);

/// Step 4 of a scheme of two terms, after the sums of a dt and ṽ: c = P [φ a dt + (1 − φ) ṽ].
template <int Dim>
void filter_changes(Body<Dim>& body, double dt, const StepSettings& settings, StepBooks<Dim>& books);

/// Step 5, end, after the sums of c: v_n^{t+dt} = p_n / m_n (eq. 8) with the conditions.
template <int Dim>
void velocities_of_nodes(Body<Dim>& body, double dt, const StepSettings& settings, StepBooks<Dim>& books);

/// The same of a scheme of two terms, after the sums of v dt: du = P v dt.
template <int Dim>
void filter_displacements(Body<Dim>& body, const StepSettings& settings, StepBooks<Dim>& books);

/// Step 4 for the points themselves, and steps 6 to 11 for the points of one chunk of elements after the other, so that
/// what one step hands to the next stays in the cache.
template <int Dim>
void strain_stress_and_motion(Body<Dim>& body, double dt, const StepSettings& settings, StepBooks<Dim>& books);

}  // namespace scarp::step
