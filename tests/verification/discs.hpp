// Discs of neo-Hookean solid in the unit square: two that collide (Sulsky, Chen & Schreyer 1994, A particle method for
// history-dependent materials, Comput. Methods Appl. Mech. Eng. 118), and one that turns.
#pragma once

#include <numbers>

#include "driven.hpp"

namespace scarp::verification {

/// Places over a disc of radius R: ring k of `rings` equal widths has 4 (2k − 1) points, so that all stand for the same
/// area; each is where its ring's mean r² is, so that mass and moment of inertia are exact.
inline std::vector<Place> disc(const Vec<2>& centre, double R, int rings) {
  std::vector<Place> places;
  const double width = R / rings, area = std::numbers::pi * width * width / 4;
  for (int k = 1; k <= rings; ++k) {
    const double r = width * std::sqrt(0.5 * (k * k + (k - 1) * (k - 1)));
    const int pieces = 4 * (2 * k - 1);
    for (int i = 0; i < pieces; ++i) {
      const double theta = 2 * std::numbers::pi * (i + 0.5) / pieces;
      places.push_back({{centre[0] + r * std::cos(theta), centre[1] + r * std::sin(theta)}, area});
    }
  }
  return places;
}

/// Momenta and energies of all points as they are.
struct Motions {
  Vec<2> momentum{};
  double angular_momentum = 0;  ///< about a point
  double kinetic = 0, stored = 0;
};

/// Σ Ω₀ W(b) is the energy stored, from the law's own state: W = ½ μ (tr b − 3) − μ ln J + ½ λ (ln J)².
inline Motions motions_of(const Body<2>& body, const Solid& solid, const Vec<2>& about) {
  Motions sum;
  for (const auto& block : body.blocks()) {
    const auto& points = block.points;
    for (int p = 0; p < points.size(); ++p) {
      const double m = points.mass[p];
      const Vec<2> v{points.v[0][p], points.v[1][p]}, r{points.x[0][p] - about[0], points.x[1][p] - about[1]};
      for (int j = 0; j < 2; ++j) sum.momentum[j] += m * v[j];
      sum.angular_momentum += m * (r[0] * v[1] - r[1] * v[0]);
      sum.kinetic += 0.5 * m * (v[0] * v[0] + v[1] * v[1]);
      const double xx = block.state[0][p], yy = block.state[1][p], zz = block.state[2][p], xy = block.state[3][p];
      const double ln_J = 0.5 * std::log((xx * yy - 0.5 * xy * xy) * zz);
      sum.stored += points.initial_volume[p] *
                    (0.5 * solid.mu() * (xx + yy + zz - 3) - solid.mu() * ln_J + 0.5 * solid.lambda() * ln_J * ln_J);
    }
  }
  return sum;
}

/// A moment of a run; velocities live half a step before or after positions, so that the kinetic energy beside the
/// stored one is the mean of the two around it.
struct Moment {
  double t, kinetic, stored, angular_momentum;
};

struct DiscRun {
  std::vector<Moment> history;
  double momentum = 0;  ///< largest |Σ m v − its start| over Σ m |v| at the start
};

/// Steps of 0.3 critical ones at the start until `end`.
inline DiscRun run_discs(Body<2>& body, const Solid& solid, double end, const Method& method, double safety = 0.3) {
  constexpr Vec<2> centre{0.5, 0.5};
  DiscRun run;
  const Motions start = motions_of(body, solid, centre);
  double size = 0;
  for (const auto& block : body.blocks()) {
    for (int p = 0; p < block.size(); ++p)
      size += block.points.mass[p] * std::hypot(block.points.v[0][p], block.points.v[1][p]);
  }
  run.history.push_back({0, start.kinetic, start.stored, start.angular_momentum});
  Motions before = start;
  run_until(body, end, safety, method.settings(), [&](double t, const StepTotals<2>&) {
    const Motions now = motions_of(body, solid, centre);
    run.momentum = std::max(
        run.momentum, std::hypot(now.momentum[0] - start.momentum[0], now.momentum[1] - start.momentum[1]) / size);
    if (run.history.size() > 1) run.history.back().kinetic = 0.5 * (before.kinetic + now.kinetic);
    run.history.push_back({t, now.kinetic, now.stored, now.angular_momentum});
    before = now;
  });
  return run;
}

inline constexpr Solid disc_solid{1000, 0.3, 1000};
inline constexpr double disc_radius = 0.2;

/// Two discs with velocities ±(0.1, 0.1) on n × n elements, about five points in each; t = 3 is long after they part.
inline DiscRun collide(int n, const Method& method, double end = 3) {
  auto body = on_grid({0, 0}, {1, 1}, {n, n}, {0, 0}, method.shape);
  const int rings = static_cast<int>(std::lround(2 * disc_radius * n));
  for (const double side : {-1.0, 1.0}) {
    auto& block = add_points(body, disc_solid.neo_hookean(), disc_solid.rho,
                             disc({0.5 + 0.25 * side, 0.5 + 0.25 * side}, disc_radius, rings));
    for (int p = 0; p < block.size(); ++p) block.points.v[0][p] = block.points.v[1][p] = -0.1 * side;
  }
  locate_points(body);
  return run_discs(body, disc_solid, end, method);
}

inline constexpr double disc_spin = 0.5;  ///< Ω: once around by t = 4π

/// A disc that turns about the middle of the square, not yet stressed.
inline Body<2> turning_disc(int n, const Method& method) {
  constexpr double Omega = disc_spin;
  auto body = on_grid({0, 0}, {1, 1}, {n, n}, {0, 0}, method.shape);
  const int rings = static_cast<int>(std::lround(2 * disc_radius * n));
  auto& block = add_points(body, disc_solid.neo_hookean(), disc_solid.rho, disc({0.5, 0.5}, disc_radius, rings));
  for (int p = 0; p < block.size(); ++p) {
    block.points.v[0][p] = -Omega * (block.points.x[1][p] - 0.5);
    block.points.v[1][p] = Omega * (block.points.x[0][p] - 0.5);
  }
  locate_points(body);
  return body;
}

inline DiscRun turn_disc(int n, const Method& method, double turns = 1) {
  auto body = turning_disc(n, method);
  return run_discs(body, disc_solid, turns * 2 * std::numbers::pi / disc_spin, method);
}

}  // namespace scarp::verification
