// Cutting triangles along planes, and integrals over the pieces.
#include <gtest/gtest.h>

#include "scarp/base/facet.hpp"

namespace scarp {
namespace {

const Triangle triangle{{{0, 0, 0}, {4, 0, 2}, {0, 4, 6}}};

// Oracle: a plane's integrals over a triangle from its mean and corners. Of 1: the area 8; x, y: centroid 4/3; z: mean
// 8/3. Of z²: A/12 (Σz_i² + (Σz_i)²) = 8/12 (40 + 64); x z: A/12 (Σx_i z_i + Σx_i Σz_i) = 8/12 (8 + 32), y z: 8/12 (24
// + 32).
TEST(Facet, Integrals) {
  const FacetMoments m = moments(Facet(triangle), {0, 0, 0});
  EXPECT_NEAR(m.area, 8.0, 1e-14);
  EXPECT_NEAR(m.x, 8 * 4.0 / 3, 1e-13);
  EXPECT_NEAR(m.y, 8 * 4.0 / 3, 1e-13);
  EXPECT_NEAR(m.z, 8 * 8.0 / 3, 1e-13);
  EXPECT_NEAR(m.half_zz, 0.5 * 8.0 / 12 * 104, 1e-13);
  EXPECT_NEAR(m.xz, 8.0 / 12 * 40, 1e-13);
  EXPECT_NEAR(m.yz, 8.0 / 12 * 56, 1e-13);
}

TEST(Facet, TurnedTriangleHasTheOppositeSign) {
  const FacetMoments m = moments(Facet({triangle[0], triangle[2], triangle[1]}), {0, 0, 0});
  EXPECT_NEAR(m.area, -8.0, 1e-14);
  EXPECT_NEAR(m.xz, -8.0 / 12 * 40, 1e-13);
}

TEST(Facet, PiecesAddUp) {
  for (int axis = 0; axis < 3; ++axis) {
    for (const double at : {0.3, 1.0, 2.0, 3.7}) {
      Facet below, above;
      cut(Facet(triangle), axis, at, below, above);
      double area = 0, yz = 0;
      for (const auto& part : {below, above}) {
        if (part.size == 0) continue;
        area += moments(part, {0, 0, 0}).area;
        yz += moments(part, {0, 0, 0}).yz;
      }
      EXPECT_NEAR(area, 8.0, 1e-13);
      EXPECT_NEAR(yz, 8.0 / 12 * 56, 1e-12);
      for (int i = 0; i < below.size; ++i) EXPECT_LE(below.corner[i][axis], at);
      for (int i = 0; i < above.size; ++i) EXPECT_GE(above.corner[i][axis], at);
    }
  }
}

// Area in plan left of x = 1: all but the similar triangle of side 3.
TEST(Facet, PieceHasItsShare) {
  Facet below, above;
  cut(Facet(triangle), 0, 1.0, below, above);
  EXPECT_NEAR(moments(above, {0, 0, 0}).area, 4.5, 1e-14);
  EXPECT_NEAR(moments(below, {0, 0, 0}).area, 3.5, 1e-14);
}

TEST(Facet, PlaneThroughCornersAndFacesCutsNothingOff) {
  Facet below, above;
  cut(Facet(triangle), 0, 0.0, below, above);  // an edge in the plane
  EXPECT_EQ(below.size, 0);
  EXPECT_EQ(above.size, 3);
  cut(Facet(triangle), 1, 4.0, below, above);  // a corner in the plane
  EXPECT_EQ(below.size, 3);
  EXPECT_EQ(above.size, 0);
  cut(Facet({{{0, 0, 1}, {1, 0, 1}, {0, 1, 1}}}), 2, 1.0, below, above);  // all of it
  EXPECT_EQ(below.size, 3);
  EXPECT_EQ(above.size, 0);
}

// Two triangles on both sides of an edge get the same corner on it, bit for bit.
TEST(Facet, NeighboursStayTogether) {
  const Vec<3> a{0.1, 0.2, 0.3}, b{1.7, -0.4, 2.9}, left{-1, 0, 0}, right{3, 0.5, 1};
  Facet low_1, high_1, low_2, high_2;
  cut(Facet({a, b, left}), 2, 1.234567, low_1, high_1);
  cut(Facet({b, a, right}), 2, 1.234567, low_2, high_2);
  int shared = 0;
  for (int i = 0; i < low_1.size; ++i) {
    for (int j = 0; j < low_2.size; ++j) shared += low_1.corner[i] == low_2.corner[j];
  }
  EXPECT_EQ(shared, 2);  // a and the new corner
}

}  // namespace
}  // namespace scarp
