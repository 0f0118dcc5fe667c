// Local coordinates in distorted hexahedra.
#include <gtest/gtest.h>

#include <limits>
#include <numbers>
#include <random>

#include "scarp/mesh/shapes.hpp"
#include "solids.hpp"

namespace scarp {
namespace {

/// det dx/dxi at xi.
double determinant(const NodePositions<H8>& x, const Vec<3>& xi) {
  std::array<double, 8> N;
  std::array<Vec<3>, 8> B;
  return gradients<H8>(x, xi, N, B);
}

/// A hexahedron with nodes anywhere near the corners of a cube of side 2, or false when det J, looked at in 7 x 7 x 7
/// points, is not above 0.04 where the cube has 1: between those points it is then positive too.
bool random_hexahedron(std::mt19937& random, double shake, NodePositions<H8>& x, double& least_J) {
  std::uniform_real_distribution<double> u(-shake, shake);
  for (int i = 0; i < 8; ++i) {
    const int plan = i % 4;
    x[i] = {(plan == 1 || plan == 2 ? 1 : -1) + u(random), (plan >= 2 ? 1 : -1) + u(random),
            (i < 4 ? -1 : 1) + u(random)};
  }
  least_J = std::numeric_limits<double>::infinity();
  for (int a = -3; a <= 3; ++a)
    for (int b = -3; b <= 3; ++b)
      for (int c = -3; c <= 3; ++c) {
        least_J = std::min(least_J, determinant(x, {a / 3.0, b / 3.0, c / 3.0}));
        if (least_J < 0.04) return false;
      }
  return true;
}

// Oracle: the round trip xi -> x -> xi. J down to 0.04 where 1 is regular: round-off is amplified by at most 1/J^2.
TEST(Hexahedron, LocalCoordinatesGoRoundTrip) {
  std::mt19937 random(3);
  int hexahedra = 0;
  for (int attempt = 0; attempt < 30000; ++attempt) {
    NodePositions<H8> x;
    double J;
    if (!random_hexahedron(random, attempt % 2 ? 0.9 : 0.5, x, J)) continue;
    ++hexahedra;
    for (int sample = 0; sample < 10; ++sample) {
      Vec<3> xi = test::point_inside<H8>(random);
      if (sample < 3) xi[sample] = xi[sample] > 0 ? 1 : -1;  // on faces
      const Vec<3> back = H8::local_coordinates(x, global_coordinates<H8>(x, xi));
      for (int k = 0; k < 3; ++k) ASSERT_NEAR(back[k], xi[k], 4e-15 / (J * J)) << attempt << " J " << J;
    }
  }
  EXPECT_GT(hexahedra, 5000);
}

/// How often the surface of the hexahedron goes round x: the solid angles (van Oosterom and Strackee 1983) of its
/// faces, each cut into 2 n^2 triangles, over 4 pi.
double turns_around(const NodePositions<H8>& x_nodes, const Vec<3>& x, int n) {
  double angle = 0;
  for (const auto& side : H8::sides) {
    const auto at = [&](int i, int j) {
      const double a = static_cast<double>(i) / n, b = static_cast<double>(j) / n;
      Vec<3> p;
      for (int k = 0; k < 3; ++k)
        p[k] = (1 - b) * ((1 - a) * x_nodes[side[0]][k] + a * x_nodes[side[1]][k]) +
               b * ((1 - a) * x_nodes[side[3]][k] + a * x_nodes[side[2]][k]) - x[k];
      return p;
    };
    const auto add = [&](const Vec<3>& a, const Vec<3>& b, const Vec<3>& c) {
      using namespace detail;
      const double la = norm(a), lb = norm(b), lc = norm(c);
      angle += 2 * std::atan2(dot(a, cross(b, c)), la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb);
    };
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) {
        add(at(i, j), at(i + 1, j), at(i + 1, j + 1));
        add(at(i, j), at(i + 1, j + 1), at(i, j + 1));
      }
  }
  return angle / (4 * std::numbers::pi);
}

// Oracle: how often the surface goes round the point, 1 inside and 0 outside. Points that change sides when the surface
// is cut twice as finely, or lie within 0.02 of the boundary in local coordinates, are too near to tell.
TEST(Hexahedron, ContainsThePointsThatItsSurfaceGoesRound) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> near(-2, 2);
  int inside_points = 0, outside_points = 0;
  for (int attempt = 0; attempt < 6000; ++attempt) {
    NodePositions<H8> x;
    double J;
    if (!random_hexahedron(random, 0.9, x, J)) continue;
    for (int sample = 0; sample < 10; ++sample) {
      const Vec<3> point = {near(random), near(random), near(random)};
      const Vec<3> xi = H8::local_coordinates(x, point);
      ASSERT_TRUE(std::isfinite(xi[0]) && std::isfinite(xi[1]) && std::isfinite(xi[2]));
      if (std::abs(H8::beyond(xi)) < 0.01) continue;
      const double turns = turns_around(x, point, 6);
      if (std::abs(turns - turns_around(x, point, 3)) > 1e-9) continue;
      ASSERT_EQ(inside<H8>(xi, 0), turns > 0.5) << attempt;
      (turns > 0.5 ? inside_points : outside_points)++;
    }
  }
  EXPECT_GT(inside_points, 500);
  EXPECT_GT(outside_points, 2000);
}

// Far points, many with no solution of the trilinear map or one beyond a fold. Oracle: the box of the nodes.
TEST(Hexahedron, HasFarPointsOutside) {
  std::mt19937 random(5);
  int hexahedra = 0;
  for (int attempt = 0; attempt < 3000; ++attempt) {
    NodePositions<H8> x;
    double J;
    if (!random_hexahedron(random, 0.9, x, J)) continue;
    ++hexahedra;
    for (double distance : {2.0, 5.0, 1e2, 1e4, 1e8, 1e16}) {
      Vec<3> point = {distance, -distance, distance};
      std::uniform_real_distribution<double> u(-distance, distance);
      point[random() % 3] = u(random);
      point[random() % 3] = u(random);
      if (std::max({std::abs(point[0]), std::abs(point[1]), std::abs(point[2])}) <= 1.9) continue;
      const Vec<3> xi = H8::local_coordinates(x, point);
      EXPECT_TRUE(std::isfinite(xi[0]) && std::isfinite(xi[1]) && std::isfinite(xi[2]));
      EXPECT_FALSE(inside<H8>(xi, 1e-6));
    }
  }
  EXPECT_GT(hexahedra, 300);
}

// Oracle: the affine map, exact inside and far outside.
TEST(Hexahedron, LocalCoordinatesOfParallelepipedsAreExact) {
  NodePositions<H8> box, skew;
  for (int i = 0; i < 8; ++i) {
    const double a = i % 4 == 1 || i % 4 == 2, b = i % 4 >= 2, c = i >= 4;
    box[i] = {10 + 4 * a, 20 + 2 * b, -5 + 8 * c};
    skew[i] = {10 + 4 * a + b - 0.5 * c, 20 + a + 3 * b, -5 + 2 * c + 0.25 * a};
  }
  for (const auto& x : {box, skew})
    for (const Vec<3>& xi : {Vec<3>{0.3, -0.8, 0.1}, Vec<3>{1, 1, -1}, Vec<3>{25, -40, 3}, Vec<3>{-300, 2, 500}}) {
      const Vec<3> back = H8::local_coordinates(x, global_coordinates<H8>(x, xi));
      const double largest = std::max({std::abs(xi[0]), std::abs(xi[1]), std::abs(xi[2])});
      for (int k = 0; k < 3; ++k) EXPECT_NEAR(back[k], xi[k], 2e-14 * (1 + largest) * (1 + largest));
    }
}

// A cube far from the origin is no exact parallelepiped any more: its coordinates are rounded.
TEST(Hexahedron, LocalCoordinatesFarFromTheOriginAreAsGoodAsTheCoordinates) {
  NodePositions<H8> x;
  for (int i = 0; i < 8; ++i)
    x[i] = {5e6 + 0.1 * (i % 4 == 1 || i % 4 == 2), 4e6 + 0.1 * (i % 4 >= 2), 3e6 + 0.1 * (i >= 4)};
  const double rounding = 5e6 * std::numeric_limits<double>::epsilon() / 0.05;
  for (const Vec<3>& xi : {Vec<3>{0.3, -0.8, 0.1}, Vec<3>{1, 1, -1}, Vec<3>{-0.9, 1, 0.7}}) {
    const Vec<3> back = H8::local_coordinates(x, global_coordinates<H8>(x, xi));
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(back[k], xi[k], 4 * rounding);
  }
}

}  // namespace
}  // namespace scarp
