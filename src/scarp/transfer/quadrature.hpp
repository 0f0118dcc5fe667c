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
// The sums over the points need no second pass: Σ B̂_iᵀ σ_p Ω̂_p = w (Σ B_iᵀ σ_p Ω_p + s_iᵀ Σ σ_p Ω_p).
#pragma once

#include <array>

#include "scarp/transfer/at_nodes.hpp"

namespace scarp::transfer {

/// Numbers of the local nodes that only a body of revolution has.
template <class Basis>
using Hoop = std::array<Nodal<Basis>, is_axisymmetric<Basis> ? 1 : 0>;

/// What the step uses for an element's points: w and s_i; as constructed, eq. 4 as printed.
template <class Basis>
struct Quadrature {
  double weight = 1;
  std::array<Nodal<Basis>, Basis::dim> shift;  ///< [1/m]
  Hoop<Basis> hoop_shift;                      ///< of N_i / r [1/m]

  Quadrature() {
    repeat<nodal_batches<Basis>>([&](auto b) {
      repeat<Basis::dim>([&](auto j) { shift[j][b] = Lane<Basis>(0.0); });
      for (auto& of_nodes : hoop_shift) of_nodes[b] = Lane<Basis>(0.0);
    });
  }
};

/// The quadrature of an element full of soil, from Σ Ω_p, Σ Ω_p B_i and (in a body of revolution) Σ Ω_p N_i / r over
/// its points. Points that fill less than half of the element, or more than twice, are no quadrature of it: they keep
/// eq. 4.
template <class Basis>
inline Quadrature<Basis> full_element(const typename Basis::Cell& cell, double volume,
                                      const std::array<Nodal<Basis>, Basis::dim>& gradient, const Hoop<Basis>& hoop) {
  using T = Lane<Basis>;
  Quadrature<Basis> q;
  double V;
  std::array<Vec<Basis::dim>, Basis::nodes> exact;
  std::array<double, Basis::nodes> exact_hoop;
  if constexpr (is_axisymmetric<Basis>) {
    cell.integrals(V, exact, exact_hoop);
  } else {
    cell.integrals(V, exact);
  }
  if (!(volume > 0.5 * V && volume < 2 * V)) return q;
  const double per_V = 1 / V, per_volume = 1 / volume;
  q.weight = V * per_volume;
  repeat<Basis::dim>([&](auto j) {
    const auto mean = nodal<Basis>([&](int i) { return exact[i][j] * per_V; });
    repeat<nodal_batches<Basis>>([&](auto b) { q.shift[j][b] = mean[b] - gradient[j][b] * T(per_volume); });
  });
  if constexpr (is_axisymmetric<Basis>) {
    const auto mean = nodal<Basis>([&](int i) { return exact_hoop[i] * per_V; });
    repeat<nodal_batches<Basis>>([&](auto b) { q.hoop_shift[0][b] = mean[b] - hoop[0][b] * T(per_volume); });
  }
  return q;
}

}  // namespace scarp::transfer
