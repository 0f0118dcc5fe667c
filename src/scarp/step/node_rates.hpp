// What nodes have to say of the time step in triangles and tetrahedra. The limit of an element (exec/stress_update.hpp)
// takes it that its nodes have the mass that soil around them would give them. Between few points that is not so: one
// simplex holds three of them and the next none, and a node of the first one may have little of their mass. With lumped
// masses and the stiffness Σ Ω̂ M |B_n|² of a node, of what the elements around it hold,
//     ω² ≤ max over elements of Σ_n ω_n²,   ω_n² = Σ Ω̂ M |B_n|² / m_n,
// which is without bound where m_n is next to nothing; but then the points have next to nothing of that node's motion
// either. What they have is the share N_n, and
//     ω² ≈ 2 max over points of Σ_n N_n(x_p) ω_n²,
// which is exact for a bar. Among 370 fillings of meshes of either kind, by lattices and at random down to one point
// per edge, the true one was between 0.3 and 0.95 of it (docs/theory.md, "Critical time step"). For one modulus M it is
// a matter of geometry: as 4 c²/h², with c² = M Ω / m, it stands for a point of
//     Ω / (m h²) = ½ Σ_n N_n G_n / m_n,   G_n = Σ Ω̂ |B_n|².
#pragma once

#include "scarp/step/step.hpp"

namespace scarp::step {

/// Has the mesh triangles or tetrahedra, and does the scheme ask for their nodes' limit?
template <int Dim>
bool bounds_by_nodes(const Body<Dim>& body, const Scheme& scheme) {
  return scheme.bounds_by_nodes && !body.patches.empty();
}

/// Elements whose limit is found.
enum class Bounded { all, due };

/// Step 6, start: the largest ½ Σ N_n G_n / m_n [1/(Mg m²) times m³] over the points of each simplex, to
/// NodeBounds::least_per_mass. Asks for what accelerate_nodes() leaves, and leaves no other sums of the nodes.
template <int Dim>
void bound_by_nodes(Body<Dim>& body, VelocityField<Dim>& field, Bounded which);

/// One more step: the same of all elements if it is time for that, or of those that must not wait, if there are such.
template <int Dim>
void bound_by_nodes_when_due(Body<Dim>& body, VelocityField<Dim>& field);

}  // namespace scarp::step
