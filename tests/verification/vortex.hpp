// The generalised vortex (after Kamojjala et al. 2015): a ring whose shells turn against each other and back.
//
// Shell R of the ring 3/4 ≤ R ≤ 5/4 turns by α = A sin(cπt) g(R), g = (4R−3)²(4R−5)². Then F = e_r E_R + κ e_θ E_R +
// e_θ E_θ with κ = R α', J = 1, and the neo-Hookean stress is σ_rθ = μκ, σ_θθ = μκ². Balance in the deformed radial and
// circumferential directions, with the accelerations −R α̇² and R α̈:
//     b_r = −R α̇² + μ R α'²/ρ,    b_θ = R α̈ − (μ/ρ)(R α'' + 3 α').
// With g' = 64 (4R−3)(4R−5)(R−1) and R g'' + 3 g' = 64 (96R³ − 240R² + 188R − 45) these are the expressions below. At
// both edges g = g' = 0: they neither move nor carry stress, and nothing is held.
#pragma once

#include <numbers>

#include "driven.hpp"

namespace scarp::verification {

struct Vortex {
  double A = 1, rate = std::numbers::pi;  ///< of the sine, cπ
  Solid solid{1000, 0.3, 1000};

  static constexpr double inner = 0.75, outer = 1.25;

  static double g(double R) { return (4 * R - 3) * (4 * R - 3) * (4 * R - 5) * (4 * R - 5); }
  static double dg(double R) { return 64 * (4 * R - 3) * (4 * R - 5) * (R - 1); }

  struct Polar {
    double R, theta, alpha;
    Vec<2> radial() const { return {std::cos(theta + alpha), std::sin(theta + alpha)}; }
  };
  Polar polar(const Vec<2>& X, double t) const {
    const double R = std::hypot(X[0], X[1]);
    return {R, std::atan2(X[1], X[0]), A * std::sin(rate * t) * g(R)};
  }
  /// Components along the deformed radius and across it to x and y.
  static Vec<2> turned(const Vec<2>& e, double r, double theta) {
    return {r * e[0] - theta * e[1], r * e[1] + theta * e[0]};
  }

  Vec<2> displacement(const Vec<2>& X, double t) const {
    const auto at = polar(X, t);
    const Vec<2> e = at.radial();
    return {at.R * e[0] - X[0], at.R * e[1] - X[1]};
  }
  Vec<2> velocity(const Vec<2>& X, double t) const {
    const auto at = polar(X, t);
    return turned(at.radial(), 0, at.R * A * rate * std::cos(rate * t) * g(at.R));
  }
  Vec<2> force(const Vec<2>& X, double t) const {
    const auto at = polar(X, t);
    const double R = at.R, s = A * std::sin(rate * t), C = A * std::cos(rate * t), per_rho = solid.mu() / solid.rho;
    const double b_r = -R * C * C * rate * rate * g(R) * g(R) + per_rho * R * s * s * dg(R) * dg(R);
    const double polynomial = ((96 * R - 240) * R + 188) * R - 45;
    return turned(at.radial(), b_r, -s * (R * rate * rate * g(R) + 64 * per_rho * polynomial));
  }
  std::array<double, 4> stress(const Vec<2>& X, double t) const {
    const auto at = polar(X, t);
    const double kappa = at.R * A * std::sin(rate * t) * dg(at.R), mu = solid.mu();
    const Vec<2> e = at.radial(), f{-e[1], e[0]};
    const auto component = [&](int j, int k) {
      return mu * (kappa * (e[j] * f[k] + f[j] * e[k]) + kappa * kappa * f[j] * f[k]);
    };
    return {component(0, 0), component(1, 1), 0, sqrt2 * component(0, 1)};
  }
};

/// Places over a ring: shells h/per_cell thick, cut into pieces about as long.
inline std::vector<Place> ring(double inner, double outer, double spacing) {
  std::vector<Place> places;
  const int shells = static_cast<int>(std::lround((outer - inner) / spacing));
  for (int k = 0; k < shells; ++k) {
    const double low = inner + (outer - inner) * k / shells, high = inner + (outer - inner) * (k + 1) / shells;
    const double R = 0.5 * (low + high), whole = std::numbers::pi * (high * high - low * low);
    const int pieces = static_cast<int>(std::lround(2 * std::numbers::pi * R / spacing));
    for (int i = 0; i < pieces; ++i) {
      const double theta = 2 * std::numbers::pi * (i + 0.5) / pieces;
      places.push_back({{R * std::cos(theta), R * std::sin(theta)}, whole / pieces});
    }
  }
  return places;
}

/// From rest through the largest turn and back, 0 ≤ t ≤ 1, on n × n elements over a square of side 3.
inline DrivenErrors follow_vortex(double A, int n, int per_cell, const Method& method, double safety = 0.4) {
  const Vortex motion{A};
  const double h = 3.0 / n;
  auto body = on_grid({-1.5, -1.5}, {1.5, 1.5}, {n, n}, {0, 0}, method.shape);
  add_points(body, motion.solid.neo_hookean(), motion.solid.rho, ring(Vortex::inner, Vortex::outer, h / per_cell));
  locate_points(body);
  // Points move at up to π, three times as fast as waves.
  const int steps = steps_to(1, safety, h, motion.solid.wave_speed() + A * motion.rate);
  return follow(body, motion, 1, steps, method.settings());
}

}  // namespace scarp::verification
