#include "scarp/base/whole_division.hpp"

#include <gtest/gtest.h>

#include <initializer_list>
#include <limits>
#include <random>

namespace scarp {
namespace {

// Oracle: the division of the machine, where a product may just miss: at multiples and just below them.
TEST(WholeDivision, IsThatOfTheMachine) {
  constexpr int most = std::numeric_limits<int>::max();
  std::mt19937 random(1);
  const auto any = [&](int limit) { return static_cast<int>(random() % static_cast<unsigned>(limit)); };
  const auto check = [&](int d) {
    const WholeDivision by(d);
    for (int i = 0; i < 200; ++i) {
      const int multiple = any(most / d) * d;
      for (const int n : {multiple, multiple > 0 ? multiple - 1 : 0, any(most)})
        ASSERT_EQ(by(n), n / d) << n << '/' << d;
    }
    for (const int n : {0, 1, d - 1, d, most - 1, most, most / d * d - 1}) ASSERT_EQ(by(n), n / d) << n << '/' << d;
  };
  for (int d = 1; d < 2000; ++d) check(d);
  for (int bit = 11; bit < 31; ++bit)
    for (const int d : {(1 << bit) - 1, 1 << bit, (1 << bit) + 1}) check(d);
  for (int i = 0; i < 2000; ++i) check(1 + any(most - 1));
  check(most - 1);
}

}  // namespace
}  // namespace scarp
