// Means over an element: its volume, its mean gradients B̄_i, and the volume strain that these have of the nodes'
// displacements. What they are for: transfer/quadrature.hpp.
#pragma once

#include <array>
#include <type_traits>

#include "scarp/transfer/gradient_correction.hpp"
#include "scarp/transfer/node_values.hpp"
#include "scarp/transfer/simd/shapes_at_points.hpp"
#include "scarp/transfer/simd/spline_functions.hpp"

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
      const auto next = rotated<4, 1>(along), last = rotated<4, 3>(along);
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

/// Directions that a mean of stress or strain is taken over: those of the plane, of space, or all three of a body of
/// revolution.
template <class Basis>
inline constexpr int mean_directions = is_axisymmetric<Basis> ? 3 : Basis::dim;

/// f(on), with `on` as a constant where the basis has no mean of its own in the report's scheme either: what takes none
/// is then compiled as if there were none, to the same last bit (a branch would change where products are fused).
template <class Basis, class F>
inline void with_means(bool on, F&& f) {
  if constexpr (has_correction<Basis>) {
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

/// Σ du_i · B̄_i of an element of mean dilatation, in a body of revolution with the mean of N_i / r, too.
template <class Basis>
inline double mean_dilation(const Means<Basis>& mean, const NodeRows<Basis>& motion) {
  constexpr int Dim = Basis::dim;
  Lane<Basis> sum(0.0);
  repeat<Dim>([&](auto j) {
    const auto du = nodal<Basis>([&](int i) { return motion[i][Dim + j]; });
    repeat<nodal_batches<Basis>>([&](auto b) {
      sum = fma(du[b], mean.gradient[j][b], sum);
      if constexpr (is_axisymmetric<Basis>) {
        if constexpr (j == 0) sum = fma(du[b], mean.hoop[0][b], sum);
      }
    });
  });
  return xsimd::hadd(sum);
}

/// The same from the cell.
template <class Basis>
inline double mean_dilation(const typename Basis::Cell& cell, const NodeRows<Basis>& motion) {
  if constexpr (std::is_same_v<Basis, GridLinear<Basis::dim>>) {  // B̄_i = ± 2 / (K h) along each axis
    double sum = 0;
    repeat<Basis::dim>([&](auto d) {
      double along = 0;
      repeat<Basis::nodes>([&](auto i) {
        const double du = motion[i][Basis::dim + d];
        along += scarp::detail::far_side(i, d) ? du : -du;
      });
      sum += along * cell.inverse()[d];
    });
    return sum * (2.0 / Basis::nodes);
  } else {
    return mean_dilation<Basis>(Means<Basis>(cell), motion);
  }
}

}  // namespace scarp::transfer
