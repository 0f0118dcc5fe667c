// Invariants of symmetric tensors against plain 3 × 3 matrices, for double and for a SIMD batch.
#include <gtest/gtest.h>
#include <cmath>
#include <numbers>

#include "material/lanes.hpp"
#include "matrix.hpp"

namespace scarp::test {
namespace {

constexpr double pi = std::numbers::pi;

/// Principal deviatoric values of size 1 at the Lode angle θ, turned into a general position.
Sym<double, 6> at_lode_angle(double theta, const Matrix& q) {
  const Matrix m{{{std::cos(theta), 0, 0}, {0, std::cos(theta - 2 * pi / 3), 0}, {0, 0, std::cos(theta + 2 * pi / 3)}}};
  return from_matrix<6>(q * m * transposed(q));
}

/// Rotation about z, then about x.
Matrix turn(double about_z, double about_x) {
  const double c = std::cos(about_z), s = std::sin(about_z), d = std::cos(about_x), t = std::sin(about_x);
  return Matrix{{{1, 0, 0}, {0, d, -t}, {0, t, d}}} * Matrix{{{c, -s, 0}, {s, c, 0}, {0, 0, 1}}};
}

template <int N>
void expect_invariants_of_matrix(const Sym<double, N>& a) {
  const Matrix m = to_matrix(a);
  double square = 0;
  for (const auto& row : m)
    for (double x : row) square += x * x;
  const double mean_value = (m[0][0] + m[1][1] + m[2][2]) / 3;
  // Sums of at most nine terms of size 1: a few times 1e-16.
  EXPECT_NEAR(norm(a), std::sqrt(square), 2e-15);
  EXPECT_NEAR(mean(a), mean_value, 1e-15);
  EXPECT_NEAR(trace(deviator(a)), 0, 1e-15);
  EXPECT_NEAR(norm(a) * norm(a), norm(deviator(a)) * norm(deviator(a)) + 3 * mean_value * mean_value, 4e-15);
  EXPECT_NEAR(deviatoric_stress(a), std::sqrt(1.5) * norm(deviator(a)), 2e-15);
  EXPECT_NEAR(det(a), determinant(m), 4e-15);
}

TEST(Sym, InvariantsAreThoseOfTheMatrix) {
  std::mt19937 generator(1);
  for (int i = 0; i < 200; ++i) {
    expect_invariants_of_matrix(random_tensor<4>(generator));
    expect_invariants_of_matrix(random_tensor<6>(generator));
  }
}

TEST(Sym, DotIsTheFullContraction) {
  std::mt19937 generator(2);
  const auto a = random_tensor<6>(generator), b = random_tensor<6>(generator);
  const Matrix m = to_matrix(a), n = to_matrix(b);
  double sum = 0;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) sum += m[i][j] * n[i][j];
  EXPECT_NEAR(dot(a, b), sum, 2e-15);
}

TEST(Sym, TensorComponentsGoToMandelAndBack) {
  const auto a = to_mandel<6>({1, 2, 3, 4, 5, 6});
  EXPECT_DOUBLE_EQ(dot(a, a), 1 + 4 + 9 + 2 * (16 + 25 + 36));
  const auto t = from_mandel(a);
  for (std::size_t i = 0; i < 6; ++i) EXPECT_DOUBLE_EQ(t[i], static_cast<double>(i + 1));
}

TEST(Sym, TriaxialStress) {
  const Sym<double, 6> compression{{50, 50, 140, 0, 0, 0}}, extension{{90, 90, 30, 0, 0, 0}};
  EXPECT_DOUBLE_EQ(mean(compression), 80);
  EXPECT_NEAR(deviatoric_stress(compression), 90, 1e-13);
  EXPECT_NEAR(deviatoric_stress(extension), 60, 1e-13);
  // det and the norm each round off a few times.
  EXPECT_NEAR(cos_3_lode(deviator(compression)), 1, 1e-15);
  EXPECT_NEAR(cos_3_lode(deviator(extension)), -1, 1e-15);
}

TEST(Sym, LodeAngleInGeneralPosition) {
  for (int i = 0; i <= 60; ++i) {
    const double theta = pi / 3 * i / 60;
    for (double size : {1e-9, 1.0, 1e6}) {
      const auto s = size * at_lode_angle(theta, turn(0.3 * i, 1.1));
      EXPECT_NEAR(cos_3_lode(s), std::cos(3 * theta), 1e-14) << theta;  // det cancels to a few 1e-16, three factors
    }
  }
}

TEST(Sym, LodeAngleOfNothingIsTriaxialCompression) {
  EXPECT_EQ(cos_3_lode(Sym<double, 6>::zero()), 1);
  EXPECT_EQ(cos_3_lode(Sym<double, 4>{{1e-160, -1e-160, 0, 0}}), 1);
}

template <int N>
void expect_batch_is_double(std::mt19937& generator) {
  std::array<Sym<double, N>, batch_lanes> a, b;
  for (std::size_t i = 0; i < batch_lanes; ++i) {
    a[i] = random_tensor<N>(generator);
    b[i] = random_tensor<N>(generator);
  }
  a[0] = Sym<double, N>::zero();  // the lane that needs the select of cos_3_lode
  const auto x = pack<N>(a), y = pack<N>(b);
  for (std::size_t i = 0; i < batch_lanes; ++i) {
    // Fused multiply-add may be used in one and not in the other.
    EXPECT_NEAR(lane(dot(x, y), i), dot(a[i], b[i]), 2e-15);
    EXPECT_NEAR(lane(norm(x), i), norm(a[i]), 2e-15);
    EXPECT_NEAR(lane(trace(x), i), trace(a[i]), 1e-15);
    EXPECT_NEAR(lane(det(x), i), det(a[i]), 2e-15);
    EXPECT_NEAR(lane(deviatoric_stress(x), i), deviatoric_stress(a[i]), 2e-15);
    EXPECT_NEAR(lane(cos_3_lode(deviator(x)), i), cos_3_lode(deviator(a[i])), 2e-14);
    EXPECT_NEAR(norm(lane(x + Batch(2.0) * y - x, i) - 2.0 * b[i]), 0, 2e-15);
    EXPECT_NEAR(norm(lane(isotropic<Batch, N>(trace(x)), i) - isotropic<double, N>(trace(a[i]))), 0, 2e-15);
  }
}

TEST(Sym, BatchGivesWhatDoubleGives) {
  std::mt19937 generator(3);
  for (int i = 0; i < 50; ++i) {
    expect_batch_is_double<4>(generator);
    expect_batch_is_double<6>(generator);
  }
}

}  // namespace
}  // namespace scarp::test
