// The initial imbalance let go over some time (step/release.hpp): a column of elastic soil without stress takes its
// weight.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "body_maker.hpp"

namespace scarp::verification {
namespace {

constexpr double g = 10, rho = 2, E = 1e5, H = 1;
const double period = 4 * H / std::sqrt(E / rho);  // of its slowest vibration

struct Settled {
  double lowest = 0, highest = 0;  ///< of the top point, after the weight is on, over the static settlement
  double energy_error = 0;         ///< at the end, over the work of gravity
};

/// The column that is let go over `time` and watched for two periods more.
Settled let_go(double time) {
  auto body = on_grid({0, 0}, {0.1, 1.1}, {1, 22}, {0, -g});
  add_box(body, linear_elastic(E, 0), rho, {0, 0}, {0.1, H}, {2, 40});
  locate_points(body);
  for (const char* side : {"left", "right"}) fix(body.conditions, body.mesh->node_sets.at(side), 0);
  fix(body.conditions, body.mesh->node_sets.at("bottom"), 1);
  const double dt = 0.3 * critical_time_step(body), weight = rho * g * H * H / (2 * E);
  const auto& points = body.blocks()[0].points;
  int top = 0;
  for (int p = 0; p < points.size(); ++p) top = points.x[1][p] > points.x[1][top] ? p : top;

  hold_imbalance(body, {});
  Settled its{1e300, -1e300};
  double balanced = 0, gravity = 0, kinetic = 0;
  for (double t = 0; t < time + 2 * period; t += dt) {
    body.fields[0].outside.release.share = time > 0 ? std::max(0.0, 1 - t / time) : 0;
    const auto totals = advance(body, dt, {});
    balanced += totals.work_gravity + totals.work_release - totals.work_stress;
    gravity += totals.work_gravity;
    kinetic = totals.kinetic_energy;
    if (t < time) continue;
    its.lowest = std::min(its.lowest, -points.u(1, top) / weight);
    its.highest = std::max(its.highest, -points.u(1, top) / weight);
  }
  its.energy_error = (kinetic - balanced) / gravity;
  return its;
}

TEST(Release, OverOnePeriodLeavesNoVibration) {
  // A load that grows over T leaves a mode of frequency ω with |sin(ωT/2)| / (ωT/2) of its static share: nothing of all
  // modes n = 1, 3, 5 … of the column at T = 4H/c.
  const auto its = let_go(period);
  EXPECT_NEAR(its.lowest, 1, 0.01);
  EXPECT_NEAR(its.highest, 1, 0.01);
  EXPECT_LT(std::abs(its.energy_error), 0.01);
}

TEST(Release, OverOneAndAHalfPeriodsLeavesWhatTheFirstModeKeeps) {
  const double amplitude = 32 / std::pow(std::numbers::pi, 3) / (1.5 * std::numbers::pi);  // 0.219
  const auto its = let_go(1.5 * period);
  EXPECT_NEAR(its.lowest, 1 - amplitude, 0.015);
  EXPECT_NEAR(its.highest, 1 + amplitude, 0.015);
  EXPECT_LT(std::abs(its.energy_error), 0.01);
}

TEST(Release, AtOnceSwingsToTwiceTheSettlement) {
  const auto its = let_go(0);
  EXPECT_NEAR(its.lowest, 0, 0.02);
  EXPECT_NEAR(its.highest, 2, 0.02);
}

TEST(Release, HoldsSoilThatIsNotInBalanceWhereItIs) {
  auto body = on_grid({0, 0}, {2, 2}, {4, 4}, {1, -g});
  add_box(body, linear_elastic(E, 0.3), rho, {0.3, 0}, {1.3, 1}, {4, 4});
  locate_points(body);
  wall(body.conditions, *body.mesh, body.mesh->node_sets.at("bottom"), 1, 0.05);  // not enough to hold it
  hold_imbalance(body, {});
  StepSettings settings;
  settings.scheme.wall = WallRule::by_motion;
  for (int n = 0; n < 10; ++n) {
    const auto totals = advance(body, 1e-3, settings);
    EXPECT_LT(totals.unbalanced_force, 1e-13 * totals.weight);
  }
  for (const auto& v : body.blocks()[0].points.v) {
    for (const double component : v) EXPECT_LT(std::abs(component), 1e-14);
  }
}

}  // namespace
}  // namespace scarp::verification
