// Solids inside closed surfaces: moments, lines through them, containment, shares of boxes.
#include "scarp/base/surface.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "surfaces.hpp"

namespace scarp::test {
namespace {

TEST(Surface, MomentsOfTetrahedron) {
  const Surface surface(tetrahedron({2, -1, 5}, 3.0));
  EXPECT_NEAR(surface.moments().volume, 27.0 / 6, 1e-14);
  for (int j = 0; j < 3; ++j) EXPECT_NEAR(surface.moments().centroid[j], Vec<3>({2, -1, 5})[j] + 0.75, 1e-14);
}

TEST(Surface, MomentsOfTiltedBox) {
  const Surface surface(tilted(box({1, 2, 3}, {3, 5, 7})));
  EXPECT_NEAR(surface.moments().volume, 24.0, 1e-13);
  const Vec<3> centre = tilted({{{Vec<3>{2, 3.5, 5}, {}, {}}}})[0][0];
  for (int j = 0; j < 3; ++j) EXPECT_NEAR(surface.moments().centroid[j], centre[j], 1e-13);
}

TEST(Surface, InwardTrianglesAreTurned) {
  const Surface surface(turned(box({0, 0, 0}, {1, 2, 3})));
  EXPECT_NEAR(surface.moments().volume, 6.0, 1e-14);
  EXPECT_NEAR(surface.share({0, 0, 0}, {1, 1, 1}).volume, 1.0, 1e-14);
}

/// The winding number as a sum of solid angles: slow, smooth, and knows nothing of lines or buckets.
double winding(const Triangles& triangles, const Vec<3>& x) {
  double sum = 0;
  for (const auto& triangle : triangles) {
    std::array<Vec<3>, 3> v;
    std::array<double, 3> l;
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) v[i][j] = triangle[i][j] - x[j];
      l[i] = std::hypot(v[i][0], v[i][1], v[i][2]);
    }
    const auto& [a, b, c] = v;
    const auto dot = [](const Vec<3>& p, const Vec<3>& q) { return p[0] * q[0] + p[1] * q[1] + p[2] * q[2]; };
    const double det =
        a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) + a[2] * (b[0] * c[1] - b[1] * c[0]);
    sum += 2 * std::atan2(det, l[0] * l[1] * l[2] + dot(a, b) * l[2] + dot(b, c) * l[0] + dot(c, a) * l[1]);
  }
  return sum / (4 * std::acos(-1.0));
}

TEST(Surface, ContainsAgreesWithTheWindingNumber) {
  const std::vector<Triangles> all{tilted(box({-1, -1, -1}, {1, 1, 1})), sphere(3, 1.3, {0.1, 0, -0.2}),
                                   together(sphere(2, 1.5, {}), turned(sphere(2, 0.8, {0.2, 0.1, 0}))),
                                   together(box({-1, -1, -1}, {0, 0, 0}), box({0.2, 0.1, -0.5}, {1, 1, 1.4}))};
  std::mt19937 engine(7);
  std::uniform_real_distribution<double> any(-1.6, 1.6);
  for (const auto& triangles : all) {
    const Surface surface(triangles);
    for (int k = 0; k < 4000; ++k) {
      const Vec<3> x{any(engine), any(engine), any(engine)};
      const double w = winding(triangles, x);
      ASSERT_EQ(surface.contains(x), w > 0.5) << x[0] << ' ' << x[1] << ' ' << x[2] << ": " << w;
    }
  }
}

// Points on faces, edges and corners count as inside, as they do for polygons.
TEST(Surface, ContainsItsBoundary) {
  const Surface surface(box({0, 0, 0}, {1, 2, 3}));
  for (const double x : {0.0, 0.5, 1.0}) {
    for (const double y : {0.0, 1.0, 2.0}) {
      for (const double z : {0.0, 1.5, 3.0}) EXPECT_TRUE(surface.contains({x, y, z})) << x << ' ' << y << ' ' << z;
    }
  }
  for (const double beyond : {1e-9, 0.1, 5.0}) {
    EXPECT_FALSE(surface.contains({1 + beyond, 1, 1}));
    EXPECT_FALSE(surface.contains({-beyond, 0, 0}));
    EXPECT_FALSE(surface.contains({0.5, 2 + beyond, 1}));
    EXPECT_FALSE(surface.contains({0.5, 1, 3 + beyond}));
  }
}

TEST(Surface, NearIsTheDistanceFromFacesEdgesAndCorners) {
  const Surface surface(box({0, 0, 0}, {1, 1, 1}));
  const double d = surface.largest_distance();
  EXPECT_EQ(d, 1e-9);
  EXPECT_TRUE(surface.near({0.3, 0.4, 1 - 0.9 * d}, d));
  EXPECT_FALSE(surface.near({0.3, 0.4, 1 - 1.1 * d}, d));
  EXPECT_TRUE(surface.near({0.3, 0.9 * d, 0.5}, d));
  EXPECT_FALSE(surface.near({1 + 0.8 * d, 1 + 0.8 * d, 0.5}, d));  // 1.13 d from the edge
  EXPECT_TRUE(surface.near({1 + 0.6 * d, 1 + 0.6 * d, 0.5}, d));
  EXPECT_FALSE(surface.near({1 + 0.6 * d, 1 + 0.6 * d, 1 + 0.6 * d}, d));  // 1.04 d from the corner
  EXPECT_FALSE(surface.near({0.5, 0.5, 0.5}, d));
}

// A line through a corner, along an edge in plan or along a diagonal of a face goes in and out once.
TEST(Surface, LinesThroughCornersAndEdges) {
  const auto triangles = sphere(3, 1.0, {});
  const Surface surface(triangles);
  for (const auto& triangle : triangles) {
    for (int i = 0; i < 3; ++i) {
      const Vec<3>&a = triangle[i], &b = triangle[(i + 1) % 3];
      for (const double t : {0.0, 0.5, 0.25}) {
        const double x = a[0] + t * (b[0] - a[0]), y = a[1] + t * (b[1] - a[1]);
        const auto found = surface.crossings(x, y);
        if (std::hypot(x, y) > 0.99) {
          ASSERT_LE(found.size(), 2u);  // at the rim it may belong to nobody
          continue;
        }
        ASSERT_EQ(found.size(), 2u);
        EXPECT_FALSE(found[0].leaves);
        EXPECT_TRUE(found[1].leaves);
        // The surface is an even function of z, and a is on it.
        const double z = std::abs(a[2] + t * (b[2] - a[2]));
        EXPECT_NEAR(found[0].z, -z, 1e-12);
        EXPECT_NEAR(found[1].z, z, 1e-12);
      }
    }
  }
  const Surface cube(box({0, 0, 0}, {1, 1, 1}));
  for (const double t : {0.25, 0.5, 0.75}) {
    EXPECT_EQ(cube.crossings(t, t).size(), 2u);
    EXPECT_EQ(cube.crossings(t, 1 - t).size(), 2u);
  }
  EXPECT_EQ(cube.crossings(0, 0).size(), 2u);  // as if shifted towards larger x, less towards larger y
  EXPECT_EQ(cube.crossings(1, 1).size(), 0u);
}

// On a grid of boxes side by side a line on their common face belongs to one of them: soil is counted once.
TEST(Surface, CommonFacesBelongToOneSide) {
  const Surface left(box({0, 0, 0}, {1, 1, 1})), right(box({1, 0, 0}, {2, 1, 1}));
  for (const double y : {0.1, 0.5, 0.9}) {
    EXPECT_EQ(left.crossings(1, y).size() + right.crossings(1, y).size(), 2u);
  }
}

TEST(Surface, CutsThroughCavity) {
  const Surface surface(together(box({0, 0, 0}, {3, 3, 3}), turned(box({1, 1, 1}, {2, 2, 2.5}))));
  EXPECT_NEAR(surface.moments().volume, 25.5, 1e-13);
  const auto cuts = surface.vertical_cuts(1.4, 1.7);
  ASSERT_EQ(cuts.size(), 2u);
  EXPECT_NEAR(cuts[0][1], 1.0, 1e-14);
  EXPECT_NEAR(cuts[1][0], 2.5, 1e-14);
  EXPECT_FALSE(surface.contains({1.5, 1.5, 2}));
  EXPECT_TRUE(surface.contains({1.5, 1.5, 2.6}));
}

/// What the solid x, y, z >= 0, x + y + z <= 1 shares with a box, from its parts beyond the box's corners: the part
/// with x >= c_x, y >= c_y, z >= c_z is a tetrahedron of leg s = 1 - c_x - c_y - c_z.
SolidMoments tetrahedron_share(const Vec<3>& low, const Vec<3>& high) {
  double volume = 0;
  Vec<3> first{};
  for (int corner = 0; corner < 8; ++corner) {
    Vec<3> c;
    double sign = 1, s = 1;
    for (int j = 0; j < 3; ++j) {
      c[j] = std::max(0.0, corner >> j & 1 ? high[j] : low[j]);
      if (corner >> j & 1) sign = -sign;
      s -= c[j];
    }
    if (s <= 0) continue;
    volume += sign * s * s * s / 6;
    for (int j = 0; j < 3; ++j) first[j] += sign * (c[j] * s * s * s / 6 + s * s * s * s / 24);
  }
  return {volume, {first[0] / volume, first[1] / volume, first[2] / volume}};
}

TEST(Surface, ShareOfBoxIsExact) {
  const Surface surface(tetrahedron({}, 1.0));
  std::mt19937 engine(11);
  std::uniform_real_distribution<double> corner(-0.2, 0.6), length(0.01, 0.7);
  int met = 0;
  for (int k = 0; k < 2000; ++k) {
    Vec<3> low, high;
    for (int j = 0; j < 3; ++j) {
      low[j] = corner(engine);
      high[j] = low[j] + length(engine);
    }
    const auto expected = tetrahedron_share(low, high), found = surface.share(low, high);
    ASSERT_NEAR(found.volume, std::max(0.0, expected.volume), 1e-15);
    if (expected.volume < 1e-6) continue;
    ++met;
    // The oracle loses digits where large terms cancel to a small volume.
    for (int j = 0; j < 3; ++j) ASSERT_NEAR(found.centroid[j], expected.centroid[j], 1e-15 / expected.volume);
  }
  EXPECT_GT(met, 1000);
}

TEST(Surface, ShareFarFromTheOriginKeepsItsDigits) {
  const Vec<3> far{1048576, 4194304, 1024};  // powers of two: corners are the same numbers, exactly
  const Surface surface(tetrahedron(far, 1.0));
  const auto found =
      surface.share({far[0] + 0.125, far[1] + 0.25, far[2]}, {far[0] + 0.375, far[1] + 0.5, far[2] + 0.5});
  const auto expected = tetrahedron_share({0.125, 0.25, 0}, {0.375, 0.5, 0.5});
  // New corners on edges are rounded to the spacing of doubles at 4e6, 1e-9.
  EXPECT_NEAR(found.volume, expected.volume, 1e-9);
  EXPECT_NEAR(found.centroid[2] - far[2], expected.centroid[2], 1e-8);
}

}  // namespace
}  // namespace scarp::test
