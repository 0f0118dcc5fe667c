// The points of an element as its quadrature. Eq. 4 sums B_iᵀ σ_p Ω_p over the points, wherever they happen to lie and
// however many they are: with linear shape functions the sum jumps whenever a point crosses into the next element, and
// where points and mesh lines do not keep step (the report's first contribution) it is wrong by tens of per cent even
// at rest. Inside the soil, where an element is full, the two integrals that a uniform stress needs are known exactly:
// its volume V and ∫ ∇N_i dV. So there
//     Ω̂_p = w Ω_p,                w = V / Σ Ω_p,
//     B̂_i(x_p) = B_i(x_p) + s_i,   s_i = (1/V) ∫ ∇N_i dV − Σ Ω_p B_i(x_p) / Σ Ω_p
// take the place of Ω_p and B_i, in the internal force and in the velocity gradient alike (so that the stress does the
// work that the nodal forces do). A uniform stress then has no internal force inside the soil and a linear velocity
// field has its exact gradient, wherever the points are. In a simplex s_i = 0.
//
// In a body of revolution N_i / r, the circumference's part, is corrected in the same way, with ∫ N_i dA as its
// integral.
//
// Mean dilatation, against volumetric locking: the volume strain of all points of a full element is its mean there, of
// the gradients B̄_i = (1/V) ∫ ∇N_i dV = Σ Ω_p B̂_i(x_p) / Σ Ω_p, and the mean stress acts on these alone:
//     L_p ← L_p + (1/d) (tr L̄ − tr L_p) I,   F_i = w Σ Ω_p (σ_p − s_p I) · B̂_i + w (Σ Ω_p s_p) B̄_i,   s_p = tr σ_p / d.
// In a simplex, of one volume strain anyway, both are means over a patch of neighbours (step/patches.hpp).
//
// The domains of GIMP's points overlap cells and are no partition of one: w = 1 and s_i = 0. Its functions are
// continuous where a point crosses a line, and so the mean has to be: a point takes part in it with a share γ_p that
// falls from 1 to 0 as its domain comes to lie across the line,
//     B̄_i = Σ γ_p Ω_p B_i(x_p) / Σ γ_p Ω_p,   L_p ← L_p + (γ_p/d) (Σ du_i · B̄_i / dt − tr L_p) I,
//     F_i = Σ Ω_p (σ_p − γ_p s_p I) · B_i + (Σ γ_p Ω_p s_p) B̄_i.
// (Ground at rest heated without end where every point of a cell had the same share.)
//
// The sums over the points need no second pass: Σ B̂_iᵀ σ_p Ω̂_p = w (Σ B_iᵀ σ_p Ω_p + s_iᵀ Σ σ_p Ω_p).
#pragma once

#include <array>

#include "scarp/transfer/gradient_correction.hpp"
#include "scarp/transfer/means.hpp"

namespace scarp::transfer {

/// What the step uses for an element's points: w and s_i; as constructed, eq. 4 as printed.
template <class Basis>
struct Quadrature {
  double weight = 1;
  GradientCorrection<Basis> correction;
  Hoop<Basis> hoop_correction;          ///< of N_i / r [1/m]
  const Means<Basis>* means = nullptr;  ///< of mean dilatation: what mean stresses act on; not set: B̂_i, as all stress

  Quadrature() {
    if constexpr (is_axisymmetric<Basis>) {
      repeat<nodal_batches<Basis>>([&](auto b) { hoop_correction[0][b] = Lane<Basis>(0.0); });
    }
  }
};

/// Do points of so much volume fill an element? Those of less than half of it, or more than twice, are no quadrature of
/// it: they keep eq. 4.
template <class Basis>
inline bool fills(double volume, const Means<Basis>& mean) {
  return volume > 0.5 * mean.V && volume < 2 * mean.V;
}

/// The quadrature of an element full of soil, from Σ Ω_p, what its correction follows from and (in a body of
/// revolution) Σ Ω_p N_i / r over its points.
template <class Basis>
inline Quadrature<Basis> full_element(const typename Basis::Cell& cell, const Means<Basis>& mean, double volume,
                                      const CorrectionSums<Basis>& sums, const Hoop<Basis>& hoop) {
  Quadrature<Basis> q;
  const double per_volume = 1 / volume;
  q.weight = mean.V * per_volume;
  q.correction = GradientCorrection<Basis>(cell, mean, sums, per_volume);
  if constexpr (is_axisymmetric<Basis>) {
    repeat<nodal_batches<Basis>>(
        [&](auto b) { q.hoop_correction[0][b] = mean.hoop[0][b] - hoop[0][b] * Lane<Basis>(per_volume); });
  }
  return q;
}

}  // namespace scarp::transfer
