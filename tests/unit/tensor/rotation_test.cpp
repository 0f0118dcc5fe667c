// Incremental rotation: (I − W/2)⁻¹ (I + W/2) solved with plain matrices, and what every rotation must satisfy.
#include <gtest/gtest.h>
#include <cmath>
#include <numbers>

#include "material/lanes.hpp"
#include "matrix.hpp"
#include "scarp/tensor/rotation.hpp"

namespace scarp::test {
namespace {

constexpr double pi = std::numbers::pi;

/// W_ij = ½ (L_ij − L_ji) dt from W_xy, W_yz, W_zx.
Matrix spin_matrix(const std::array<double, 3>& w) {
  return {{{0, w[0], -w[2]}, {-w[0], 0, w[1]}, {w[2], -w[1], 0}}};
}

Matrix inverse(const Matrix& a) {
  const double d = determinant(a);
  Matrix r{};
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      const std::size_t i1 = (i + 1) % 3, i2 = (i + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;
      r[j][i] = (a[i1][j1] * a[i2][j2] - a[i1][j2] * a[i2][j1]) / d;
    }
  }
  return r;
}

Matrix hughes_winget(const std::array<double, 3>& w) {
  Matrix minus{}, plus{};
  const Matrix m = spin_matrix(w);
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      const double unit = i == j ? 1 : 0;
      minus[i][j] = unit - 0.5 * m[i][j];
      plus[i][j] = unit + 0.5 * m[i][j];
    }
  }
  return inverse(minus) * plus;
}

template <int N>
Spin<double, N> spin(const std::array<double, 3>& w) {
  if constexpr (N == 4) return {{w[0]}};
  if constexpr (N == 6) return {w};
}

template <int N>
std::array<double, 3> random_spin(std::mt19937& generator, double size) {
  std::uniform_real_distribution<double> uniform(-size, size);
  if constexpr (N == 4) return {uniform(generator), 0, 0};
  return {uniform(generator), uniform(generator), uniform(generator)};
}

template <int N>
void expect_formula(double size) {
  std::mt19937 generator(4);
  for (int i = 0; i < 100; ++i) {
    const auto w = random_spin<N>(generator, size);
    const auto a = random_tensor<N>(generator);
    const Matrix q = hughes_winget(w);
    const auto turned = Rotation<double, N>(spin<N>(w))(a);
    // 27 products of size 1; a large W makes the twin's inverse lose a digit.
    EXPECT_NEAR(norm(turned - from_matrix<N>(q * to_matrix(a) * transposed(q))), 0, 2e-14);
  }
}

TEST(Rotation, IsTheFormulaOfHughesAndWinget) {
  for (double size : {1e-6, 1e-2, 3.0}) {
    expect_formula<4>(size);
    expect_formula<6>(size);
  }
}

template <int N>
void expect_orthogonal() {
  std::mt19937 generator(5);
  for (int i = 0; i < 100; ++i) {
    const Rotation<double, N> q(spin<N>(random_spin<N>(generator, i < 50 ? 1e-3 : 2.0)));
    const auto a = random_tensor<N>(generator), b = random_tensor<N>(generator);
    EXPECT_NEAR(norm(q(isotropic<double, N>(1.0)) - isotropic<double, N>(1.0)), 0, 2e-15);  // Q Qᵀ = I
    EXPECT_NEAR(dot(q(a), q(b)), dot(a, b), 5e-15);
    EXPECT_NEAR(det(q(a)), det(a), 5e-15);
  }
}

TEST(Rotation, IsOrthogonal) {
  expect_orthogonal<4>();
  expect_orthogonal<6>();
}

// Eqs 12, 13: dA = W A − A W to first order, with W of L_ij = ∂v_i/∂x_j. At W of size w the rest is O(w²).
template <int N>
void expect_first_order() {
  std::mt19937 generator(6);
  const double w = 1e-5;
  for (int i = 0; i < 20; ++i) {
    const auto rates = random_spin<N>(generator, w);
    const auto a = random_tensor<N>(generator);
    const Matrix m = spin_matrix(rates), am = to_matrix(a), wa = m * am, aw = am * m;
    Matrix change{};
    for (std::size_t r = 0; r < 3; ++r)
      for (std::size_t c = 0; c < 3; ++c) change[r][c] = wa[r][c] - aw[r][c];
    const auto rest = Rotation<double, N>(spin<N>(rates))(a) - a - from_matrix<N>(change);
    EXPECT_LT(norm(rest), 20 * w * w);
  }
}

TEST(Rotation, AgreesWithTheReportToFirstOrder) {
  expect_first_order<4>();
  expect_first_order<6>();
}

// A body that turns anticlockwise about z has v = (−ω y, ω x), so W_xy = −ω. Stress along x is along y after 90°.
template <int N>
void expect_turns_with_the_body() {
  const int steps = 1000;
  const double w = 2 * std::tan(0.5 * (0.5 * pi) / steps);  // tan(φ/2) = w/2: exactly a quarter turn
  const Rotation<double, N> q(spin<N>({-w, 0, 0}));
  auto a = Sym<double, N>::zero();
  a[0] = 1;
  auto b = a;
  for (int i = 0; i < steps; ++i) {
    a = q(a);
    if (i < steps / 2) b = q(b);
  }
  EXPECT_NEAR(a[1], 1, 1e-13);  // a thousand roundings
  EXPECT_NEAR(a[0], 0, 1e-13);
  EXPECT_NEAR(b[3], sqrt2 * 0.5, 1e-13);  // +xy after 45°
}

TEST(Rotation, TurnsTensorsWithTheBody) {
  expect_turns_with_the_body<4>();
  expect_turns_with_the_body<6>();
}

TEST(Rotation, AFullTurnAboutAnyAxisReturns) {
  const int steps = 2000;
  const double w = 2 * std::tan(pi / steps), n[3] = {2.0 / 3, -1.0 / 3, 2.0 / 3};
  const Rotation<double, 6> q(Spin<double, 6>{{-w * n[2], -w * n[0], -w * n[1]}});
  std::mt19937 generator(7);
  const auto start = random_tensor<6>(generator);
  auto a = start;
  for (int i = 0; i < steps; ++i) a = q(a);
  EXPECT_NEAR(norm(a - start), 0, 1e-12);  // 2000 steps of a few 1e-16
}

TEST(Rotation, OneRadianInManyStepsKeepsTheInvariants) {
  Sym<double, 4> a{{1, 0.2, 0.4, 0.3}};
  const double q0 = deviatoric_stress(a);
  const Rotation<double, 4> q(Spin<double, 4>{{1e-2}});
  for (int i = 0; i < 100; ++i) a = q(a);
  EXPECT_NEAR(deviatoric_stress(a), q0, 1e-14);  // the first-order form gains 2 % here
}

template <int N>
void expect_batch_is_double() {
  std::mt19937 generator(8);
  std::array<Sym<double, N>, batch_lanes> a;
  std::array<std::array<double, 3>, batch_lanes> w;
  Spin<Batch, N> spins;
  for (std::size_t i = 0; i < batch_lanes; ++i) {
    a[i] = random_tensor<N>(generator);
    w[i] = random_spin<N>(generator, 0.1);
  }
  for (std::size_t c = 0; c < spins.w.size(); ++c) {
    std::array<double, batch_lanes> values;
    for (std::size_t i = 0; i < batch_lanes; ++i) values[i] = w[i][c];
    spins.w[c] = pack(values);
  }
  const auto turned = Rotation<Batch, N>(spins)(pack<N>(a));
  for (std::size_t i = 0; i < batch_lanes; ++i) {
    EXPECT_NEAR(norm(lane(turned, i) - Rotation<double, N>(spin<N>(w[i]))(a[i])), 0, 2e-15);
  }
}

TEST(Rotation, BatchGivesWhatDoubleGives) {
  expect_batch_is_double<4>();
  expect_batch_is_double<6>();
}

}  // namespace
}  // namespace scarp::test
