// The correction s_i of an element's gradients (transfer/quadrature.hpp): what it follows from, and what it does.
#pragma once

#include <array>

#include "scarp/transfer/simd/fields.hpp"
#include "scarp/transfer/simd/shapes_at_points.hpp"

namespace scarp::transfer {

/// Is there one? In a simplex B_i is constant and its own mean.
template <class Basis>
inline constexpr bool has_correction = Basis::corrects && !is_simplex<Basis>;

/// Σ Ω_p B_i over the points.
template <class Basis>
struct CorrectionSums {
  static constexpr int rows = has_correction<Basis> ? Basis::dim : 0;
  std::array<WideNodal<Basis>, rows> B;

  CorrectionSums() {
    repeat<rows>([&](auto j) { clear<Basis>(B[j]); });
  }

  /// Adds the points of some lanes, of which `volume` is in the lanes;
  template <class Lanes, class T>
  void add_batch(const ShapesAtPoints<Basis>&, const Points<Basis::dim>&, const Lanes&, const T&) {}
  /// adds one, or two.
  void add(const Wide<Basis>& Omega, const Shapes<Basis>& at) {
    repeat<rows>(
        [&](auto j) { repeat<nodal_batches<Basis>>([&](auto b) { B[j][b] = fma(Omega, at.B[j][b], B[j][b]); }); });
  }
};

/// s_i; none as constructed.
template <class Basis>
struct GradientCorrection {
  static constexpr int Dim = Basis::dim, rows = has_correction<Basis> ? Dim : 0;
  static constexpr int size = rows * nodal_size<Basis>;  ///< of the numbers that store() writes

  std::array<Nodal<Basis>, rows> s;  ///< [1/m]

  GradientCorrection() {
    repeat<rows>([&](auto j) { repeat<nodal_batches<Basis>>([&](auto b) { s[j][b] = Lane<Basis>(0.0); }); });
  }

  /// The mean gradient less that of the points, whose volume is Σ Ω_p.
  template <class Means>
  GradientCorrection(const typename Basis::Cell&, const Means& mean, const CorrectionSums<Basis>& sums,
                     double per_volume) {
    repeat<rows>([&](auto j) {
      const auto of_points = total<Basis>(sums.B[j]);
      repeat<nodal_batches<Basis>>(
          [&](auto b) { s[j][b] = mean.gradient[j][b] - of_points[b] * Lane<Basis>(per_volume); });
    });
  }

  void store(double* to) const {
    repeat<rows>([&](auto j) { store_nodal<Basis>(s[j], to + j * nodal_size<Basis>); });
  }

  /// F_i += s_iᵀ σ, for σ = Σ Ω_p σ_p.
  void add_force(const std::array<double, sym_size<Dim>>& sigma, std::array<Nodal<Basis>, Dim>& F) const {
    repeat<rows>([&](auto k) {
      repeat<Dim>([&](auto j) {
        const Lane<Basis> component(sigma[mandel(j, k)]);
        repeat<nodal_batches<Basis>>([&](auto b) { F[j][b] = fma(s[k][b], component, F[j][b]); });
      });
    });
  }
};

/// Gradients at points with B_i + s_i in place of B_i, for the s_i that an element has stored: of the field's
/// components from Dim on, the displacements.
template <class Basis>
class CorrectedGradients {
  static constexpr int Dim = Basis::dim;

 public:
  CorrectedGradients(const NodeRows<Basis>& motion, const double* s) {
    using T = typename Row<2 * Dim>::value_type;
    if constexpr (!has_correction<Basis>) return;
    repeat<Dim>([&](auto k) {
      alignas(64) double column[row_size<2 * Dim>];
      repeat<row_size<2 * Dim> / lanes_of<T>>([&](auto b) {
        T part(0.0);
        repeat<Basis::nodes>([&](auto i) {
          part = fma(T::load_aligned(motion[i] + b * lanes_of<T>), T(s[k * nodal_size<Basis> + i]), part);
        });
        part.store_aligned(column + b * lanes_of<T>);
      });
      repeat<Dim>([&](auto j) { sum_[j * Dim + k] = column[Dim + j]; });
    });
  }

  /// du_j/dx_k where the field is `here`.
  template <int j, int k, class Here, class Local>
  auto derivative(const Field<Basis, 2 * Dim>&, const Here& here, const Local&) const {
    const auto uncorrected = here.template derivative<k>(Dim + j);
    if constexpr (has_correction<Basis>) return uncorrected + decltype(uncorrected)(sum_[j * Dim + k]);
    return uncorrected;
  }

 private:
  Vec<Dim * Dim> sum_{};  ///< Σ du_i ⊗ s_i
};

// In a rectangle B_i is linear in s, so that its mean over the points is B_i at their centre, and over the element at
// its own. With d from the one to the other in local coordinates, B_i(s + d) = B_i(s) + s_i.

template <>
struct CorrectionSums<GridLinear<2>> {
  using Basis = GridLinear<2>;
  using T = PointBatch<2>;
  std::array<T, 2> Omega_s{T(0.0), T(0.0)};  ///< Σ Ω_p s_p

  template <class Lanes>
  void add_batch(const ShapesAtPoints<Basis>& shapes, const Points<2>& points, const Lanes& p, const T& volume) {
    const auto s = local_coordinates<Basis>(shapes.cell(), points, p);
    repeat<2>([&](auto d) { Omega_s[d] = fma(volume, s[d], Omega_s[d]); });
  }
  void add(const Wide<Basis>&, const Shapes<Basis>&) {}
};

template <>
struct GradientCorrection<GridLinear<2>> {
  using Basis = GridLinear<2>;
  static constexpr int size = 2;

  Vec<2> d{}, per_spacing{};

  GradientCorrection() = default;
  template <class Means>
  GradientCorrection(const Basis::Cell& cell, const Means&, const CorrectionSums<Basis>& sums, double per_volume)
      : per_spacing(cell.inverse()) {
    repeat<2>([&](auto j) { d[j] = 0.5 - xsimd::hadd(sums.Omega_s[j]) * per_volume; });
  }

  void store(double* to) const {
    repeat<2>([&](auto j) { to[j] = d[j]; });
  }

  void add_force(const std::array<double, 4>& sigma, std::array<Nodal<Basis>, 2>& F) const {
    const auto sign = nodal<Basis>([](int i) { return i % 2 == 0 ? 1.0 : -1.0; });
    const double s_x = d[1] * per_spacing[0], s_y = d[0] * per_spacing[1];  // of nodes 0 and 2
    repeat<2>([&](auto j) {
      const Lane<Basis> force(s_x * sigma[mandel(j, 0)] + s_y * sigma[mandel(j, 1)]);
      repeat<nodal_batches<Basis>>([&](auto b) { F[j][b] = fma(sign[b], force, F[j][b]); });
    });
  }
};

template <>
class CorrectedGradients<GridLinear<2>> {
  using Basis = GridLinear<2>;

 public:
  CorrectedGradients(const NodeRows<Basis>&, const double* d) : d_{d[0], d[1]} {}

  template <int j, int k, class Here, class T>
  T derivative(const Field<Basis, 4>& motion, const Here&, const std::array<T, 2>& s) const {
    const std::array<T, 2> at{s[0] + T(d_[0]), s[1] + T(d_[1])};
    return motion.at(at).template derivative<k>(2 + j);
  }

 private:
  Vec<2> d_;
};

}  // namespace scarp::transfer
