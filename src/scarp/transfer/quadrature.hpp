// The points of an element as its quadrature. Eq. 4 sums B_iᵀ σ_p Ω_p over the points, wherever they happen to lie and
// however many they are: with linear shape functions the sum jumps whenever a point crosses into the next element, and
// where points and mesh lines do not keep step (the report's first contribution) it is wrong by tens of per cent even
// at rest. Inside the soil, where an element is full, the two integrals that a uniform stress needs are known exactly:
// its volume V and ∫ ∇N_i dV. So there
//     Ω̂_p = w Ω_p,                w = V / Σ Ω_p,
//     B̂_i(x_p) = B_i(x_p) + s_i,   s_i = (1/V) ∫ ∇N_i dV − Σ Ω_p B_i(x_p) / Σ Ω_p
// take the place of Ω_p and B_i, in the internal force and in the velocity gradient alike (so that the stress does the
// work that the nodal forces do). A uniform stress then has no internal force inside the soil and a linear velocity
// field has its exact gradient, wherever the points are. In a triangle s_i = 0.
#pragma once

#include <array>

#include "scarp/transfer/range.hpp"

namespace scarp::transfer {

/// What the step uses for an element's points: w and s_i; as constructed, eq. 4 as printed.
struct Quadrature {
  double weight = 1;
  std::array<Vec<2>, 4> shift{};  ///< [1/m]
};

/// Σ Ω_p and Σ Ω_p B_i(x_p) over an element's points.
template <class Shape>
struct PointIntegrals {
  double volume = 0;
  std::array<Vec<2>, Shape::nodes> gradient{};
};

template <class Shape>
void add_points(const NodePositions<Shape>& x_i, const Points<2>& points, Range range, PointIntegrals<Shape>& sums) {
  for (int k = 0; k < range.count; ++k) {
    const int p = range.order[k];
    std::array<double, Shape::nodes> N;
    std::array<Vec<2>, Shape::nodes> B;
    gradients<Shape>(x_i, {points.xi[0][p], points.xi[1][p]}, N, B);
    const double Omega = points.volume[p];
    sums.volume += Omega;
    for (int i = 0; i < Shape::nodes; ++i) {
      for (int j = 0; j < 2; ++j) sums.gradient[i][j] += Omega * B[i][j];
    }
  }
}

/// The quadrature of an element full of soil. Points that fill less than half of the element, or more than twice, are
/// no quadrature of it: they keep eq. 4.
template <class Shape>
Quadrature full_element(const NodePositions<Shape>& x_i, const PointIntegrals<Shape>& sums) {
  // ∫ ∇N_i dV by the divergence theorem: N_i is linear along the two edges at node i.
  constexpr int n = Shape::nodes;
  double V = 0;
  std::array<Vec<2>, n> gradient;
  for (int i = 0; i < n; ++i) {
    const auto &before = x_i[(i + n - 1) % n], &after = x_i[(i + 1) % n];
    gradient[i] = {0.5 * (after[1] - before[1]), 0.5 * (before[0] - after[0])};
    V += x_i[i][0] * gradient[i][0];
  }
  Quadrature q;
  if (!(sums.volume > 0.5 * V && sums.volume < 2 * V)) return q;
  q.weight = V / sums.volume;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < 2; ++j) q.shift[i][j] = gradient[i][j] / V - sums.gradient[i][j] / sums.volume;
  }
  return q;
}

}  // namespace scarp::transfer
