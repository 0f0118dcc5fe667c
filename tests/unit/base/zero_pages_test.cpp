#include "scarp/base/zero_pages.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <fstream>
#include <string>

namespace scarp {
namespace {

/// Memory in use by this program [bytes].
double resident() {
  std::ifstream file("/proc/self/statm");
  double pages = 0, resident_pages = 0;
  file >> pages >> resident_pages;
  return resident_pages * 4096;
}

TEST(ZeroPages, AreZeroAndCostWhatIsTouched) {
  constexpr std::size_t count = 500'000'000;
  const double before = resident();
  ZeroPages<int> numbers(count);
  for (const std::size_t i : {std::size_t{0}, count / 3, count - 1}) {
    EXPECT_EQ(numbers[i], 0);
    numbers[i] = 7;
  }
  EXPECT_EQ(numbers[count / 3], 7);
  EXPECT_EQ(numbers[count / 3 + 1], 0);
  EXPECT_LT(resident() - before, 20e6);
}

TEST(MostlyNone, IsNoneUntilItIsSet) {
  const double before = resident();
  MostlyNone<std::int8_t> numbers;
  EXPECT_TRUE(numbers.empty());
  numbers.resize(800'000'000);
  EXPECT_EQ(numbers.size(), 800'000'000u);
  EXPECT_EQ(numbers[0], -1);
  EXPECT_EQ(numbers[799'999'999], -1);
  for (const int value : {0, 2, -2, -1, 126}) {
    numbers.set(12345, value);
    EXPECT_EQ(numbers[12345], value);
  }
  EXPECT_EQ(numbers[12344], -1);
  EXPECT_EQ(numbers[12346], -1);
  EXPECT_LT(resident() - before, 20e6);
}

}  // namespace
}  // namespace scarp
