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

/// Steps 4 and 5: the momentum of the nodes after the points have changed their velocities.
template <int Dim>
void change_momentum(Body<Dim>& body, StepBooks<Dim>& books);

/// Step 5, end: v_n^{t+dt} = p_n / m_n (eq. 8) with the conditions.
template <int Dim>
void velocities_of_nodes(Body<Dim>& body, double dt, const StepSettings& settings, StepBooks<Dim>& books);

/// Step 4 for the points themselves, and steps 6 to 11 for the points of one chunk of elements after the other, so that
/// what one step hands to the next stays in the cache.
template <int Dim>
void strain_stress_and_motion(Body<Dim>& body, double dt, const StepSettings& settings, StepBooks<Dim>& books);

}  // namespace scarp::step
