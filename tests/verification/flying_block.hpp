// A block of 4 x 4 elements in free fall that turns: what a scheme keeps of its spin, and its fall.
#pragma once

#include "method.hpp"

namespace scarp::verification {

struct Flight {
  double spin;  ///< about the block's own centre of mass, after 1.2 rad, of that at the start
  double fall;  ///< largest |v / (g t) − 1| of the centre of mass
};

/// Angular momentum about the centre of mass, and the vertical velocity of that.
inline std::pair<double, double> spin_and_fall(const Body<2>& body) {
  double m = 0, L = 0;
  Vec<2> mx{}, mv{};
  for (const auto& block : body.blocks()) {
    const auto& points = block.points;
    for (int p = 0; p < points.size(); ++p) {
      const double mass = points.mass[p];
      m += mass;
      for (int j = 0; j < 2; ++j) {
        mx[j] += mass * points.x[j][p];
        mv[j] += mass * points.v[j][p];
      }
      L += mass * (points.x[0][p] * points.v[1][p] - points.x[1][p] * points.v[0][p]);
    }
  }
  return {L - (mx[0] * mv[1] - mx[1] * mv[0]) / m, mv[1] / m};
}

/// E = 10 MPa, 2 x 2 points per element of 1 m, one second at 1.2 rad/s.
inline Flight fly(const Scheme& scheme) {
  constexpr double g = 10, omega = 1.2;
  constexpr Vec<2> centre{6, 12};
  auto body = on_grid({0, 0}, {12, 16}, {12, 16}, {0, -g});
  auto& block = add_box(body, linear_elastic(1e4, 0.3), 2, {4, 10}, {8, 14}, {8, 8});
  for (int p = 0; p < block.size(); ++p) {
    block.points.v[0][p] = -omega * (block.points.x[1][p] - centre[1]);
    block.points.v[1][p] = omega * (block.points.x[0][p] - centre[0]);
  }
  locate_points(body, true);
  const double start = spin_and_fall(body).first;
  StepSettings settings;
  settings.scheme = scheme;
  Flight its{1, 0};
  run_until(body, 1, 0.5, settings, [&](double t, const StepTotals<2>&) {
    its.fall = std::max(its.fall, std::abs(spin_and_fall(body).second / (-g * t) - 1));
  });
  its.spin = spin_and_fall(body).first / start;
  return its;
}

}  // namespace scarp::verification
