// A block that slides down an incline with friction.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "body_maker.hpp"

namespace scarp::verification {
namespace {

/// What a block along an incline of angle `theta` has done within `time`. The mesh lies along the incline: gravity is
/// inclined instead.
struct Slide {
  double moved, highest;  ///< of the centre of mass along the incline; of a point above the wall, at any time
  double energy_error;    ///< of the books, over the work of gravity
};

struct Block {
  double theta, mu, E, stress;  ///< stress: 1 starts with that of the block's own weight, 0 with none
  Scheme scheme = report_scheme();
  GridFunctions shape = GridFunctions::linear;
  double safety = 0.3;
};

Slide slide(const Block& its, double time) {
  constexpr double g = 9.81, rho = 2;
  const double g_N = g * std::cos(its.theta);
  auto body = on_grid({0, 0}, {5, 1.5}, {20, 6}, {g * std::sin(its.theta), -g_N}, its.shape);
  auto& block = add_box(body, linear_elastic(its.E, 0.0), rho, {0.5, 0}, {1.5, 0.5}, {8, 4});
  for (int p = 0; p < block.size(); ++p)
    block.points.sigma[1][p] = -its.stress * rho * g_N * (0.5 - block.points.x[1][p]);
  locate_points(body);
  wall(body.conditions, *body.mesh, body.mesh->node_sets.at("bottom"), 1, its.mu);
  double work = 0, highest = 0;  // the work of gravity less all that stress and friction took
  double gravity = 0, kinetic = 0;
  StepSettings settings;
  settings.scheme = its.scheme;
  run_until(body, time, its.safety, settings, [&](double, const StepTotals<2>& totals) {
    work += totals.work_gravity - totals.work_stress - totals.dissipation_friction;
    gravity += totals.work_gravity;
    kinetic = totals.kinetic_energy;
    for (const double y : body.blocks()[0].points.x[1]) highest = std::max(highest, y);
  });
  double moved = 0;
  const auto& points = body.blocks()[0].points;
  for (int p = 0; p < points.size(); ++p) moved += points.u(0, p) / points.size();
  return {moved, highest, (kinetic - work) / gravity};
}

double travel(double theta, double mu, double time) {
  return slide({theta, mu, 1e4, 1}, time).moved;
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

TEST(SlidingBlock, TravelsAsFreelyWithEveryOtherScheme) {
  // As above, 0.2 %: dt/t is 1.1e-3. The standard with its PIC share and damping of waves, too: they act on what
  // strains the block, not on its motion as a whole.
  for (const Scheme& scheme : {two_term_scheme(), apic_scheme()}) {
    for (const double mu : {0.0, 0.1}) {
      const double exact = 0.5 * 9.81 * (std::sin(theta) - mu * std::cos(theta)) * 0.99 * 0.99;
      const auto its = slide({theta, mu, 1e4, 1, scheme}, 0.99);
      EXPECT_NEAR(its.moved, exact, 2e-3 * exact);
      std::printf("sliding block, %s, friction %.1f: %+.3f %% of the way\n", scheme.affine ? "apic" : "two-term", mu,
                  100 * (its.moved / exact - 1));
    }
  }
}

/// A stiff block without stress, on which the weight comes suddenly: it bounces. By acceleration it is thrown out of
/// the mesh with friction (stability.md).
class StiffBlock : public testing::TestWithParam<GridFunctions> {};

TEST_P(StiffBlock, SlidesOnAWallByMotion) {
  Scheme by_motion = report_scheme();
  by_motion.wall = WallRule::by_motion;
  for (const double mu : {0.0, 0.1, 0.3}) {
    for (const double safety : {0.2, 0.9}) {
      const auto its = slide({theta, mu, 1e6, 0, by_motion, GetParam(), safety}, 0.99);
      const double exact = 0.5 * 9.81 * (std::sin(theta) - mu * std::cos(theta)) * 0.99 * 0.99;
      EXPECT_NEAR(its.moved, exact, 0.003 * exact) << "friction " << mu << ", safety " << safety;
      EXPECT_LT(its.highest, 0.5) << "it leaves the wall";
      EXPECT_LT(std::abs(its.energy_error), 0.01);
      std::printf("stiff block, friction %.1f, safety %.1f: %+.3f %% of the way, energy error %.1e\n", mu, safety,
                  100 * (its.moved / exact - 1), its.energy_error);
    }
  }
}
INSTANTIATE_TEST_SUITE_P(SlidingBlock, StiffBlock, testing::Values(GridFunctions::linear, GridFunctions::gimp));

}  // namespace
}  // namespace scarp::verification
