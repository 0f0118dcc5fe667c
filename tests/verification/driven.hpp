// Bodies whose motion x = X + u(X, t) is prescribed, and the body force b(X, t) that drives it derived from that.
//
// Time levels. A step makes v^{n+1} = v^n + (a(x^n) + b(t_n)) dt and x^{n+1} = x^n + v^{n+1} dt. Without v these are
//     (x^{n+1} − 2 x^n + x^{n−1})/dt² = a(x^n) + b(t_n),
// the central difference, of second order. Positions and stresses live at t_n, velocities half a step before: v^n is
// v(t_n − dt/2). A start with v(−dt/2) makes x^1 right to O(dt³); one with v(0) would leave an error ½ a dt in all
// velocities, of first order. Displacements and stresses are compared at t_n, after n steps. (What is of first order in
// dt is the law's strain: L dt for ln(1 + L dt). It errs by ½ ∫ L² dt dt, nothing at small strain.)
//
// The force. Eq. 3 would bring Σ m_p b_p N_i to the nodes, and eq. 6 bring Σ N_i (Σ m_q b_q N_i)/m_i dt back to point
// p: b smoothed by a mapping there and back, an error of O(h²) in the smooth field. Here the points take b itself, v_p
// += b(X_p, t_n) dt before the step. Since eqs 2 to 6 are linear in the points' velocities, and pure FLIP never
// replaces them, v_p^{n+1} is that of eq. 6 with b_p in place of its smoothed self: consistent, and with no error of
// the force's own. At held nodes eq. 3 would be balanced by the support: there b has to vanish, as it does where u = 0
// (case 4), or nothing is held (case 5).
#pragma once

#include "method.hpp"

namespace scarp::verification {

struct DrivenErrors {
  double displacement;  ///< relative L2 error over all points and all steps
  double stress;        ///< likewise, of all components
};

/// Places of the points in order of their number.
inline std::vector<Vec<2>> accumulators_of(const Body<2>& body) {
  std::vector<Vec<2>> X(body.point_count());
  for (const auto& block : body.blocks()) {
    for (int p = 0; p < block.size(); ++p) X[block.points.id[p]] = position_of(block.points, p);
  }
  return X;
}

/// f(block, p, X, id) for every point.
template <class F>
void for_each_point(Body<2>& body, const std::vector<Vec<2>>& X, F&& f) {
  for (auto& block : body.blocks()) {
    for (int p = 0; p < block.size(); ++p) f(block.points, p, X[block.points.id[p]]);
  }
}

/// Adds the errors of the body as it is at time t. A Motion has displacement(X, t), velocity(X, t), force(X, t) per
/// unit of mass, and stress(X, t), in Mandel components.
template <class Motion>
void compare(Body<2>& body, const std::vector<Vec<2>>& X, const Motion& motion, double t, RelativeL2& displacement,
             RelativeL2& stress) {
  for_each_point(body, X, [&](const Points<2>& points, int p, const Vec<2>& at) {
    const Vec<2> u = motion.displacement(at, t);
    const auto sigma = motion.stress(at, t);
    const double w = points.initial_volume[p];
    for (int j = 0; j < 2; ++j) displacement.add(w, points.u(j, p), u[j]);
    for (int c = 0; c < 4; ++c) stress.add(w, points.sigma[c][p], sigma[c]);
  });
}

/// Follows a motion that starts from X, and that the body's points stand at.
template <class Motion>
DrivenErrors follow(Body<2>& body, const Motion& motion, double end, int steps, const StepSettings& settings) {
  const auto X = accumulators_of(body);
  const double dt = end / steps;
  for_each_point(body, X, [&](Points<2>& points, int p, const Vec<2>& at) {
    const Vec<2> v = motion.velocity(at, -dt / 2);
    for (int j = 0; j < 2; ++j) points.v[j][p] = v[j];
  });
  RelativeL2 displacement, stress;
  for (int n = 0; n < steps; ++n) {
    for_each_point(body, X, [&](Points<2>& points, int p, const Vec<2>& at) {
      const Vec<2> b = motion.force(at, n * dt);
      for (int j = 0; j < 2; ++j) points.v[j][p] += b[j] * dt;
    });
    advance(body, dt, settings);
    compare(body, X, motion, (n + 1) * dt, displacement, stress);
  }
  return {displacement.value(), stress.value()};
}

/// Whole number of steps to `end` of at most `safety` of the time in which a wave crosses an element of size h.
inline int steps_to(double end, double safety, double h, double wave_speed) {
  return static_cast<int>(std::ceil(end * wave_speed / (safety * h)));
}

}  // namespace scarp::verification
