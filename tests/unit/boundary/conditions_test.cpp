// What walls with friction do to one node, by both rules, against numbers worked out by hand.
#include "scarp/boundary/conditions.hpp"

#include <gtest/gtest.h>

namespace scarp {
namespace {

constexpr double dt = 0.1, m = 2;

/// One node on a wall below the soil, whose friction is 0.5; `fixed` components beside it.
template <int Dim>
Conditions<Dim> on_a_wall(std::uint8_t fixed = 0) {
  Conditions<Dim> conditions(1);
  conditions.fixed[0] = fixed;
  conditions.normal.set(0, Dim - 1);
  conditions.inward[0] = 1;
  conditions.friction[0] = 0.5;
  return conditions;
}

/// What is left of a node's acceleration and of its velocity at the end.
template <int Dim>
struct Outcome {
  Reaction<Dim> reaction;
  Vec<Dim> a, v_end;
};

template <int Dim>
Outcome<Dim> constrained(const Conditions<Dim>& conditions, WallRule rule, const Vec<Dim>& v, Vec<Dim> a,
                         Vec<Dim> v_end) {
  const auto reaction = constrain_acceleration<Dim>(conditions, rule, 0, m, v, dt, a);
  constrain_velocity<Dim>(conditions, rule, 0, reaction.held, v_end);
  return {reaction, a, v_end};
}

template <std::size_t Dim>
void expect_near(const std::array<double, Dim>& found, const std::array<double, Dim>& expected) {
  for (std::size_t j = 0; j < Dim; ++j) EXPECT_NEAR(found[j], expected[j], 1e-14) << "component " << j;
}

TEST(WallByMotion, StopsWhatArrivesAndRubsWithTheWholeForce) {
  // v_N + a_N dt = −0.5: a_N = 0.2/0.1 = 2, R/m = 2 + 3 = 5, friction 2.5 against the slip of 1.
  const auto its = constrained<2>(on_a_wall<2>(), WallRule::by_motion, {1, -0.2}, {0, -3}, {0.9, -0.1});
  expect_near(its.a, {-2.5, 2});
  expect_near(its.reaction.friction, {-5, 4});
  EXPECT_EQ(its.reaction.held, 2);
  expect_near(its.v_end, {0.9, 0});
}

TEST(WallByMotion, StoppingTakesEnergyWhicheverWayTheNodeMoved) {
  // Along the normal the force that stays at the node is against its velocity: towards the wall, and away from it.
  for (const double v_N : {-0.2, 0.2}) {
    const auto its = constrained<2>(on_a_wall<2>(), WallRule::by_motion, {0, v_N}, {0, -4}, {0, 0});
    EXPECT_NEAR(its.reaction.friction[1], -m * v_N / dt, 1e-14);
  }
}

TEST(WallByMotion, SticksWithoutOverwritingTheVelocity) {
  // R/m = 10, up to 5 of friction, and 2 stop the slip of 0.2.
  const auto its = constrained<2>(on_a_wall<2>(), WallRule::by_motion, {0.2, 0}, {0, -10}, {0.03, -0.1});
  expect_near(its.a, {-2, 0});
  EXPECT_EQ(its.reaction.held, 3);
  expect_near(its.v_end, {0.03, 0});
}

TEST(WallByMotion, LeavesAloneWhatDoesNotReachIt) {
  const auto away = constrained<2>(on_a_wall<2>(), WallRule::by_motion, {1, 1}, {0, -3}, {0.9, -0.1});
  expect_near(away.a, {0, -3});
  EXPECT_EQ(away.reaction.held, 0);
  expect_near(away.v_end, {0.9, -0.1});
  const auto arriving = constrained<2>(on_a_wall<2>(), WallRule::by_motion, {0, -1}, {0, 3}, {0, 0});
  expect_near(arriving.a, {0, 10});
}

TEST(WallByMotion, RubsAlongWhatIsNotFixed) {
  // Component 0 is fixed: the slip is that of component 1 alone, 1, against 0.5 · 10 · 0.1 = 0.5.
  const auto its = constrained<3>(on_a_wall<3>(1), WallRule::by_motion, {7, 1, 0}, {0, 0, -10}, {1, 1, 1});
  expect_near(its.a, {0, -5, 0});
  EXPECT_EQ(its.reaction.held, 5);
  expect_near(its.v_end, {0, 1, 0});
}

TEST(WallByAcceleration, TakesTheAccelerationAndOverwritesWhatSticks) {
  const auto slides = constrained<2>(on_a_wall<2>(), WallRule::by_acceleration, {1, -0.2}, {0, -3}, {0.9, -0.1});
  expect_near(slides.a, {-1.5, 0});
  expect_near(slides.reaction.friction, {-3, 0});
  EXPECT_EQ(slides.reaction.held, 2);
  expect_near(slides.v_end, {0.9, 0});
  const auto sticks = constrained<2>(on_a_wall<2>(), WallRule::by_acceleration, {0.2, 0}, {0, -10}, {0.03, -0.1});
  expect_near(sticks.a, {-2, 0});
  expect_near(sticks.v_end, {0, 0});
  const auto away = constrained<2>(on_a_wall<2>(), WallRule::by_acceleration, {1, 1}, {0, 3}, {0.9, -0.1});
  expect_near(away.a, {0, 3});
  expect_near(away.v_end, {0.9, 0});
}

}  // namespace
}  // namespace scarp
