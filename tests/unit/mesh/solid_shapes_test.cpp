// The shapes of space; what is particular to the hexahedron's local coordinates stands in hexahedron_test.cpp.
#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "scarp/mesh/shapes.hpp"
#include "solids.hpp"

namespace scarp {
namespace {

template <class Shape>
struct Samples;

template <>
struct Samples<T4> {
  static constexpr double local_volume = 1.0 / 6;
  static NodePositions<T4> element() { return {{{1, 2, 0.5}, {4, 2.5, 0}, {1.5, 5, 1}, {2, 2.5, 3}}}; }
  static NodePositions<T4> reference() { return {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}; }
};

template <>
struct Samples<H8> {
  static constexpr double local_volume = 8;
  static NodePositions<H8> element() {
    return {{{1, 2, 0.5},
             {4, 2.5, 0},
             {3.5, 4.5, 0.2},
             {1.5, 5, 1},
             {0.8, 1.7, 3},
             {3.6, 2.2, 3.5},
             {3, 4, 4},
             {1, 4.4, 2.8}}};
  }
  static NodePositions<H8> reference() {
    return {{{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1}, {-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1}}};
  }
};

template <class Shape>
class SolidShape : public testing::Test {
 protected:
  std::mt19937 random{1};
  NodePositions<Shape> x_nodes = Samples<Shape>::element();
};

using Shapes = testing::Types<T4, H8>;
TYPED_TEST_SUITE(SolidShape, Shapes);

// Oracle: sum N = 1, sum B = 0, sum N x_i = x and sum B x_i = 1, to round-off of numbers of order 1 to 10.
TYPED_TEST(SolidShape, ArePartitionOfUnityAndReproduceLinearFields) {
  std::array<double, TypeParam::nodes> N;
  std::array<Vec<3>, TypeParam::nodes> B;
  const Vec<3> slope = {2, -5, 0.7};
  const auto field = [&](const Vec<3>& x) { return 3 + detail::dot(slope, x); };
  for (int sample = 0; sample < 100; ++sample) {
    const Vec<3> xi = test::point_inside<TypeParam>(this->random);
    EXPECT_GT(gradients<TypeParam>(this->x_nodes, xi, N, B), 0);
    const Vec<3> x = global_coordinates<TypeParam>(this->x_nodes, xi);
    double sum = 0, value = 0;
    Vec<3> sum_B{}, gradient{};
    for (int i = 0; i < TypeParam::nodes; ++i) {
      sum += N[i];
      value += N[i] * field(this->x_nodes[i]);
      for (int k = 0; k < 3; ++k) {
        sum_B[k] += B[i][k];
        gradient[k] += B[i][k] * field(this->x_nodes[i]);
      }
    }
    EXPECT_NEAR(sum, 1, 1e-14);
    EXPECT_NEAR(value, field(x), 1e-12);
    for (int k = 0; k < 3; ++k) {
      EXPECT_NEAR(gradient[k], slope[k], 1e-12);
      EXPECT_NEAR(sum_B[k], 0, 1e-13);
    }
  }
}

TYPED_TEST(SolidShape, AreOneAtTheirOwnNodeAndNoughtAtOthers) {
  for (int i = 0; i < TypeParam::nodes; ++i) {
    std::array<double, TypeParam::nodes> N;
    TypeParam::shape(TypeParam::local_coordinates(this->x_nodes, this->x_nodes[i]), N);
    for (int j = 0; j < TypeParam::nodes; ++j) EXPECT_NEAR(N[j], i == j ? 1 : 0, 1e-14);
  }
}

// Oracle: central differences in x through local_coordinates. Their error is h^2 times the third derivative (order
// 1 here) plus round-off / h: 1e-10 + 1e-11 at h = 1e-5.
TYPED_TEST(SolidShape, GradientsAgreeWithFiniteDifferences) {
  const double h = 1e-5;
  for (int sample = 0; sample < 50; ++sample) {
    const Vec<3> xi = test::point_inside<TypeParam>(this->random);
    const Vec<3> x = global_coordinates<TypeParam>(this->x_nodes, xi);
    std::array<double, TypeParam::nodes> N, plus, minus;
    std::array<Vec<3>, TypeParam::nodes> B;
    gradients<TypeParam>(this->x_nodes, xi, N, B);
    for (int k = 0; k < 3; ++k) {
      Vec<3> a = x, b = x;
      a[k] += h;
      b[k] -= h;
      TypeParam::shape(TypeParam::local_coordinates(this->x_nodes, a), plus);
      TypeParam::shape(TypeParam::local_coordinates(this->x_nodes, b), minus);
      for (int i = 0; i < TypeParam::nodes; ++i) EXPECT_NEAR(B[i][k], (plus[i] - minus[i]) / (2 * h), 1e-8);
    }
  }
}

// Oracle: the affine image of the reference element has det J = det A throughout.
TYPED_TEST(SolidShape, DeterminantIsThatOfAnAffineMap) {
  NodePositions<TypeParam> x = Samples<TypeParam>::reference();
  for (Vec<3>& node : x) node = {3 * node[0] + node[1], 2 * node[1] + 0.5 * node[2] + 7, 4 * node[2] - node[0]};
  const double det = 3 * (2 * 4 - 0) - 1 * (0 * 4 - 0.5 * -1);
  std::array<double, TypeParam::nodes> N;
  std::array<Vec<3>, TypeParam::nodes> B;
  for (int sample = 0; sample < 20; ++sample)
    EXPECT_NEAR(gradients<TypeParam>(x, test::point_inside<TypeParam>(this->random), N, B), det, 1e-12);
}

// Oracle: the divergence theorem on the reference element, whose faces are plane: volume = sum over faces of one third
// of area times distance from the origin, with outward normals.
TYPED_TEST(SolidShape, SidesRunAnticlockwiseSeenFromOutside) {
  const auto x = Samples<TypeParam>::reference();
  double volume = 0;
  for (const auto& side : TypeParam::sides)
    for (std::size_t i = 1; i + 1 < side.size(); ++i)
      volume += detail::dot(x[side[0]], detail::cross(x[side[i]], x[side[i + 1]])) / 6;
  EXPECT_NEAR(volume, Samples<TypeParam>::local_volume, 1e-14);
}

// Oracle: an edge belongs to exactly two faces, and each corner's triple is right-handed along such edges.
TYPED_TEST(SolidShape, CornersAreRightHandedTriplesOfEdges) {
  const auto x = Samples<TypeParam>::reference();
  for (int i = 0; i < TypeParam::nodes; ++i) {
    EXPECT_GT(corner_height<TypeParam>(x, i), 0);
    for (int j : TypeParam::corners[i]) {
      int faces = 0;
      for (const auto& side : TypeParam::sides)
        for (std::size_t k = 0; k < side.size(); ++k) {
          const int from = side[k], to = side[(k + 1) % side.size()];
          faces += (from == i && to == j) || (from == j && to == i);
        }
      EXPECT_EQ(faces, 2) << i << ' ' << j;
    }
  }
}

TYPED_TEST(SolidShape, NoNumbersAndHugeOnesAreNotInside) {
  const double nan = std::nan(""), inf = std::numeric_limits<double>::infinity();
  for (const auto& element : {Samples<TypeParam>::element(), Samples<TypeParam>::reference()})
    for (double bad : {nan, inf, -inf, 1e300, -1e300, 1e120, 1e60, 1e20, 1e8})
      for (int which = 1; which < 8; ++which)
        for (double other : {1.0, -1.0}) {
          Vec<3> x = {0.1, 0.2, 0.3};
          for (int k = 0; k < 3; ++k)
            if ((which >> k) & 1) x[k] = k == 1 ? other * bad : bad;
          EXPECT_FALSE(inside<TypeParam>(TypeParam::local_coordinates(element, x), 1e-6)) << x[0] << ' ' << x[1];
        }
}

TEST(SolidShapes, InsideAndOutsidenessMeasurePartsOfTheHeight) {
  EXPECT_DOUBLE_EQ(outsideness<T4>({0.2, 0.2, 0.2}), 0);
  EXPECT_DOUBLE_EQ(outsideness<T4>({-0.25, 0.2, 0.2}), 0.25);
  EXPECT_DOUBLE_EQ(outsideness<T4>({0.5, 0.5, 0.25}), 0.25);
  EXPECT_DOUBLE_EQ(outsideness<H8>({1, -1, 1}), 0);
  EXPECT_DOUBLE_EQ(outsideness<H8>({0, 0, -2}), 0.5);  // half a side of length 2
  EXPECT_DOUBLE_EQ(outsideness<H8>({3, 2, 0}), 1);
  EXPECT_TRUE(inside<H8>({1 + 1e-10, 0, 0}, 1e-10));
  EXPECT_FALSE(inside<H8>({0, 0, 1 + 1e-9}, 1e-10));
  EXPECT_TRUE(inside<T4>({-1e-11, 0.5, 0.1}, 1e-10));
  EXPECT_FALSE(inside<T4>({0.1, 0.5, -1e-9}, 1e-10));
  const double nan = std::nan("");
  for (const Vec<3>& xi : {Vec<3>{nan, 0.1, 0.1}, Vec<3>{0.1, nan, 0.1}, Vec<3>{0.1, 0.1, nan}}) {
    EXPECT_FALSE(inside<T4>(xi, 1e-6));
    EXPECT_FALSE(inside<H8>(xi, 1e-6));
  }
}

TEST(SolidShapes, AreChosenByTheType) {
  for (const auto& [type, nodes] : {std::pair{ElementType::T4, 4}, std::pair{ElementType::H8, 8}}) {
    EXPECT_EQ(nodes_of(type), nodes);
    EXPECT_EQ(with_shape<3>(type, []<class Shape>(Shape) { return Shape::nodes; }), nodes);
    EXPECT_EQ(with_shape<3>(type, []<class Shape>(Shape) { return Shape::type; }), type);
  }
  EXPECT_EQ(nodes_of(ElementType::T3), 3);
  EXPECT_EQ(nodes_of(ElementType::Q4), 4);
}

}  // namespace
}  // namespace scarp
