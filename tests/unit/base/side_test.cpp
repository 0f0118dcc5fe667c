// The side of a line, where double arithmetic would be wrong.
#include "scarp/base/side.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace scarp {
namespace {

TEST(Side, PlainCases) {
  EXPECT_EQ(side_of_line({0, 0}, {1, 0}, {0.3, 1}), 1);
  EXPECT_EQ(side_of_line({0, 0}, {1, 0}, {0.3, -1}), -1);
  EXPECT_EQ(side_of_line({1, 0}, {0, 0}, {0.3, -1}), 1);
  EXPECT_EQ(side_of_line({0.1, 0.1}, {0.7, 0.7}, {0.3, 0.3}), 0);
}

// Points a few units in the last place about (0.5, 0.5), against the line from (12, 12) to (24, 24): left where y > x.
// Double arithmetic fails at many of them (Kettner et al., Classroom examples of robustness problems, 2008).
TEST(Side, UnitsInTheLastPlace) {
  const double unit = std::ldexp(1.0, -53);
  int wrong = 0;
  for (int i = 0; i < 64; ++i) {
    for (int j = 0; j < 64; ++j) {
      const Vec<2> x{0.5 + i * unit, 0.5 + j * unit};
      const int expected = (x[1] > x[0]) - (x[1] < x[0]);
      ASSERT_EQ(side_of_line({12, 12}, {24, 24}, x), expected) << i << ' ' << j;
      ASSERT_EQ(side_of_line({24, 24}, {12, 12}, x), -expected) << i << ' ' << j;
      const volatile double left = (24.0 - 12.0) * (x[1] - 12.0), right = (24.0 - 12.0) * (x[0] - 12.0);
      wrong += (left > right) - (left < right) != expected;
    }
  }
  EXPECT_GT(wrong, 100) << "the test tests nothing";
}

TEST(Side, EndsOfTheLineAreOnIt) {
  const Vec<2> a{0.1, 1.0 / 3}, b{std::sqrt(2.0), -0.7};
  EXPECT_EQ(side_of_line(a, b, a), 0);
  EXPECT_EQ(side_of_line(a, b, b), 0);
}

}  // namespace
}  // namespace scarp
