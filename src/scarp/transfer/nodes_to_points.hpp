// Nodes → points for the points of one element: the sums of the report's steps 4 to 6 and 8 to 10, in its symbols, for
// every basis and dimension; a point in each lane. No loops over the mesh and no threads here. Tension positive.
#pragma once

#include <array>

#include "scarp/transfer/increments_at_points.hpp"

namespace scarp::transfer {

/// Sums over points of what moves, a lane for itself each.
template <int Dim>
struct MotionSums {
  using T = PointBatch<Dim>;
  T mass = T(0.0), kinetic_energy = T(0.0), taken = T(0.0), fastest2 = T(0.0);
  std::array<T, Dim> momentum;
  Mask<T> no_volume = T(0.0) > T(0.0);  ///< has a point none, or less?

  MotionSums() { momentum.fill(T(0.0)); }
};

/// How points are moved and strained.
struct MotionRules {
  double flip = 1;      ///< φ
  bool middle = false;  ///< strain of the middle of the step
  bool affine = false;  ///< points keep the gradient of their velocity, C_p
  double dt = 0;        ///< [s]; asked for with `affine`
};

/// Eqs 6 and 17 to 19 for some points, where the motion of the nodes is `here`: v_p = φ v_p + Σ c_i N_i (step.cpp) and
/// x_p += Σ du_i N_i; the displacement of eq. 18 is x_p less x_p at the start. `flip_change(j)` is the change of
/// velocity of pure FLIP, of which `pic` books what PIC takes. Returns |v_p|², and sets x to the places.
template <bool pic, int Dim, class Lanes, class Here, class FlipChange, class Places>
inline PointBatch<Dim> move(Points<Dim>& points, const Lanes& p, const PointBatch<Dim>& m, const MotionRules& rules,
                            const Here& here, FlipChange&& flip_change, Places& x, MotionSums<Dim>& sums) {
  using T = PointBatch<Dim>;
  T v2(0.0);
  repeat<Dim>([&](auto j) {
    const T v_t = p.load(points.v[j]), v = fma(T(rules.flip), v_t, here.value(j));  // eq. 6
    p.store(v, points.v[j]);
    v2 = fma(v, v, v2);
    sums.momentum[j] = fma(m, v, sums.momentum[j]);
    if constexpr (pic) {
      const T v_flip = v_t + flip_change(j);
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
  return v2;
}

/// Steps 4, 6, 8, 9 and 10 for the points of an element in a range: what strains them (increments_at_points.hpp), with
/// volumes to their own column, and what moves them. `a_dt`: rows of the change of velocity of pure FLIP of each node,
/// asked for with `pic`. Then moved(lanes, x, motion there before) for each batch.
template <bool pic, class Basis, class Averaged, class F>
inline void nodes_to_points(const typename Basis::Cell& cell, const ElementMotion<Basis>& element,
                            const NodeRows<Basis>& a_dt, const MotionRules& rules, Points<Basis::dim>& points,
                            const PointRange& range, PointIncrements<Basis::dim>& increments, int at, Averaged averaged,
                            MotionSums<Basis::dim>& sums, F&& moved) {
  constexpr int Dim = Basis::dim;
  using T = PointBatch<Dim>;
  const IncrementsAtPoints<Basis> of_element(cell, element, rules.middle);
  const Field<Basis, Dim, Rows::just> change(cell, pic ? a_dt : element.motion);
  for_each_batch_of_element<T>(range, [&](const auto& p, int first) {
    const auto local = local_coordinates<Basis>(cell, points, p);
    const auto here = of_element.motion().at(local);
    const T m = p.load(points.mass);
    const auto gradients = of_element.gradients(points, p, local, here);
    std::array<T, Dim> x;
    const auto flip_change = [&](int j) { return change.at(local).value(j); };
    const T v2 = move<pic>(points, p, m, rules, here, flip_change, x, sums);
    const T Omega = of_element.store(gradients, points, p, m, local, averaged, points.volume, increments, at + first);
    sums.no_volume = sums.no_volume || (m > T(0.0) && !(Omega > T(0.0)));
    (T(of_element.per_size2()) * v2).store_unaligned(increments.speed2.data() + at + first);
    moved(p, x, here);
  });
}

}  // namespace scarp::transfer
