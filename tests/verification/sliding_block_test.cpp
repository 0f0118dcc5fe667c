// A block that slides down an incline with friction.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "body_maker.hpp"

namespace scarp::verification {
namespace {

/// Travel of the centre of mass along an incline of angle `theta` with friction `mu` within `time`. The mesh lies along
/// the incline: gravity is inclined instead.
double travel(double theta, double mu, double time) {
  constexpr double g = 9.81, rho = 2, E = 1e4;
  auto body = on_grid({0, 0}, {5, 1.5}, {20, 6}, {g * std::sin(theta), -g * std::cos(theta)});
  auto& block = add_box(body, linear_elastic(E, 0.0), rho, {0.5, 0}, {1.5, 0.5}, {8, 4});
  for (int p = 0; p < block.size(); ++p)
    block.points.sigma[1][p] = -rho * g * std::cos(theta) * (0.5 - block.points.x[1][p]);
  locate_points(body);
  wall(body.conditions, *body.mesh, body.mesh->node_sets.at("bottom"), 1, mu);
  run_until(body, time, 0.3, {}, [](double, const StepBooks<2>&) {});
  double moved = 0;
  const auto& points = body.blocks[0].points;
  for (int p = 0; p < points.size(); ++p) moved += points.u(0, p) / points.size();
  return moved;
}

constexpr double theta = std::numbers::pi / 6;

TEST(SlidingBlock, TravelsAsCoulombFrictionSays) {
  // Oracle: ½ g (sin θ − μ cos θ) t²; 1.9874 m for θ = 30°, μ = 0.1, t = 0.99.
  const double exact = 0.5 * 9.81 * (std::sin(theta) - 0.1 * std::cos(theta)) * 0.99 * 0.99;
  EXPECT_NEAR(exact, 1.9874, 5e-5);
  const double moved = travel(theta, 0.1, 0.99);
  // Half a per cent: dt/t = 1.1e-3 of it, and the block rocks a little, as it starts without the shear that friction
  // gives it.
  EXPECT_NEAR(moved, exact, 0.005 * exact);
  std::printf("sliding block: %.4f m, exact %.4f m\n", moved, exact);
}

TEST(SlidingBlock, SlidesFreelyWithoutFriction) {
  const double exact = 0.5 * 9.81 * std::sin(theta) * 0.99 * 0.99;
  // Positions move with the velocity of the step's end: ½ g t (t + dt), dt/t = 1.1e-3.
  EXPECT_NEAR(travel(theta, 0.0, 0.99), exact, 2e-3 * exact);
}

TEST(SlidingBlock, SticksWhereFrictionIsLargerThanTheSlope) {
  // tan 30° = 0.577, and twice that for a weight that comes on suddenly: with μ = 1.5 only elastic shear remains, twice
  // ρ g sin θ H²/2G = 1.2e-4 m for a wide block, some times more for one that bends.
  EXPECT_LT(std::abs(travel(theta, 1.5, 0.99)), 1e-3);
}

}  // namespace
}  // namespace scarp::verification
