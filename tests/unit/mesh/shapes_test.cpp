#include "scarp/mesh/shapes.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <random>

namespace scarp {
namespace {

template <class Shape>
struct Samples;

template <>
struct Samples<T3> {
  static NodePositions<T3> element() { return {{{1.0, 2.0}, {4.0, 2.5}, {1.5, 5.0}}}; }
  static Vec<2> inside(std::mt19937& random) {
    std::uniform_real_distribution<double> u(0, 1);
    const double a = u(random), b = u(random);
    return a + b < 1 ? Vec<2>{a, b} : Vec<2>{1 - a, 1 - b};
  }
};

template <>
struct Samples<Q4> {
  static NodePositions<Q4> element() { return {{{1.0, 2.0}, {4.0, 2.5}, {3.0, 4.0}, {1.5, 5.0}}}; }
  static Vec<2> inside(std::mt19937& random) {
    std::uniform_real_distribution<double> u(-1, 1);
    return {u(random), u(random)};
  }
};

template <class Shape>
class ShapeTest : public testing::Test {
 protected:
  std::mt19937 random{1};
  NodePositions<Shape> x_nodes = Samples<Shape>::element();
};

using Shapes = testing::Types<T3, Q4>;
TYPED_TEST_SUITE(ShapeTest, Shapes);

// Oracle: sum N = 1, sum B = 0 and sum N x_i = x, to round-off of numbers of order 1 to 10.
TYPED_TEST(ShapeTest, ArePartitionOfUnityAndReproduceLinearFields) {
  std::array<double, TypeParam::nodes> N;
  std::array<Vec<2>, TypeParam::nodes> B;
  const auto field = [](const Vec<2>& x) { return 3 + 2 * x[0] - 5 * x[1]; };
  for (int sample = 0; sample < 100; ++sample) {
    const Vec<2> xi = Samples<TypeParam>::inside(this->random);
    const double J = gradients<TypeParam>(this->x_nodes, xi, N, B);
    EXPECT_GT(J, 0);
    const Vec<2> x = global_coordinates<TypeParam>(this->x_nodes, xi);
    double sum = 0, value = 0;
    Vec<2> sum_B{}, gradient{};
    for (int i = 0; i < TypeParam::nodes; ++i) {
      sum += N[i];
      value += N[i] * field(this->x_nodes[i]);
      for (int k = 0; k < 2; ++k) {
        sum_B[k] += B[i][k];
        gradient[k] += B[i][k] * field(this->x_nodes[i]);
      }
    }
    EXPECT_NEAR(sum, 1, 1e-14);
    EXPECT_NEAR(value, field(x), 1e-12);
    EXPECT_NEAR(gradient[0], 2, 1e-12);
    EXPECT_NEAR(gradient[1], -5, 1e-12);
    EXPECT_NEAR(std::abs(sum_B[0]) + std::abs(sum_B[1]), 0, 1e-13);
  }
}

TYPED_TEST(ShapeTest, AreOneAtTheirOwnNodeAndNoughtAtOthers) {
  for (int i = 0; i < TypeParam::nodes; ++i) {
    std::array<double, TypeParam::nodes> N;
    const Vec<2> xi = TypeParam::local_coordinates(this->x_nodes, this->x_nodes[i]);
    TypeParam::shape(xi, N);
    for (int j = 0; j < TypeParam::nodes; ++j) EXPECT_NEAR(N[j], i == j ? 1 : 0, 1e-14);
  }
}

// Oracle: central differences in x through local_coordinates. Their error is h^2 times the third derivative (order
// 1 here) plus round-off / h: 1e-10 + 1e-11 at h = 1e-5.
TYPED_TEST(ShapeTest, GradientsAgreeWithFiniteDifferences) {
  const double h = 1e-5;
  for (int sample = 0; sample < 50; ++sample) {
    const Vec<2> xi = Samples<TypeParam>::inside(this->random);
    const Vec<2> x = global_coordinates<TypeParam>(this->x_nodes, xi);
    std::array<double, TypeParam::nodes> N, plus, minus;
    std::array<Vec<2>, TypeParam::nodes> B;
    gradients<TypeParam>(this->x_nodes, xi, N, B);
    for (int k = 0; k < 2; ++k) {
      Vec<2> a = x, b = x;
      a[k] += h;
      b[k] -= h;
      TypeParam::shape(TypeParam::local_coordinates(this->x_nodes, a), plus);
      TypeParam::shape(TypeParam::local_coordinates(this->x_nodes, b), minus);
      for (int i = 0; i < TypeParam::nodes; ++i) EXPECT_NEAR(B[i][k], (plus[i] - minus[i]) / (2 * h), 1e-8);
    }
  }
}

// Oracle: the integral of det J over the local element, exact with one point (triangle) or 2 x 2 (quadrilateral).
TEST(Shapes, DeterminantGivesTheArea) {
  std::array<double, 3> N3;
  std::array<Vec<2>, 3> B3;
  EXPECT_NEAR(gradients<T3>({{{0, 0}, {3, 0}, {0, 4}}}, {0.3, 0.3}, N3, B3) / 2, 6, 1e-14);
  std::array<double, 4> N4;
  std::array<Vec<2>, 4> B4;
  double area = 0;
  const double g = 1 / std::sqrt(3.0);
  for (double xi : {-g, g})
    for (double eta : {-g, g}) area += gradients<Q4>({{{0, 0}, {4, 0}, {3, 2}, {1, 2}}}, {xi, eta}, N4, B4);
  EXPECT_NEAR(area, 6, 1e-14);  // trapezium (4 + 2) / 2 x 2
}

TEST(Shapes, InsideAndOutsidenessMeasurePartsOfTheHeight) {
  EXPECT_DOUBLE_EQ(outsideness<T3>({0.2, 0.2}), 0);
  EXPECT_DOUBLE_EQ(outsideness<T3>({-0.25, 0.2}), 0.25);
  EXPECT_DOUBLE_EQ(outsideness<T3>({0.75, 0.5}), 0.25);
  EXPECT_DOUBLE_EQ(outsideness<Q4>({1, -1}), 0);
  EXPECT_DOUBLE_EQ(outsideness<Q4>({0, -2}), 0.5);  // half a side of length 2
  EXPECT_DOUBLE_EQ(outsideness<Q4>({3, 2}), 1);
  EXPECT_TRUE(inside<Q4>({1 + 1e-10, 0}, 1e-10));
  EXPECT_FALSE(inside<Q4>({1 + 1e-9, 0}, 1e-10));
  EXPECT_TRUE(inside<T3>({-1e-11, 0.5}, 1e-10));
  EXPECT_FALSE(inside<T3>({-1e-9, 0.5}, 1e-10));
}

TEST(Shapes, NoNumbersAndHugeOnesAreNotInside) {
  const double nan = std::nan(""), inf = std::numeric_limits<double>::infinity();
  for (double bad : {nan, inf, -inf, 1e300, -1e300, 1e120})
    for (const Vec<2>& x : {Vec<2>{bad, 2.2}, Vec<2>{2.2, bad}, Vec<2>{bad, bad}, Vec<2>{bad, -bad}}) {
      EXPECT_FALSE(inside<T3>(T3::local_coordinates(Samples<T3>::element(), x), 1e-6)) << x[0] << ' ' << x[1];
      EXPECT_FALSE(inside<Q4>(Q4::local_coordinates(Samples<Q4>::element(), x), 1e-6)) << x[0] << ' ' << x[1];
    }
}

/// A convex quadrilateral with nodes anywhere near the corners of a square, or false.
bool random_quad(std::mt19937& random, NodePositions<Q4>& x, double& least_J) {
  std::uniform_real_distribution<double> u(-0.9, 0.9);
  x = {{{-1 + u(random), -1 + u(random)},
        {1 + u(random), -1 + u(random)},
        {1 + u(random), 1 + u(random)},
        {-1 + u(random), 1 + u(random)}}};
  least_J = 1e9;
  for (int i = 0; i < 4; ++i) {
    const Vec<2> a = detail::minus(x[(i + 1) % 4], x[i]), b = detail::minus(x[(i + 3) % 4], x[i]);
    least_J = std::min(least_J, detail::cross(a, b) / 4);
  }
  return least_J > 0.02;
}

// Oracle: the round trip xi -> x -> xi. J down to 0.02 where 1 is regular: round-off is amplified by at most 1/J^2.
TEST(Shapes, LocalCoordinatesOfDistortedQuadrilateralsGoRoundTrip) {
  std::mt19937 random(3);
  int quads = 0;
  for (int attempt = 0; attempt < 20000; ++attempt) {
    NodePositions<Q4> x;
    double J;
    if (!random_quad(random, x, J)) continue;
    ++quads;
    for (int sample = 0; sample < 5; ++sample) {
      const Vec<2> xi = Samples<Q4>::inside(random);
      const Vec<2> back = Q4::local_coordinates(x, global_coordinates<Q4>(x, xi));
      EXPECT_NEAR(back[0], xi[0], 4e-15 / (J * J));
      EXPECT_NEAR(back[1], xi[1], 4e-15 / (J * J));
    }
  }
  EXPECT_GT(quads, 5000);
}

// Oracle: the signs of the cross products with the edges. Points outside, near and far, with or without a solution
// of the bilinear map, must never be taken for inside, and never give anything but finite numbers.
TEST(Shapes, PointsOutsideAQuadrilateralAreOutside) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> near(-3, 3), far(-1e4, 1e4);
  int outside_points = 0;
  for (int attempt = 0; attempt < 20000; ++attempt) {
    NodePositions<Q4> x;
    double J;
    if (!random_quad(random, x, J)) continue;
    for (int sample = 0; sample < 10; ++sample) {
      const Vec<2> point = sample % 2 ? Vec<2>{near(random), near(random)} : Vec<2>{far(random), far(random)};
      double least = 1e9;
      for (int i = 0; i < 4; ++i)
        least = std::min(least, detail::cross(detail::minus(x[(i + 1) % 4], x[i]), detail::minus(point, x[i])));
      if (std::abs(least) < 1e-9) continue;
      const Vec<2> xi = Q4::local_coordinates(x, point);
      EXPECT_TRUE(std::isfinite(xi[0]) && std::isfinite(xi[1]));
      EXPECT_EQ(inside<Q4>(xi, 0), least > 0);
      outside_points += least < 0;
    }
  }
  EXPECT_GT(outside_points, 20000);
}

// Far points, where edges of a trapezium meet, and beyond: no solution with J > 0 exists there.
TEST(Shapes, PointsWhereAQuadrilateralsMapFoldsAreOutside) {
  const NodePositions<Q4> trapezium = {{{-2, 0}, {2, 0}, {1, 1}, {-1, 1}}};
  for (const Vec<2>& x : {Vec<2>{0, 2}, Vec<2>{0, 3}, Vec<2>{1, 2}, Vec<2>{-5, 2}, Vec<2>{0.1, 2.5}, Vec<2>{7, -9}}) {
    const Vec<2> xi = Q4::local_coordinates(trapezium, x);
    EXPECT_TRUE(std::isfinite(xi[0]) && std::isfinite(xi[1]));
    EXPECT_GT(outsideness<Q4>(xi), 0.1) << x[0] << ' ' << x[1];
  }
}

// Oracle: the affine map, exact inside and far outside.
TEST(Shapes, LocalCoordinatesOfAParallelogramAreExact) {
  const NodePositions<Q4> x = {{{10, 20}, {14, 21}, {15, 24}, {11, 23}}};
  for (const Vec<2>& xi : {Vec<2>{0.3, -0.8}, Vec<2>{1, 1}, Vec<2>{25, -40}, Vec<2>{-300, 2}}) {
    const Vec<2> back = Q4::local_coordinates(x, global_coordinates<Q4>(x, xi));
    EXPECT_NEAR(back[0], xi[0], 1e-14 * (1 + std::abs(xi[0]) + std::abs(xi[1])));
    EXPECT_NEAR(back[1], xi[1], 1e-14 * (1 + std::abs(xi[0]) + std::abs(xi[1])));
  }
}

}  // namespace
}  // namespace scarp
