// Forces from outside at the nodes of a field: gravity, what OutsideForces has, local damping, and what the conditions
// of the mesh do. Here they enter (F_ext of eq. 3, resisted_by), here the work of all but gravity is booked
// (record_work), and Resistance records what resisted and what held. Not for use outside step/.
#pragma once

#include "scarp/step/phases.hpp"

namespace scarp::step {

/// Does anything resist the motion of node n of the mesh?
template <int Dim>
bool is_resisted(const Body<Dim>& body, const VelocityField<Dim>& field, int n, double damping) {
  return damping != 0 || !is_free(body.conditions, n) || field.outside.sides.holds(n);
}

/// F_ext − F_int of node n of the mesh, eqs 3 and 4: gravity is uniform, and its force taken at the node.
template <int Dim>
inline Vec<Dim> driving_force(const Body<Dim>& body, const VelocityField<Dim>& field, int n,
                              const transfer::NodeSums<Dim>& sums) {
  Vec<Dim> F;
  for (int j = 0; j < Dim; ++j) F[j] = sums.mass() * body.gravity[j] - sums.internal_force(j);  // eq. 3
  if (field.outside.active()) [[unlikely]]
    field.outside.add_forces(n, sums.mass(), F);
  return F;
}

// What few nodes need is not inlined, and takes and returns vectors by value: those of the other nodes stay in
// registers.

template <int Dim>
struct ForceAndAcceleration {
  Vec<Dim> F, a;
};

/// Local damping of the force F against the motion of active node k, dashpots, and the conditions: changes a = F / m,
/// notes what is held and the Resistance; F becomes what of it is not balanced.
template <int Dim>
ForceAndAcceleration<Dim> resisted_by(Body<Dim>& body, VelocityField<Dim>& field, int k, double dt,
                                      const StepSettings& settings, ForceAndAcceleration<Dim> of);

/// The conditions on a velocity, or a displacement, of active node k.
template <int Dim>
Vec<Dim> constrained(const Body<Dim>& body, const VelocityField<Dim>& field, int k, const Scheme& scheme, Vec<Dim> v);

constexpr unsigned all_components = ~0u;

/// Books the work of what acts on node k, in some of its components.
template <int Dim>
void record_work_of_others(Body<Dim>& body, VelocityField<Dim>& field, int k, const StepSettings& settings,
                           unsigned components, Vec<Dim> path, StepTotals<Dim>& totals);

/// Books the work of forces on active node k that are no part of the body's own, in some of its components, on the path
/// that these make (before γ of sides).
template <int Dim>
inline void record_work(Body<Dim>& body, VelocityField<Dim>& field, int k, const StepSettings& settings,
                        unsigned components, const Vec<Dim>& path, StepTotals<Dim>& totals) {
  if (field.nodes.node[k].acted_on) [[unlikely]]
    record_work_of_others<Dim>(body, field, k, settings, components, path, totals);
}

}  // namespace scarp::step
