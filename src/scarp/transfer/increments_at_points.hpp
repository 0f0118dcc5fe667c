// What a step strains points by: steps 6, 8 and 9 of the report for the points of one element, from the displacements
// du_i of its nodes alone. Nothing of the points is overwritten, so that it may be formed again and again for other
// du_i, as an implicit step does; nodes_to_points.hpp makes of it an explicit one. A point in each lane; tension
// positive.
#pragma once

#include <array>

#include "scarp/transfer/gradient_correction.hpp"
#include "scarp/transfer/means.hpp"
#include "scarp/transfer/node_values.hpp"
#include "scarp/transfer/point_increments.hpp"
#include "scarp/transfer/simd/fields.hpp"

namespace scarp::transfer {

/// What an element has for the increments of its points.
template <class Basis>
struct ElementMotion {
  NodeRows<Basis> motion;                   ///< Motion of each local node
  const double* correction;                 ///< GradientCorrection of its quadrature, as stored
  double weight, size;                      ///< w of its quadrature, and its least height
  const double* hoop_correction = nullptr;  ///< that of N_i / r, in a body of revolution
  double mean_dilation = 0;                 ///< volume strain of its points, where that is a mean
  double least_per_mass = 0;                ///< a bound from below of PointIncrements::per_mass; in simplices
};

/// Strain increment of the circumference at distance r from the axis, where the radial displacement is du:
/// Σ du_i,r (N_i / r + s_i).
template <class Basis, class T>
inline T hoop_strain(const ElementMotion<Basis>& element, const T& du, const T& r) {
  double corrected = 0;
  for (int i = 0; i < Basis::nodes; ++i) corrected += element.motion[i][Basis::dim] * element.hoop_correction[i];
  return du / r + T(corrected);
}

/// L dt at points, from the displacements of the nodes and their corrected gradients; and the strain increment of the
/// circumference.
template <class T, int Dim>
struct Gradients {
  std::array<std::array<T, Dim>, Dim> L;
  T hoop = T(0.0);

  T trace() const {
    T sum = L[0][0];
    repeat<Dim - 1>([&](auto j) { sum += L[j + 1][j + 1]; });
    return sum + hoop;
  }
};

template <class Basis, class Corrected, class Motion, class Here, class Local, class T>
inline Gradients<T, Basis::dim> gradients_at(const ElementMotion<Basis>& element, const Corrected& corrected,
                                             const Motion& motion, const Here& here, const Local& local, const T& r) {
  constexpr int Dim = Basis::dim;
  Gradients<T, Dim> g;
  if constexpr (is_axisymmetric<Basis>) g.hoop = hoop_strain<Basis>(element, here.value(Dim), r);
  repeat<Dim>([&](auto j) {
    repeat<Dim>([&](auto k) { g.L[j][k] = corrected.template derivative<j, k>(motion, here, local); });  // eq. 9
  });
  return g;
}

/// The increments of an element's points: L dt = Σ du_i ⊗ B_i (eq. 9), strain and spin (eqs 10, 11), and volume by
/// det(I + L dt) (eq. 14 in its finite form; the density of eq. 15 is m_p / Ω_p). `element`, the cell and the rows that
/// they point to must outlive it.
template <class Basis>
class IncrementsAtPoints {
  static constexpr int Dim = Basis::dim;
  using T = PointBatch<Dim>;

 public:
  /// `middle`: strain and spin of the middle of the step.
  IncrementsAtPoints(const typename Basis::Cell& cell, const ElementMotion<Basis>& element, bool middle)
      : element_(element),
        middle_(middle),
        per_size2_(1 / (element.size * element.size)),
        stiffer_(element.weight > 1 ? element.weight * per_size2_ : per_size2_),
        motion_(cell, element.motion),
        corrected_(element.motion, element.correction) {}

  /// c_i and du_i of the nodes as fields.
  const Field<Basis, 2 * Dim>& motion() const { return motion_; }
  double per_size2() const { return per_size2_; }

  /// L dt of the points in some lanes, at `local`, where the motion is `here`.
  template <class Lanes, class Local, class Here>
  Gradients<T, Dim> gradients(const Points<Dim>& points, const Lanes& p, const Local& local, const Here& here) const {
    return gradients_at<Basis>(element_, corrected_, motion_, here, local, p.load(points.x[0]));
  }

  /// Of these points, of mass m, to the places `at` on of `increments`; volumes go to `volume`. With `averaged` the
  /// volume strain is a mean of the element. All but the speed, which is no matter of du_i. Returns the volumes.
  template <class Lanes, class Local, class Averaged>
  T store(Gradients<T, Dim> g, const Points<Dim>& points, const Lanes& p, const T& m, const Local& local,
          Averaged averaged, Column& volume, PointIncrements<Dim>& increments, int at) const {
    if (averaged) {
      T more = (T(element_.mean_dilation) - g.trace()) * T(1.0 / mean_directions<Basis>);
      if constexpr (keeps_means<Basis>) more *= share_of_mean<Basis>(local);
      repeat<Dim>([&](auto j) { g.L[j][j] += more; });
      if constexpr (is_axisymmetric<Basis>) g.hoop += more;
    }
    const T Omega = p.load(points.volume) * determinant_of_stretch(g.L) * (T(1.0) + g.hoop);  // eq. 14, finite
    p.store(Omega, volume);
    const T dilation = g.trace();
    if (middle_) {
      T hoop(0.0);
      if constexpr (is_axisymmetric<Basis>) hoop = g.hoop / fma(T(0.5), g.hoop, T(1.0));
      store_increments(strain_and_spin_of_middle(g.L, hoop), increments, at);
    } else {
      store_increments(strain_and_spin_of(g.L, g.hoop), increments, at);
    }
    (T(element_.weight) * Omega * (T(1.0) - T(0.5) * dilation)).store_unaligned(increments.volume.data() + at);
    T per_mass = T(stiffer_) * Omega / m;
    if constexpr (is_simplex<Basis>) per_mass = max(per_mass, T(element_.least_per_mass));
    per_mass.store_unaligned(increments.per_mass.data() + at);
    return Omega;
  }

 private:
  const ElementMotion<Basis>& element_;
  bool middle_;
  double per_size2_, stiffer_;
  Field<Basis, 2 * Dim> motion_;
  CorrectedGradients<Basis> corrected_;
};

}  // namespace scarp::transfer
