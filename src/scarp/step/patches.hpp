// Mean dilatation of triangles and tetrahedra, against volumetric locking. One of them has a single volume strain, and
// there are many more of them than nodes: nearly incompressible soil finds hardly a motion that keeps all their
// volumes. So these are kept in the mean over a patch of neighbours (mesh/patches.hpp). With F the simplices whose
// quadrature is corrected (transfer/quadrature.hpp), V_e = w Σ Ω_p their volume, θ_e = Σ du_i · B̄_i, p_e = Σ Ω_p s_p /
// Σ Ω_p of s_p = tr σ_p / d, and the mean over those of F in the patch of e
//     (S x)_e = Σ V_e' x_e' / Σ V_e',
//     L_p ← L_p + (1/d) (S θ − tr L_p) I,   F_i = Σ_p w Ω_p (σ_p − s_p I) · B̂_i + V_e (S p)_e B̄_i.
// S is a projection, and symmetric in V_e: Σ V_e (S p)_e θ_e = Σ V_e p_e (S θ)_e, so that stress does the work that the
// nodal forces do. Its eigenvalues are 0 and 1: of one material no mode of the nodes is stiffer than it was.
#pragma once

#include "scarp/step/step.hpp"

namespace scarp::step {

/// Has the mesh patches, and does the scheme ask for their means?
template <int Dim>
bool uses_patches(const Body<Dim>& body, const StepSettings& settings) {
  return !body.patches.empty() && settings.scheme.mean_dilatation;
}

/// (S x)_e for x = PatchShare::p or PatchShare::theta, of an element e of F. Summed up in the order of the elements.
template <int Dim>
double mean_over_patch(const Body<Dim>& body, const VelocityField<Dim>& field, int e, double PatchShare::*x) {
  double sum = 0, V = 0;
  for (const int other : body.patches.around(e)) {
    const int slot = field.active.slot[other];
    if (slot < 0) continue;
    const PatchShare& share = field.buffers.patch_share[slot];
    sum += share.V * (share.*x);
    V += share.V;
  }
  return sum / V;
}

/// Step 1, end: V_e (S p)_e B̄_i to the sums of the nodes, when every element has its p_e.
template <int Dim>
void add_mean_stresses(Body<Dim>& body, VelocityField<Dim>& field);

/// Step 6, start: θ_e, from the displacements of the nodes.
template <int Dim>
void find_dilations(Body<Dim>& body, VelocityField<Dim>& field, const StepSettings& settings);

}  // namespace scarp::step
