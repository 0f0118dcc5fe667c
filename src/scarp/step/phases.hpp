// The parts of a step, in the order of step.cpp. Not for use outside step/.
#pragma once

#include "scarp/step/step.hpp"

namespace scarp::step {

/// Step 1: every element adds up mass, momentum and internal force for its own local nodes from its own points.
template <int Dim>
void map_points_to_elements(Body<Dim>& body, Quadrature choice, StepBooks<Dim>& books);

/// Steps 2 and 3 for all active nodes: their sums, acceleration and conditions.
template <int Dim>
void accelerate_nodes(Body<Dim>& body, double dt, const StepSettings& settings, StepBooks<Dim>& books);

/// Steps 4 and 5: velocities of the points, then their momentum again for the local nodes.
template <int Dim>
void update_velocities(Body<Dim>& body, double dt, double flip, StepBooks<Dim>& books);

/// Step 5, end: v_n^{t+dt} = p_n / m_n (eq. 8) with the conditions.
template <int Dim>
void velocities_of_nodes(Body<Dim>& body, double dt, const StepSettings& settings, StepBooks<Dim>& books);

/// Steps 6 to 11 for the points of one chunk of elements after the other, so that what one step hands to the next stays
/// in the cache.
template <int Dim>
void strain_stress_and_motion(Body<Dim>& body, double dt, const StepSettings& settings, StepBooks<Dim>& books);

}  // namespace scarp::step
