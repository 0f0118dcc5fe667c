// What two regions share: closed forms.
#include "scarp/base/overlap.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace scarp {
namespace {

Polygon rectangle(double x, double y, double width, double height) {
  return {{x, y}, {x + width, y}, {x + width, y + height}, {x, y + height}};
}

TEST(Overlap, OfPolygons) {
  const auto shared = shared_by(rectangle(0, 0, 4, 1), rectangle(3, 0.9, 1, 0.6));
  ASSERT_TRUE(shared);
  EXPECT_NEAR(shared->volume, 0.1, 1e-15);
  EXPECT_NEAR(shared->depth, 0.1, 1e-15);
  EXPECT_NEAR(shared->at[0], 3.5, 1e-15);
  EXPECT_NEAR(shared->at[1], 0.95, 1e-15);
  // Upright, and both ways round.
  const auto upright = shared_by(rectangle(0, 0, 1, 4), Polygon{{0.9, 1}, {0.9, 3}, {2, 3}, {2, 1}});
  ASSERT_TRUE(upright);
  EXPECT_NEAR(upright->volume, 0.2, 1e-15);
  EXPECT_NEAR(upright->depth, 0.1, 1e-15);
  // Two triangles that make a star of David: a hexagon of edge 1.
  const double h = std::sqrt(3.0);
  const auto star = shared_by(Polygon{{0, 0}, {3, 0}, {1.5, 1.5 * h}}, Polygon{{0, h}, {1.5, -0.5 * h}, {3, h}});
  ASSERT_TRUE(star);
  EXPECT_NEAR(star->volume, 1.5 * h, 1e-14);
}

TEST(Overlap, OfPolygonsThatTouch) {
  const auto nothing = [](const Polygon& a, const Polygon& b) {
    const auto shared = shared_by(a, b);
    return !shared || shared->depth < 1e-12;
  };
  EXPECT_TRUE(nothing(rectangle(0, 0, 4, 1), rectangle(0, 1, 4, 1)));
  EXPECT_TRUE(nothing(rectangle(0, 0, 4, 1), rectangle(4, -3, 4, 9)));
  EXPECT_TRUE(nothing(rectangle(0, 0, 4, 1), rectangle(4, 1, 1, 1)));
  EXPECT_TRUE(nothing(rectangle(0, 0, 1, 1), rectangle(5, 5, 1, 1)));
  // An L and what fills its corner; a slope that the other one has a corner more on, as thirds have round-off.
  EXPECT_TRUE(nothing({{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 3}, {0, 3}}, rectangle(1, 1, 2, 2)));
  EXPECT_TRUE(nothing({{0, 0}, {3, 0}, {3, 1}}, {{0, 0}, {1, 1.0 / 3}, {3, 1}, {0, 1}}));
}

TEST(Overlap, OfSolids) {
  const Solid ground = make_box({0, 0, 0}, {4, 4, 1});
  const auto shared = shared_by(ground, Solid{make_box({1, 1, 0.9}, {2, 3, 2})});
  ASSERT_TRUE(shared);
  EXPECT_NEAR(shared->volume, 0.2, 1e-12);
  EXPECT_NEAR(shared->depth, 0.1, 1e-12);
  const auto beside = shared_by(ground, Solid{make_box({3.9, 1, 0}, {5, 2, 1})});
  ASSERT_TRUE(beside);
  EXPECT_NEAR(beside->volume, 0.1, 1e-12);
  EXPECT_NEAR(beside->depth, 0.1, 1e-3);
  // A wedge along y against the ground; the two make a third that is known.
  const Solid wedge = Prism{{{0, 0.5}, {4, 0.5}, {4, 1.5}}, 1, 0, 2};
  EXPECT_NEAR(shared_by(ground, wedge)->volume, 2 * (0.5 * 2 * 0.5 + 2 * 0.5), 1e-2);
  for (const auto& other :
       {make_box({0, 0, 1}, {4, 4, 2}), make_box({4, 0, 0}, {5, 4, 1}), make_box({0, 4, 0}, {4, 5, 1})})
    EXPECT_FALSE(shared_by(ground, Solid{other}));
}

}  // namespace
}  // namespace scarp
