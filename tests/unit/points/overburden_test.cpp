// The weight of the soil above a point, in two and three dimensions.
#include "scarp/points/overburden.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "base/surfaces.hpp"

namespace scarp::test {
namespace {

const Polygon below{{0, 0}, {9, 0}, {9, 2}, {0, 5}}, above{{0, 5}, {9, 2}, {9, 3}, {0, 8}};

/// By hand at x: the layers' common face is 5 - x/3 high, the top 8 - 5x/9.
double by_hand(double x, double height) {
  const double face = 5 - x / 3, top = 8 - 5 * x / 9;
  return 10 * (1.8 * std::max(0.0, top - std::max(face, height)) + 2.2 * std::max(0.0, face - height));
}

TEST(Overburden, SlopingLayersInThePlane) {
  const Overburden overburden({{below, 2.2}, {above, 1.8}}, 10.0);
  for (const double x : {0.5, 3.0, 8.5}) {
    for (const double y : {0.1, 1.5, 3.3, 6.0, 9.0})
      EXPECT_NEAR(overburden.vertical_stress({x, y}), by_hand(x, y), 1e-12);
  }
}

// The same ground with a width, from prisms and from surfaces: the plane answer within the width, nothing beside it.
TEST(Overburden, SlopingLayersInSpace) {
  const OverburdenOf<3> prisms({{Prism{below, 1, 0, 4}, 2.2}, {Prism{above, 1, 0, 4}, 1.8}}, 10.0);
  const OverburdenOf<3> surfaces({{Surface(extruded(below, 0, 4)), 2.2}, {Surface(extruded(above, 0, 4)), 1.8}}, 10.0);
  for (const double x : {0.5, 3.0, 8.5}) {
    for (const double z : {0.1, 1.5, 3.3, 6.0, 9.0}) {
      for (const double y : {0.0, 1.3, 3.9}) {
        EXPECT_NEAR(prisms.vertical_stress({x, y, z}), by_hand(x, z), 1e-12);
        EXPECT_NEAR(surfaces.vertical_stress({x, y, z}), by_hand(x, z), 1e-12);
      }
      EXPECT_EQ(prisms.vertical_stress({x, 4.1, z}), 0.0);
      EXPECT_EQ(surfaces.vertical_stress({x, -0.1, z}), 0.0);
    }
  }
}

// Soil above a gap counts; soil below the point does not.
TEST(Overburden, Cavity) {
  const OverburdenOf<3> overburden(
      {{Surface(together(box({0, 0, 0}, {3, 3, 3}), turned(box({1, 1, 1}, {2, 2, 2.5})))), 2.0}}, 10.0);
  EXPECT_NEAR(overburden.vertical_stress({1.5, 1.6, 0.25}), 20 * (0.75 + 0.5), 1e-12);
  EXPECT_NEAR(overburden.vertical_stress({1.5, 1.6, 2.75}), 20 * 0.25, 1e-12);
  EXPECT_NEAR(overburden.vertical_stress({0.5, 1.6, 0.25}), 20 * 2.75, 1e-12);
}

TEST(Overburden, PlanColumnExtrudedUpwards) {
  const OverburdenOf<3> overburden({{Prism{{{0, 0}, {2, 0}, {0, 2}}, 2, 1, 5}, 1.5}}, 10.0);
  EXPECT_NEAR(overburden.vertical_stress({0.5, 0.5, 2}), 45.0, 1e-12);
  EXPECT_NEAR(overburden.vertical_stress({0.5, 0.5, 0}), 60.0, 1e-12);
  EXPECT_EQ(overburden.vertical_stress({1.5, 1.5, 2}), 0.0);
}

}  // namespace
}  // namespace scarp::test
