// The utility routines of Abaqus that scarp provides, called as a Fortran routine calls them.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <string>

#include "scarp/material/umat_library.hpp"

extern "C" {
void xit_();
void stdb_abqerr_(const int* LOP, const char* STRING, const int* INTV, const double* REALV, const char* CHARV,
                  std::size_t STRING_length, std::size_t CHARV_length);
void rotsig_(const double* S, const double* R, double* SPRIME, const int* LSTR, const int* NDI, const int* NSHR);
void sinv_(const double* STRESS, double* SINV1, double* SINV2, const int* NDI, const int* NSHR);
void sprind_(const double* S, double* PS, double* AN, const int* LSTR, const int* NDI, const int* NSHR);
void sprinc_(const double* S, double* PS, const int* LSTR, const int* NDI, const int* NSHR);
}

namespace scarp::test {
namespace {

constexpr int stress = 1, strain = 2, three = 3, one = 1;

TEST(UmatUtilities, InvariantsOfKnownStresses) {
  double mean, mises;
  const std::array<double, 6> uniaxial{90, 0, 0, 0, 0, 0}, shear{5, 5, 5, 10, 0, 0}, mixed{0, 0, 0, 3, 4, 12};
  sinv_(uniaxial.data(), &mean, &mises, &three, &three);
  EXPECT_DOUBLE_EQ(mean, 30);
  EXPECT_DOUBLE_EQ(mises, 90);
  sinv_(shear.data(), &mean, &mises, &three, &one);
  EXPECT_DOUBLE_EQ(mean, 5);
  EXPECT_DOUBLE_EQ(mises, 10 * std::sqrt(3.0));
  sinv_(mixed.data(), &mean, &mises, &three, &three);
  EXPECT_DOUBLE_EQ(mean, 0);
  EXPECT_DOUBLE_EQ(mises, 13 * std::sqrt(3.0));
}

// R turns by 90° about z: x → y, y → −x. Direct components change places, 12 changes sign, 13 → 23, 23 → −13.
TEST(UmatUtilities, RotationByARightAngle) {
  const std::array<double, 9> R{0, 1, 0, -1, 0, 0, 0, 0, 1};  // columns of R, one after the other
  const std::array<double, 6> S{1, 2, 3, 4, 5, 6}, expected{2, 1, 3, -4, -6, 5};
  std::array<double, 6> turned{};
  for (const int kind : {stress, strain}) {
    rotsig_(S.data(), R.data(), turned.data(), &kind, &three, &three);
    for (std::size_t i = 0; i < 6; ++i) EXPECT_DOUBLE_EQ(turned[i], expected[i]) << i;
  }
}

// A turn by 45° about z of pure shear: as a stress ±τ, as an engineering strain ±γ/2.
TEST(UmatUtilities, StrainsHaveEngineeringShear) {
  const double c = std::sqrt(0.5);
  const std::array<double, 9> R{c, c, 0, -c, c, 0, 0, 0, 1};
  const std::array<double, 4> S{0, 0, 0, 10};
  std::array<double, 4> turned{};
  rotsig_(S.data(), R.data(), turned.data(), &stress, &three, &one);
  EXPECT_NEAR(turned[0], -10, 1e-14);
  EXPECT_NEAR(turned[1], 10, 1e-14);
  EXPECT_NEAR(turned[3], 0, 1e-14);
  rotsig_(S.data(), R.data(), turned.data(), &strain, &three, &one);
  EXPECT_NEAR(turned[0], -5, 1e-14);
  std::array<double, 3> principal{};
  sprinc_(S.data(), principal.data(), &strain, &three, &one);
  std::sort(principal.begin(), principal.end());
  EXPECT_NEAR(principal[0], -5, 1e-14);
  EXPECT_NEAR(principal[1], 0, 1e-14);
  EXPECT_NEAR(principal[2], 5, 1e-14);
}

// Oracle: Σ PS_k n_k ⊗ n_k is the tensor again, and the directions are orthonormal. Also with equal principal values.
TEST(UmatUtilities, PrincipalDirectionsRebuildTheTensor) {
  std::mt19937 generator(1);
  std::uniform_real_distribution<double> uniform(-100, 100);
  for (int trial = 0; trial < 200; ++trial) {
    std::array<double, 6> S;
    for (auto& x : S) x = uniform(generator);
    if (trial == 0) S = {7, 7, 7, 0, 0, 0};
    if (trial == 1) S = {7, 7, 3, 0, 0, 0};
    if (trial == 2) S = {1, 1, 1, 1, 1, 1};  // 3, 0, 0
    std::array<double, 3> values{}, alone{};
    std::array<double, 9> n{};
    sprind_(S.data(), values.data(), n.data(), &stress, &three, &three);
    sprinc_(S.data(), alone.data(), &stress, &three, &three);
    EXPECT_EQ(values, alone);
    auto direction = [&](std::size_t k, std::size_t i) { return n[k + 3 * i]; };
    const std::array<std::array<std::size_t, 2>, 6> at{{{0, 0}, {1, 1}, {2, 2}, {0, 1}, {0, 2}, {1, 2}}};
    for (std::size_t c = 0; c < 6; ++c) {
      double sum = 0, dot = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        sum += values[k] * direction(k, at[c][0]) * direction(k, at[c][1]);
        dot += direction(at[c][0], k) * direction(at[c][1], k);
      }
      EXPECT_NEAR(sum, S[c], 1e-12 * 300);  // rounding of some ten operations on numbers of 300
      EXPECT_NEAR(dot, c < 3 ? 1 : 0, 1e-14);
    }
  }
}

TEST(UmatUtilities, XitIsAnException) {
  EXPECT_THROW(xit_(), umat::Stopped);
}

TEST(UmatUtilities, MessagesAreFilledIn) {
  const std::string text = "%I points at %S of %S, R = %R   ", words = "corner  slope   ";
  const int fatal = -3, warning = -1, count = 3;
  const double ratio = 0.5;
  try {
    stdb_abqerr_(&fatal, text.data(), &count, &ratio, words.data(), text.size(), 8);
    ADD_FAILURE() << "the analysis goes on";
  } catch (const umat::Stopped& stop) {
    EXPECT_STREQ(stop.what(), "3 points at corner of slope, R = 0.500000");
  }
  testing::internal::CaptureStderr();
  stdb_abqerr_(&warning, text.data(), &count, &ratio, words.data(), text.size(), 8);
  EXPECT_NE(testing::internal::GetCapturedStderr().find("warning: UMAT: 3 points at corner"), std::string::npos);
}

}  // namespace
}  // namespace scarp::test
