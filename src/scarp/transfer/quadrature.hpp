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
#include <type_traits>

#include "scarp/transfer/at_nodes.hpp"
#include "scarp/transfer/shift.hpp"

namespace scarp::transfer {

/// Numbers of the local nodes that only a body of revolution has.
template <class Basis>
using Hoop = std::array<Nodal<Basis>, is_axisymmetric<Basis> ? 1 : 0>;

/// An element's volume V and (1/V) ∫ ∇N_i dV, and in a body of revolution (1/V) ∫ N_i dA.
template <class Basis>
struct Means {
  double V;
  std::array<Nodal<Basis>, Basis::dim> gradient;
  Hoop<Basis> hoop;

  explicit Means(const typename Basis::Cell& cell) {
    std::array<Vec<Basis::dim>, Basis::nodes> g;
    if constexpr (is_axisymmetric<Basis>) {
      std::array<double, Basis::nodes> h;
      cell.integrals(V, g, h);
      hoop[0] = nodal<Basis>([&](int i) { return h[i] / V; });
    } else {
      cell.integrals(V, g);
    }
    const double per_V = 1 / V;
    repeat<Basis::dim>([&](auto j) { gradient[j] = nodal<Basis>([&](int i) { return g[i][j] * per_V; }); });
  }
};

template <int Dim>
struct Means<GridLinear<Dim>> {
  using Basis = GridLinear<Dim>;
  double V = 1;
  std::array<Nodal<Basis>, Dim> gradient;

  explicit Means(const typename Basis::Cell& cell) {
    repeat<Dim>([&](auto d) {
      V *= cell.spacing()[d];
      const auto side = nodal<Basis>(
          [](int i) { return (scarp::detail::far_side(i, decltype(d)::value) ? 2.0 : -2.0) / Basis::nodes; });
      repeat<nodal_batches<Basis>>([&](auto b) { gradient[d][b] = side[b] * Lane<Basis>(cell.inverse()[d]); });
    });
  }
};

/// ∫ ∇N_i dV is ∮ N_i n ds, over the two sides that meet in i.
template <>
struct Means<Linear<Q4>> {
  using Basis = Linear<Q4>;
  double V;
  std::array<Nodal<Basis>, 2> gradient;

  explicit Means(const Basis::Cell& cell) {
    const auto x = [&](int i, int j) { return cell.corner(i)[j]; };
    V = 0.5 * ((x(2, 0) - x(0, 0)) * (x(3, 1) - x(1, 1)) - (x(3, 0) - x(1, 0)) * (x(2, 1) - x(0, 1)));
    repeat<2>([&](auto j) {
      constexpr int other = 1 - j;
      const auto along = nodal<Basis>([&](int i) { return x(i, other); });
      const auto next = turned<4, 1>(along), last = turned<4, 3>(along);
      const Lane<Basis> half((j == 0 ? 0.5 : -0.5) / V);
      repeat<nodal_batches<Basis>>([&](auto b) { gradient[j][b] = half * (next[b] - last[b]); });
    });
  }
};

template <int Dim>
requires(SplineFunctions<GridSpline<Dim>, Lane<GridSpline<Dim>>>::possible) struct Means<GridSpline<Dim>> {
  using Basis = GridSpline<Dim>;
  double V = 1;
  std::array<Nodal<Basis>, Dim> gradient;

  explicit Means(const typename Basis::Cell& cell) {
    using T = Lane<Basis>;
    std::array<T, Dim> value, slope;
    repeat<Dim>([&](auto d) {
      V *= cell.spacing()[d];
      SplineFunctions<Basis, T>(cell, d).mean(value[d], slope[d]);
    });
    repeat<nodal_batches<Basis>>([&](auto b) {
      std::array<T, Dim> mean, others;
      repeat<Dim>([&](auto d) { mean[d] = of_nodes<Basis, d, b>(value[d]); });
      products(mean, others);
      repeat<Dim>([&](auto d) { gradient[d][b] = of_nodes<Basis, d, b>(slope[d]) * others[d]; });
    });
  }
};

/// A cell of GIMP: B̄_i of its points.
template <int Dim>
struct Means<GridGimp<Dim>> {
  using Basis = GridGimp<Dim>;
  static constexpr int size = Dim * nodal_size<Basis>;  ///< of the numbers that store() writes
  double V = 1;
  std::array<Nodal<Basis>, Dim> gradient;

  explicit Means(const typename Basis::Cell& cell) {
    for (const double per_edge : cell.inverse()) V /= per_edge;
  }
  void store(double* to) const {
    repeat<Dim>([&](auto j) { store_nodal<Basis>(gradient[j], to + j * nodal_size<Basis>); });
  }
  /// Σ du_i · B̄_i for the displacements of the nodes, that begin in component `first` of their rows.
  static double dilation(const double* gradient, const NodeRows<Basis>& motion, int first) {
    Lane<Basis> sum(0.0);
    repeat<Dim>([&](auto j) {
      const auto du = nodal<Basis>([&](int i) { return motion[i][first + j]; });
      repeat<nodal_batches<Basis>>([&](auto b) {
        const double* from = gradient + j * nodal_size<Basis> + b * lanes_of<Lane<Basis>>;
        sum = fma(du[b], Lane<Basis>::load_unaligned(from), sum);
      });
    });
    return xsimd::hadd(sum);
  }
};

/// f(on), with `on` as a constant where the basis has no mean of its own in the report's scheme either: what takes none
/// is then compiled as if there were none, to the same last bit (a branch would change where products are fused).
template <class Basis, class F>
inline void with_means(bool on, F&& f) {
  if constexpr (has_shift<Basis>) {
    f(on);
  } else if (on) {
    f(std::true_type{});
  } else {
    f(std::false_type{});
  }
}

/// Does the element keep B̄_i from its points for the strain?
template <class Basis>
inline constexpr bool keeps_means = Basis::has_domains;

/// γ_p of a point with a domain: 1 where that is within the cell, 0 where the point is on a line to the next.
template <class Basis, class Local>
inline auto share_of_mean(const Local& at) {
  using T = typename Local::value_type;
  constexpr double tiny = 1e-300;  // without a domain: 1
  T share(1.0);
  for (int d = 0; d < Basis::dim; ++d) {
    const T within = max(T(0.0), min(at.s[d], T(1.0) - at.s[d]));
    share *= min(T(1.0), (within + T(tiny)) / (at.lambda[d] + T(tiny)));
  }
  return share;
}

/// What the step uses for an element's points: w and s_i; as constructed, eq. 4 as printed.
template <class Basis>
struct Quadrature {
  double weight = 1;
  Shift<Basis> shift;
  Hoop<Basis> hoop_shift;               ///< of N_i / r [1/m]
  const Means<Basis>* means = nullptr;  ///< of mean dilatation: what mean stresses act on; not set: B̂_i, as all stress

  Quadrature() {
    if constexpr (is_axisymmetric<Basis>) {
      repeat<nodal_batches<Basis>>([&](auto b) { hoop_shift[0][b] = Lane<Basis>(0.0); });
    }
  }
};

/// Do points of so much volume fill an element? Those of less than half of it, or more than twice, are no quadrature of
/// it: they keep eq. 4.
template <class Basis>
inline bool fills(double volume, const Means<Basis>& mean) {
  return volume > 0.5 * mean.V && volume < 2 * mean.V;
}

/// The quadrature of an element full of soil, from Σ Ω_p, what its shift follows from and (in a body of revolution)
/// Σ Ω_p N_i / r over its points.
template <class Basis>
inline Quadrature<Basis> full_element(const typename Basis::Cell& cell, const Means<Basis>& mean, double volume,
                                      const ShiftSums<Basis>& sums, const Hoop<Basis>& hoop) {
  Quadrature<Basis> q;
  const double per_volume = 1 / volume;
  q.weight = mean.V * per_volume;
  q.shift = Shift<Basis>(cell, mean, sums, per_volume);
  if constexpr (is_axisymmetric<Basis>) {
    repeat<nodal_batches<Basis>>(
        [&](auto b) { q.hoop_shift[0][b] = mean.hoop[0][b] - hoop[0][b] * Lane<Basis>(per_volume); });
  }
  return q;
}

}  // namespace scarp::transfer
