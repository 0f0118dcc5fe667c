// Boxes, extruded polygons and surfaces as solids: each answers as the others do where they are the same solid.
#include "scarp/base/solid.hpp"

#include <gtest/gtest.h>

#include <random>

#include "surfaces.hpp"

namespace scarp::test {
namespace {

const Polygon slope{{0, 0}, {9, 0}, {9, 1}, {6, 1}, {3, 3}, {0, 3}};

TEST(Solid, MomentsOfPrisms) {
  for (int axis = 0; axis < 3; ++axis) {
    const Solid solid = Prism{slope, axis, -1, 4};
    const auto [i, j] = section_axes(axis);
    const auto m = moments(solid);
    // 9 × 1 below, 3 × 2 and a triangle of 3 × 2 above.
    EXPECT_NEAR(m.volume, 5 * 18.0, 1e-12);
    EXPECT_NEAR(m.centroid[i], (9 * 4.5 + 6 * 1.5 + 3 * 4) / 18, 1e-13);
    EXPECT_NEAR(m.centroid[j], (9 * 0.5 + 6 * 2 + 3 * (1 + 2.0 / 3)) / 18, 1e-13);
    EXPECT_NEAR(m.centroid[axis], 1.5, 1e-14);
    EXPECT_EQ(volume(solid), m.volume);
    const auto b = bounds(solid);
    EXPECT_EQ(b.low[axis], -1);
    EXPECT_EQ(b.high[axis], 4);
    EXPECT_EQ(b.high[i], 9);
    EXPECT_EQ(b.high[j], 3);
  }
}

TEST(Solid, BoxIsABox) {
  const Solid solid = make_box({1, 2, 3}, {2, 4, 6});
  EXPECT_NEAR(volume(solid), 6.0, 1e-14);
  EXPECT_EQ(bounds(solid).low, (Vec<3>{1, 2, 3}));
  EXPECT_EQ(bounds(solid).high, (Vec<3>{2, 4, 6}));
  EXPECT_TRUE(contains(solid, {1, 2, 3}));
  EXPECT_TRUE(contains(solid, {2, 4, 6}));
  EXPECT_FALSE(contains(solid, {2.001, 3, 4}));
  EXPECT_FALSE(contains(solid, {1.5, 3, 6.001}));
}

TEST(Solid, ContainsInEveryDirection) {
  for (int axis = 0; axis < 3; ++axis) {
    const Solid solid = Prism{slope, axis, -1, 4};
    const auto axes = section_axes(axis);
    const int i = axes[0], j = axes[1];
    const auto at = [&](double a, double b, double along) {
      Vec<3> x;
      x[i] = a, x[j] = b, x[axis] = along;
      return x;
    };
    EXPECT_TRUE(contains(solid, at(8, 0.9, 0)));
    EXPECT_FALSE(contains(solid, at(8, 1.1, 0)));
    EXPECT_TRUE(contains(solid, at(4.5, 2, 4)));  // on the slope and on the end
    EXPECT_FALSE(contains(solid, at(1, 1, 4.01)));
    EXPECT_FALSE(contains(solid, at(1, 1, -1.01)));
  }
}

/// The convex part of the slope above, as prism and as surface.
const Polygon wedge{{0, 0}, {9, 0}, {3, 3}, {0, 3}};

TEST(Solid, PrismAndSurfaceCutVerticalsAlike) {
  const Solid prism = Prism{wedge, 1, -1, 4}, surface = Surface(extruded(wedge, -1, 4));
  EXPECT_NEAR(volume(prism), volume(surface), 1e-12);
  std::mt19937 engine(3);
  std::uniform_real_distribution<double> any(-2, 10);
  for (int k = 0; k < 2000; ++k) {
    const Vec<3> x{any(engine), any(engine), any(engine)};
    const auto a = cuts_through(prism, x), b = cuts_through(surface, x);
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t c = 0; c < a.size(); ++c) {
      EXPECT_NEAR(a[c][0], b[c][0], 1e-13);
      EXPECT_NEAR(a[c][1], b[c][1], 1e-13);
    }
    ASSERT_EQ(contains(prism, x), contains(surface, x));
  }
}

TEST(Solid, VerticalsOfEveryExtrusion) {
  // Along x: the section's coordinates are y and z. Along z: x and y.
  EXPECT_EQ(cuts_through(Prism{slope, 0, -1, 4}, {0, 8, 0}), (std::vector<std::array<double, 2>>{{0, 1}}));
  EXPECT_EQ(cuts_through(Prism{slope, 1, -1, 4}, {8, 0, 0}), (std::vector<std::array<double, 2>>{{0, 1}}));
  EXPECT_EQ(cuts_through(Prism{slope, 2, -1, 4}, {8, 0.5, 0}), (std::vector<std::array<double, 2>>{{-1, 4}}));
  EXPECT_TRUE(cuts_through(Prism{slope, 2, -1, 4}, {8, 1.5, 0}).empty());
  EXPECT_TRUE(cuts_through(Prism{slope, 1, -1, 4}, {8, 4.5, 0}).empty());
}

TEST(Solid, NearBoundary) {
  // The largest length is 9: near is 9e-9.
  for (const Solid& solid : {Solid(Prism{wedge, 1, -1, 4}), Solid(Surface(extruded(wedge, -1, 4)))}) {
    EXPECT_TRUE(near_boundary(solid, {1, 1, 5e-9}));
    EXPECT_FALSE(near_boundary(solid, {1, 1, 5e-8}));
    EXPECT_TRUE(near_boundary(solid, {1, 4 - 5e-9, 1}));
    EXPECT_FALSE(near_boundary(solid, {1, 4 - 5e-8, 1}));
    EXPECT_TRUE(near_boundary(solid, {6, 0, 1.5}));
    EXPECT_FALSE(near_boundary(solid, {20, 20, 20}));
  }
}

}  // namespace
}  // namespace scarp::test
