// One time step of the dynamic material point method: section 2 of the report, in its order and its symbols.
#pragma once

#include "scarp/step/body.hpp"
#include "scarp/step/scheme.hpp"

namespace scarp {

/// How the points of an element are its quadrature (transfer/quadrature.hpp).
enum class QuadratureRule {
  points,     ///< eq. 4 as printed, everywhere
  corrected,  ///< exact for uniform stress in elements inside the soil
};

struct StepSettings {
  Scheme scheme{};     ///< as constructed the report's, with pure FLIP
  double damping = 0;  ///< local damping coefficient
  QuadratureRule quadrature = QuadratureRule::corrected;
  IntegrationSettings integration;
  bool remove_leaving = false;  ///< a point that leaves the mesh is taken out, instead of an error
  bool profile = false;         ///< book the time of each Phase
};

/// Advances the body by dt. Throws RunError where a point leaves the mesh (unless it is to be removed), and where what
/// the step leaves is no motion of soil (step/soundness.hpp).
template <int Dim>
StepTotals<Dim> advance(Body<Dim>& body, double dt, const StepSettings& settings);

/// The largest stable time step of a scheme with local damping for the present stiffness of every point: min 1 / (c/(k
/// h) + |v|/h), with k of exec::WaveSettings. Infinite without stiffness.
template <int Dim>
double critical_time_step(Body<Dim>& body, const Scheme& scheme = {}, double local_damping = 0);

/// Mass, momentum, kinetic energy and largest velocity of the points as they are.
template <int Dim>
void record_motion(const Body<Dim>& body, StepTotals<Dim>& totals);

}  // namespace scarp
