// A manufactured solution: the unit square between smooth walls, axis-aligned and neo-Hookean (after Kamojjala et al.
// 2015, Verification tests in solid mechanics, Eng. Comput. 31).
//
// u_i = A sin(πX_i) sin(cπt + φ_i), φ_x = 0, φ_y = π, c² = E/ρ. F is diagonal, F_i = 1 + Aπ cos(πX_i) sin(cπt + φ_i),
// J = F_x F_y in plane strain. The first Piola–Kirchhoff stress of the law is P_i = (λ ln J + μ (F_i² − 1))/F_i; of F_j
// only F_i depends on X_i, with F_i' = −π² u_i, so that
//     dP_i/dX_i = F_i' [λ (1 − ln J)/F_i² + μ (1 + 1/F_i²)],
// and ρ ü_i = dP_i/dX_i + ρ b_i with ü_i = −c²π² u_i gives
//     b_i = π² u_i [λ (1 − ln J)/(ρ F_i²) + (μ/ρ)(1 + 1/F_i²) − c²].
// On the walls X_i = 0 and 1 the component u_i vanishes, and there is no shear stress: smooth walls.
#pragma once

#include <numbers>

#include "driven.hpp"

namespace scarp::verification {

struct Manufactured {
  double A;
  Solid solid{1000, 0.3, 1000};

  double c() const { return std::sqrt(solid.E / solid.rho); }
  double period() const { return 2 / c(); }

  Vec<2> displacement(const Vec<2>& X, double t) const {
    return {A * std::sin(pi * X[0]) * std::sin(c() * pi * t), -A * std::sin(pi * X[1]) * std::sin(c() * pi * t)};
  }
  Vec<2> velocity(const Vec<2>& X, double t) const {
    const double rate = A * c() * pi * std::cos(c() * pi * t);
    return {rate * std::sin(pi * X[0]), -rate * std::sin(pi * X[1])};
  }
  Vec<2> stretch(const Vec<2>& X, double t) const {
    const double strain = A * pi * std::sin(c() * pi * t);
    return {1 + strain * std::cos(pi * X[0]), 1 - strain * std::cos(pi * X[1])};
  }
  Vec<2> force(const Vec<2>& X, double t) const {
    const Vec<2> u = displacement(X, t), F = stretch(X, t);
    const double ln_J = std::log(F[0] * F[1]), rho = solid.rho;
    Vec<2> b;
    for (int i = 0; i < 2; ++i) {
      const double per_F2 = 1 / (F[i] * F[i]);
      b[i] =
          pi * pi * u[i] * (solid.lambda() * (1 - ln_J) * per_F2 / rho + solid.mu() / rho * (1 + per_F2) - c() * c());
    }
    return b;
  }
  std::array<double, 4> stress(const Vec<2>& X, double t) const {
    const Vec<2> F = stretch(X, t);
    const double J = F[0] * F[1], pressure = solid.lambda() * std::log(J);
    return {(pressure + solid.mu() * (F[0] * F[0] - 1)) / J, (pressure + solid.mu() * (F[1] * F[1] - 1)) / J,
            pressure / J, 0};
  }

  static constexpr double pi = std::numbers::pi;
};

/// One period on n × n elements with per_cell points along each side of one.
inline DrivenErrors follow_manufactured(double A, int n, int per_cell, const Method& method, double safety = 0.4) {
  const Manufactured motion{A};
  auto body = on_grid({0, 0}, {1, 1}, {n, n}, {0, 0}, method.shape);
  add_box(body, motion.solid.neo_hookean(), motion.solid.rho, {0, 0}, {1, 1}, {per_cell * n, per_cell * n});
  locate_points(body);
  for (const char* side : {"left", "right"}) fix(body.conditions, body.mesh->node_sets.at(side), 0);
  for (const char* side : {"bottom", "top"}) fix(body.conditions, body.mesh->node_sets.at(side), 1);
  const int steps = steps_to(motion.period(), safety, 1.0 / n, motion.solid.wave_speed());
  return follow(body, motion, motion.period(), steps, method.settings());
}

}  // namespace scarp::verification
