// Principal values and projections: oracles are tensors made from known values and directions, and the identities
// that define a spectral decomposition.
#include "scarp/tensor/spectral.hpp"

#include <gtest/gtest.h>
#include <cmath>
#include <random>

#include "material/lanes.hpp"
#include "scarp/tensor/rotation.hpp"
#include "unit/tensor/matrix.hpp"

namespace scarp::test {
namespace {

/// Rounding of some tens of operations on numbers of the tensor's size.
constexpr double rounding = 2e-15;

template <int N>
Rotation<double, N> random_turn(std::mt19937& generator) {
  std::uniform_real_distribution<double> angle(-4, 4);
  Spin<double, N> spin;
  for (double& w : spin.w) w = angle(generator);
  return Rotation<double, N>(spin);
}

/// a = Σ value projection, projections of unit trace that multiply to themselves and to zero with each other.
template <int N>
void expect_decomposition(const Sym<double, N>& a, const Spectral<double, N>& s) {
  EXPECT_GE(s.value[0], s.value[1]);
  EXPECT_GE(s.value[1], s.value[2]);
  EXPECT_LE(norm(composed(s.value, s.projection) - a), rounding * norm(a));
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(trace(s.projection[i]), 1, rounding);
    for (std::size_t j = 0; j < 3; ++j) EXPECT_NEAR(dot(s.projection[i], s.projection[j]), i == j, 2 * rounding);
  }
}

/// Known principal values in known, random directions; among them repeated and nearly repeated ones.
template <int N>
void expect_known_values() {
  std::mt19937 generator(11);
  std::uniform_real_distribution<double> uniform(-100, 100);
  for (int i = 0; i < 3000; ++i) {
    std::array<double, 3> value{uniform(generator), uniform(generator), uniform(generator)};
    if (i % 4 == 1) value[1] = value[0];
    if (i % 4 == 2) value[1] = value[2] = value[0];
    if (i % 4 == 3) value[2] = value[0] * (1 + std::pow(10.0, -(i % 17)));
    auto a = Sym<double, N>::zero();
    for (int c = 0; c < 3; ++c) a[c] = value[static_cast<std::size_t>(c)];
    a = random_turn<N>(generator)(a);
    std::sort(value.begin(), value.end(), std::greater<>());
    const auto s = spectral(a);
    expect_decomposition(a, s);
    for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(s.value[c], value[c], rounding * norm(a));
  }
}

TEST(Spectral, KnownValuesInTurnedDirections) {
  expect_known_values<4>();
  expect_known_values<6>();
}

TEST(Spectral, DirectionsOfATurnedDiagonalTensor) {
  std::mt19937 generator(12);
  for (int i = 0; i < 200; ++i) {
    const auto turn = random_turn<6>(generator);
    const Sym<double, 6> a{{3, 7, -2, 0, 0, 0}};
    const auto s = spectral(turn(a));
    EXPECT_LE(norm(s.projection[0] - turn(Sym<double, 6>{{0, 1, 0, 0, 0, 0}})), 1e-14);
    EXPECT_LE(norm(s.projection[1] - turn(Sym<double, 6>{{1, 0, 0, 0, 0, 0}})), 1e-14);
    EXPECT_LE(norm(s.projection[2] - turn(Sym<double, 6>{{0, 0, 1, 0, 0, 0}})), 1e-14);
  }
}

TEST(Spectral, AwkwardTensors) {
  for (double size : {1.0, 1e-9, 1e9, 0.0}) {
    for (int mask = 0; mask < 64; ++mask) {
      Sym<double, 6> a;
      for (int c = 0; c < 6; ++c) a[c] = ((mask >> c) & 1) * size * (c < 3 ? 1 : -2);
      expect_decomposition(a, spectral(a));
      const Sym<double, 4> flat{{a[0], a[1], a[2], a[3]}};
      expect_decomposition(flat, spectral(flat));
    }
  }
}

template <int N>
void expect_batch_is_double() {
  std::mt19937 generator(13);
  for (int repeat = 0; repeat < 200; ++repeat) {
    std::array<Sym<double, N>, batch_lanes> a;
    for (std::size_t l = 0; l < batch_lanes; ++l) {
      a[l] = random_tensor<N>(generator, 50);
      if (l % 4 == 1) a[l] = isotropic<double, N>(3);
      if (l % 4 == 2) a[l][1] = a[l][0], a[l][3] = 0;
      if (l % 4 == 3) a[l] = Sym<double, N>::zero();
    }
    const auto many = spectral(pack<N>(a));
    for (std::size_t l = 0; l < batch_lanes; ++l) {
      const auto one = spectral(a[l]);
      for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_NEAR(lane(many.value[i], l), one.value[i], rounding * norm(a[l]));
        EXPECT_LE(norm(lane(many.projection[i], l) - one.projection[i]),
                  1e-12);  // values of a are apart by > 1e-3 of ‖a‖
      }
    }
  }
}

TEST(Spectral, BatchGivesWhatDoubleGives) {
  expect_batch_is_double<4>();
  expect_batch_is_double<6>();
}

}  // namespace
}  // namespace scarp::test
