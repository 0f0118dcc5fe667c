// Sums that are rounded once. Oracle: fractions of Python, whose conversion to double is correctly rounded.
#include "scarp/base/exact_sum.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <random>
#include <vector>

namespace scarp {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

std::uint64_t bits(double x) {
  return std::bit_cast<std::uint64_t>(x);
}

double sum_of(const std::vector<double>& numbers) {
  ExactSum sum;
  for (const double x : numbers) sum.add(x);
  return sum.value();
}

struct Known {
  const char* what;
  std::vector<double> numbers;
  double sum;  ///< float(sum(map(Fraction, numbers)))
};

const std::vector<Known>& known() {
  static const std::vector<Known> all{
      {"all sizes",
       {0x1.f2a7452e6b438p-715, -0x1.0c5c7a6a3a450p-875, -0x1.1818e892f902bp-275, 0x1.e8e250ed90475p+16,
        0x1.1600a099950d8p-135, -0x1.3d9c111e20b8fp-838, -0x1.0f21d6cad4a26p+670, -0x1.f28c11fb17c23p-566,
        0x1.953f4a09f76b5p+917, 0x1.95e6093bd04cfp-211, -0x1.3898df9ebdaccp-928, 0x1.2217bdbc496cbp-430},
       0x1.953f4a09f76b5p+917},
      {"alike",
       {-0x1.8a6a624ede6a4p-5, 0x1.8f6d04ef8aa38p-3, 0x1.923a794e3bf91p-2, -0x1.8c38f18f135d2p-6, 0x1.9e7760f4205b4p-2,
        -0x1.881edae2eb154p+5, 0x1.7731a506bf2efp+6, -0x1.3f98e4cbd87adp-3, -0x1.3e7d1c7a2ea20p-6,
        -0x1.867344cdd2055p+7, 0x1.babce57ee05cdp+6, 0x1.faecb9be4bcfcp-6},
       -0x1.37da34fd68be9p+5},
      {"all but a rest cancels",
       {-0x1.6b0a1830e07bcp-13, 0x1.26e875790f82ep+36, 0x1.0a0976bf46c69p+19, -0x1.8ede0c3baea9ep+13,
        0x1.d17f9e01f5057p-3, -0x1.d17f9e01f5057p-3, 0x1.8ede0c3baea9ep+13, -0x1.0a0976bf46c69p+19,
        -0x1.26e875790f82ep+36, 0x1.6b0a1830e07bcp-13, 0x1.59a54b1fee08fp-114},
       0x1.59a54b1fee08fp-114},
      {"below the smallest normal number",
       {0x1.cc0119474031bp-1022, 0x1.17f5ed70820fep-1022, 0x0.aa05eb2715945p-1022, -0x1.b394fbb2d420fp-1022,
        0x1.fe3b893f448b3p-1022, 0x1.62c33b774eb52p-1022, 0x1.7631af0ce5835p-1022, 0x1.1df9f9c653938p-1022},
       0x1.f3e498ed74030p-1020},
      {"halfway to even below", {0x1.0000000000000p+0, 0x1.0000000000000p-53}, 0x1.0000000000000p+0},
      {"halfway to even above", {0x1.0000000000001p+0, 0x1.0000000000000p-53}, 0x1.0000000000002p+0},
      {"just above halfway",
       {0x1.0000000000000p+0, 0x1.0000000000000p-53, 0x0.0000000000001p-1022},
       0x1.0000000000001p+0},
      {"just below halfway",
       {0x1.0000000000000p+0, 0x1.0000000000000p-53, -0x0.0000000000001p-1022},
       0x1.0000000000000p+0},
      {"negative, just beyond halfway",
       {-0x1.0000000000000p+0, -0x1.0000000000000p-53, -0x0.0000000000001p-1022},
       -0x1.0000000000001p+0},
      {"up to the next power of two", {0x1.fffffffffffffp+0, 0x1.0000000000000p-53}, 0x1.0000000000000p+1},
      {"too large in between only",
       {0x1.e42d130773b76p+1023, 0x1.e42d130773b76p+1023, -0x1.e42d130773b76p+1023, -0x1.c7b1f3cac7433p+1023},
       0x1.c7b1f3cac7430p+1019},
      {"nothing left",
       {0x1.999999999999ap-4, 0x1.999999999999ap-3, -0x1.999999999999ap-4, -0x1.999999999999ap-3},
       0x0.0p+0},
      {"carries through many limbs",
       {0x1.0000000000000p+900, -0x0.0000000000001p-1022, -0x1.fffffffffffffp+899},
       0x1.0000000000000p+847},
  };
  return all;
}

TEST(ExactSum, IsThatOfFractions) {
  for (const auto& [what, numbers, sum] : known()) EXPECT_EQ(bits(sum_of(numbers)), bits(sum)) << what;
}

TEST(ExactSum, HasTheSameBitsInAnyOrderAndInAnyParts) {
  std::mt19937 random(3);
  for (auto [what, numbers, sum] : known()) {
    for (int times = 0; times < 20; ++times) {
      std::shuffle(numbers.begin(), numbers.end(), random);
      ExactSum one, other;
      for (const double x : numbers) (random() % 2 == 0 ? one : other).add(x);
      one += other;
      EXPECT_EQ(bits(one.value()), bits(sum)) << what;
    }
  }
}

// Plain sums of these differ from order to order.
TEST(ExactSum, OfManyIsNearALongerSum) {
  std::mt19937_64 random(5);
  std::normal_distribution<double> normal;
  std::vector<double> numbers(100000);
  for (double& x : numbers) x = std::exp(10 * normal(random)) * normal(random);
  long double longer = 0, magnitudes = 0;
  double plain = 0;
  for (const double x : numbers) {
    longer += x;
    magnitudes += std::abs(x);
    plain += x;
  }
  const double exact = sum_of(numbers);
  // 64 bits in place of 53: an error of at most 1e5 half units of these.
  EXPECT_NEAR(static_cast<double>(longer - exact), 0,
              static_cast<double>(magnitudes * 1e5L * std::numeric_limits<long double>::epsilon()));
  std::sort(numbers.begin(), numbers.end());
  double sorted = 0;
  for (const double x : numbers) sorted += x;
  EXPECT_NE(plain, sorted);
  EXPECT_EQ(bits(exact), bits(sum_of(numbers)));
}

TEST(ExactSum, GoesOnWhatIsNotFinite) {
  EXPECT_EQ(sum_of({1, infinity, -1e308}), infinity);
  EXPECT_EQ(sum_of({-infinity, 1}), -infinity);
  EXPECT_TRUE(std::isnan(sum_of({infinity, 1, -infinity})));
  EXPECT_TRUE(std::isnan(sum_of({std::nan(""), 1})));
  EXPECT_EQ(sum_of({1.7e308, 1.7e308}), infinity);
  EXPECT_EQ(sum_of({-1.7e308, -1.7e308}), -infinity);
}

TEST(ExactSum, OfNothingIsZero) {
  EXPECT_EQ(bits(sum_of({})), bits(0.0));
  EXPECT_EQ(bits(sum_of({-0.0})), bits(0.0));
  ExactSum sum;
  sum.add(3);
  sum.clear();
  EXPECT_EQ(sum.value(), 0);
}

// Doubled 62 times it is the sum of 2^62 numbers: carries are passed on in time.
TEST(ExactSum, HasRoomForAnyNumberOfNumbers) {
  for (const double x : {1.0 - 0x1p-53, -0x1.fffffffffffffp+31, 0x1.fffffffffffffp-1000}) {
    ExactSum sum;
    sum.add(x);
    for (int times = 0; times < 62; ++times) sum += ExactSum(sum);
    EXPECT_EQ(sum.value(), std::ldexp(x, 62));
  }
}

}  // namespace
}  // namespace scarp
