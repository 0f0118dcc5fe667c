// What a case will take of memory. Oracles: areas and volumes over spacings; that soil does not depend on the grid.
#include "scarp/run/memory_need.hpp"

#include <gtest/gtest.h>

#include "scarp/mesh/grid.hpp"
#include "unit/input/minimal.hpp"

namespace scarp::run {
namespace {

using input::test::minimal;
using input::test::read;
using input::test::replaced;

/// The minimal case in a grid of n × n elements.
input::Case with_grid(long n) {
  const auto size = std::to_string(n) + ".0";
  return read(replaced(minimal, "origin = [-1.0, 0.0], size = [4.0, 2.0], element = 0.5",
                       "origin = [-1.0, 0.0], size = [" + size + ", " + size + "], element = 1.0"));
}

TEST(MemoryNeed, CountsPointsByTheRegion) {
  const auto input = read(minimal);
  EXPECT_NEAR(expected_points(input.regions[0]), 2.0 / (0.25 * 0.25), 1e-9);  // 1 m × 2 m
  EXPECT_NEAR(expected_points(input.regions[1]), 0.5 / (0.5 * 0.5), 1e-9);    // half a square metre
}

TEST(MemoryNeed, OfAGridIsThatOfItsLinesAndSides) {
  const auto small = memory_need(with_grid(1000)), large = memory_need(with_grid(10000));
  EXPECT_EQ(small.points, large.points);
  // Ten times as many lines and nodes of sides, no element: a page for each node of the left and right side at most.
  EXPECT_LT(large.grid, 2 * 10001 * 4096 * 1.2);
  EXPECT_GT(large.grid, 4 * 10001 * sizeof(int));
  EXPECT_LT(large.grid, 10.1 * 10.1 * small.grid);
  // Addresses grow with the elements: 100 times, to a percent of the sides.
  EXPECT_NEAR(large.addresses / small.addresses, 100, 1);
  // make_grid() says what is too many.
  EXPECT_EQ(memory_need(with_grid(50000)).grid, 0);
}

// In the plane and in space a side is many pieces of nodes or one; pages are never more than the array has.
TEST(MemoryNeed, OfSidesIsNoMoreThanTheArray) {
  const auto thin = memory_need(
      read(replaced(minimal, "size = [4.0, 2.0], element = 0.5", "size = [1e3, 1e6], elements = [1000, 1000000]")));
  const double nodes = 1000001.0 * 1001;
  EXPECT_LT(thin.grid, 4 * nodes * 1.001 + 2 * (1e6 + 1e3) * 1.1 * (sizeof(int) + sizeof(double)));
  EXPECT_GT(thin.grid, nodes);
}

}  // namespace
}  // namespace scarp::run
