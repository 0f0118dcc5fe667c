// Nodes → points for the points of one element: the sums of the report's steps 4 to 6 and 8 to 10, in its symbols, for
// every basis and dimension; a point in each lane. No loops over the mesh and no threads here. Tension positive.
#pragma once

#include <array>

#include "scarp/transfer/gradient_correction.hpp"
#include "scarp/transfer/means.hpp"
#include "scarp/transfer/node_values.hpp"
#include "scarp/transfer/point_increments.hpp"
#include "scarp/transfer/simd/fields.hpp"

namespace scarp::transfer {

/// Sums over points of what moves, a lane for itself each.
template <int Dim>
struct MotionSums {
  using T = PointBatch<Dim>;
  T mass = T(0.0), kinetic_energy = T(0.0), taken = T(0.0), fastest2 = T(0.0);
  std::array<T, Dim> momentum;

  MotionSums() { momentum.fill(T(0.0)); }
};

/// What an element has for its points in steps 4 to 10.
template <class Basis>
struct ElementMotion {
  NodeRows<Basis> motion;                   ///< Motion of each local node
  NodeRows<Basis> a_dt;                     ///< change of velocity of pure FLIP of each; only where points book PIC
  const double* correction;                 ///< GradientCorrection of its quadrature, as stored
  double weight, size;                      ///< w of its quadrature, and its least height
  const double* hoop_correction = nullptr;  ///< that of N_i / r, in a body of revolution
  double mean_dilation = 0;                 ///< volume strain of its points, where that is a mean
  double least_per_mass = 0;                ///< a bound from below of PointIncrements::per_mass; in simplices
};

/// How points are moved and strained.
struct MotionRules {
  double flip = 1;      ///< φ
  bool middle = false;  ///< strain of the middle of the step
  bool affine = false;  ///< points keep the gradient of their velocity, C_p
  double dt = 0;        ///< [s]; asked for with `affine`
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

/// Steps 4 (eq. 6: v_p = φ v_p + Σ c_i N_i; step.cpp), 6, 8, 9 and 10: L dt = Σ du_i ⊗ B_i (eq. 9), strain and
/// spin increments (eqs 10, 11) to `increments` from place `at` on, volume by det(I + L dt) (eq. 14 in its finite form;
/// the density of eq. 15 is m_p / Ω_p), and position (eqs 17–19; the displacement is x_p less x_p at the start). Then
/// moved(lanes, x, motion there before) for each batch.
template <bool pic, class Basis, class Averaged, class F>
inline void nodes_to_points(const typename Basis::Cell& cell, const ElementMotion<Basis>& element,
                            const MotionRules& rules, Points<Basis::dim>& points, const PointRange& range,
                            PointIncrements<Basis::dim>& increments, int at, Averaged averaged,
                            MotionSums<Basis::dim>& sums, F&& moved) {
  constexpr int Dim = Basis::dim;
  using T = PointBatch<Dim>;
  const Field<Basis, 2 * Dim> motion(cell, element.motion);
  const Field<Basis, Dim, Rows::just> a_dt(cell, pic ? element.a_dt : element.motion);
  const CorrectedGradients<Basis> corrected(element.motion, element.correction);
  const double w = element.weight, per_size2 = 1 / (element.size * element.size),
               stiffer = w > 1 ? w * per_size2 : per_size2;
  for_each_batch_of_element<T>(range, [&](const auto& p, int first) {
    const auto local = local_coordinates<Basis>(cell, points, p);
    const auto here = motion.at(local);
    const T m = p.load(points.mass);
    std::array<T, Dim> x;
    T v2(0.0);
    auto g = gradients_at<Basis>(element, corrected, motion, here, local, p.load(points.x[0]));
    repeat<Dim>([&](auto j) {
      const T v_t = p.load(points.v[j]), v = fma(T(rules.flip), v_t, here.value(j));  // eq. 6
      p.store(v, points.v[j]);
      v2 = fma(v, v, v2);
      sums.momentum[j] = fma(m, v, sums.momentum[j]);
      if constexpr (pic) {
        const T v_flip = v_t + a_dt.at(local).value(j);
        sums.taken = fma(m, v_flip * v_flip - v * v, sums.taken);
      }
      x[j] = p.load(points.x[j]) + here.value(Dim + j);  // eq. 17 and eq. 19
      p.store(x[j], points.x[j]);
    });
    if constexpr (pic) {
      if (rules.affine) {
        repeat<Dim>([&](auto j) {
          repeat<Dim>(
              [&](auto k) { p.store(here.template derivative<k>(Dim + j) * T(1 / rules.dt), points.C[j * Dim + k]); });
        });
      }
    }
    sums.mass += m;
    sums.kinetic_energy = fma(m, v2, sums.kinetic_energy);
    sums.fastest2 = max(sums.fastest2, select(m > T(0.0), v2, T(0.0)));  // lanes without a point have any v
    if (averaged) {
      T more = (T(element.mean_dilation) - g.trace()) * T(1.0 / mean_directions<Basis>);
      if constexpr (keeps_means<Basis>) more *= share_of_mean<Basis>(local);
      repeat<Dim>([&](auto j) { g.L[j][j] += more; });
      if constexpr (is_axisymmetric<Basis>) g.hoop += more;
    }
    const T Omega = p.load(points.volume) * determinant_of_stretch(g.L) * (T(1.0) + g.hoop);  // eq. 14, finite
    p.store(Omega, points.volume);
    const T dilation = g.trace();
    if (rules.middle) {
      T hoop(0.0);
      if constexpr (is_axisymmetric<Basis>) hoop = g.hoop / fma(T(0.5), g.hoop, T(1.0));
      store_increments(strain_and_spin_of_middle(g.L, hoop), increments, at + first);
    } else {
      store_increments(strain_and_spin_of(g.L, g.hoop), increments, at + first);
    }
    (T(w) * Omega * (T(1.0) - T(0.5) * dilation)).store_unaligned(increments.volume.data() + at + first);
    T per_mass = T(stiffer) * Omega / m;
    if constexpr (is_simplex<Basis>) per_mass = max(per_mass, T(element.least_per_mass));
    per_mass.store_unaligned(increments.per_mass.data() + at + first);
    (T(per_size2) * v2).store_unaligned(increments.speed2.data() + at + first);
    moved(p, x, here);
  });
}

}  // namespace scarp::transfer
