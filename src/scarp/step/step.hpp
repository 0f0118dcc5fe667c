// One time step of the dynamic material point method: section 2 of the report, in its order and its symbols.
#pragma once

#include <cstdint>
#include <vector>

#include "scarp/exec/stress_update.hpp"
#include "scarp/step/body.hpp"

namespace scarp {

/// How the points of an element are its quadrature (transfer/quadrature.hpp).
enum class Quadrature {
  points,     ///< eq. 4 as printed, everywhere
  corrected,  ///< exact for uniform stress in elements inside the soil
};

struct StepSettings {
  double flip = 1;     ///< share of FLIP in the velocity update; 1 is the report's
  double damping = 0;  ///< local damping coefficient
  Quadrature quadrature = Quadrature::corrected;
  IntegrationSettings integration;
  bool remove_leaving = false;  ///< a point that leaves the mesh is taken out, instead of an error
};

/// What a step did and where it leaves the body. Sums are taken in a fixed order.
template <int Dim>
struct StepBooks {
  double unbalanced_force = 0, weight = 0;  ///< Σ |F_grav − F_int| over free components and Σ |F_grav|, at nodes
  double work_gravity = 0, work_stress = 0;
  double dissipation_damping = 0, dissipation_friction = 0, dissipation_pic = 0;
  double kinetic_energy = 0, mass = 0, max_velocity = 0;  ///< of the points at the end
  Vec<Dim> momentum{};
  double removed_energy = 0, removed_mass = 0;  ///< kinetic energy and mass of points that left the mesh
  std::int64_t removed = 0;
  exec::StressBooks stress;
  SearchCounts search;
};

/// Advances the body by dt. Throws RunError where a point leaves the mesh (unless it is to be removed).
template <int Dim>
StepBooks<Dim> advance(Body<Dim>& body, double dt, const StepSettings& settings);

/// The largest stable time step for the present stiffness of every point: min h / (c + |v|). Infinite without
/// stiffness.
template <int Dim>
double critical_time_step(const Body<Dim>& body);

/// Mass, momentum, kinetic energy and largest velocity of the points as they are.
template <int Dim>
void book_motion(const Body<Dim>& body, StepBooks<Dim>& books);

}  // namespace scarp
