// What counts as rest, for a body that is moved by hand and a ledger that says what it is told.
#include "scarp/run/rest_watch.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>

#include "scarp/mesh/grid.hpp"

namespace scarp::run {
namespace {

constexpr double dt = 1e-3, g = 10, H = 10;

/// Two points, H apart, which weigh 1 each.
Body<2> pillar(double gravity = g) {
  Body<2> body(std::make_unique<const Mesh<2>>(make_grid<2>({0, 0}, {20, 20}, {4, 4})), {0, -gravity});
  Block<2> block("soil", LinearElastic({1e4, 0.3}));
  resize(block, 2);
  for (int p = 0; p < 2; ++p) {
    block.points.id[p] = p;
    block.points.mass[p] = 1;
    block.points.x[0][p] = 5;
    block.points.x[1][p] = 5 + H * p;
  }
  body.fields[0].blocks.push_back(std::move(block));
  return body;
}

/// A step in balance with this kinetic energy.
Ledger<2> in_balance(double kinetic = 0) {
  Ledger<2> ledger;
  ledger.dt = dt;
  ledger.last.weight = 2 * g;
  ledger.last.kinetic_energy = kinetic;
  return ledger;
}

/// Steps until the watch says so, at most `most`; the upper point is at 15 + place(t).
template <class F>
int steps_to_rest(const input::RestInput& rest, Body<2> body, int most, F&& place) {
  RestWatch<2> watch(rest, body);
  for (int n = 1; n <= most; ++n) {
    body.blocks()[0].points.x[0][1] = 5 + place(n * dt);
    if (watch.at_rest(in_balance(), body)) return n;
  }
  return most + 1;
}

TEST(RestWatch, WaitsForItsHold) {
  // A tenth of √(H/g) is 0.1 s.
  EXPECT_EQ(steps_to_rest({}, pillar(), 1000, [](double) { return 0.0; }), 100);
  EXPECT_EQ(steps_to_rest({.hold = 0.2}, pillar(), 1000, [](double) { return 0.0; }), 200);
  EXPECT_EQ(steps_to_rest({}, pillar(0), 1000, [](double) { return 0.0; }), 1);
}

TEST(RestWatch, SeesAPointThatCreeps) {
  const auto creep = [](double v) { return [v](double t) { return v * t; }; };
  EXPECT_EQ(steps_to_rest({}, pillar(), 1000, creep(1.9e-5 * H)), 100);
  EXPECT_EQ(steps_to_rest({}, pillar(), 1000, creep(2.1e-5 * H)), 1001);
  EXPECT_EQ(steps_to_rest({.rate = 1e-3, .hold = 0.5}, pillar(), 1000, creep(0.9e-3 * H)), 500);
}

TEST(RestWatch, ForgivesAPointThatVibratesInItsPlace) {
  // 20 µm at 50 Hz: 6 mm/s at most, thirty times the rate, and no further than 40 µm in a tenth of a second.
  EXPECT_LE(steps_to_rest({.hold = 0.4}, pillar(), 1000,
                          [](double t) { return 2e-5 * std::sin(2 * std::numbers::pi * 50 * t); }),
            500);
}

TEST(RestWatch, NoticesThatCreepHasEnded) {
  const int steps = steps_to_rest({}, pillar(), 2000, [](double t) { return 0.01 * (1 - std::exp(-t / 0.05)); });
  // 0.2 m/s in e-folds of 0.05 s: 2e-4 m/s after 0.35 s, and one window or two.
  EXPECT_GT(steps, 350);
  EXPECT_LE(steps, 550);
}

TEST(RestWatch, BeginsAnewWhereItIsDisturbed) {
  auto body = pillar();
  RestWatch<2> watch({}, body);
  const double moving = 2 * 1e-6 * 2 * g * H;  // twice what still counts
  for (int n = 1; n <= 190; ++n) EXPECT_EQ(watch.at_rest(in_balance(n == 90 ? moving : 0), body), n == 190) << n;
  EXPECT_NEAR(watch.kinetic(in_balance(moving)), 2e-6, 1e-18);
}

}  // namespace
}  // namespace scarp::run
