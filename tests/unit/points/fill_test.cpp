// Filling polygons: the area and its first moments are kept, points lie inside, spacings are as asked.
#include "scarp/points/fill.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "totals.hpp"

namespace scarp::test {
namespace {

const std::vector<Polygon> shapes{
    {{0, 0}, {4, 0}, {4, 2}, {0, 2}},
    {{0, 0}, {45, 0}, {45, 5}, {30, 5}, {15, 15}, {0, 15}},
    {{0.1, 0.2}, {3.7, 0.3}, {2.2, 5.1}},
    {{0, 0}, {10, 0}, {10, 10}, {9.9, 10}, {9.9, 0.1}, {0.1, 0.1}, {0.1, 10}, {0, 10}},  // thin walls
    {{0, 0}, {5, 1}, {10, 0}, {6, 5}, {10, 10}, {5, 9}, {0, 10}, {4, 5}}};               // a star

TEST(Fill, KeepsAreaAndCentroidAndStaysInside) {
  for (std::size_t s = 0; s < shapes.size(); ++s) {
    for (const double spacing : {100.0, 1.0, 0.33, 0.16}) {
      SCOPED_TRACE(testing::Message() << "shape " << s << ", spacing " << spacing);
      const auto filling = fill(shapes[s], spacing);
      ASSERT_GE(filling.volume.size(), 1u);
      const auto m = moments(shapes[s]);
      const auto sum = totals(filling, m.centroid);
      EXPECT_NEAR(sum.volume / m.area, 1.0, 1e-12);
      for (int j = 0; j < 2; ++j) EXPECT_NEAR(sum.centroid[j], m.centroid[j], 1e-11);
      for (const auto& x : filling.position) EXPECT_TRUE(contains(shapes[s], x)) << x[0] << ' ' << x[1];
    }
  }
}

TEST(Fill, RectangleIsItsLattice) {
  const auto filling = fill(shapes[0], 0.5);
  ASSERT_EQ(filling.volume.size(), 32u);
  for (std::size_t i = 0; i < 32; ++i) {
    EXPECT_NEAR(filling.position[i][0], 0.25 + 0.5 * static_cast<double>(i % 8), 1e-14);
    EXPECT_NEAR(filling.position[i][1], 0.25 + 0.5 * static_cast<double>(i / 8), 1e-14);
    EXPECT_NEAR(filling.volume[i], 0.25, 1e-15);
  }
}

TEST(Fill, OverlapIsFoundAndTouchingIsNot) {
  const Polygon right{{4, 0}, {8, 0}, {8, 2}, {4, 2}}, over{{3, 0}, {8, 0}, {8, 2}, {3, 2}};
  EXPECT_FALSE(overlap(shapes[0], fill(right, 0.5)));
  EXPECT_TRUE(overlap(shapes[0], fill(over, 0.5)));
}

}  // namespace
}  // namespace scarp::test
