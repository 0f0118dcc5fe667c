// The arrays of the points are declared once.
#include "scarp/points/points.hpp"

#include <gtest/gtest.h>

#include <numeric>
#include <set>

namespace scarp {
namespace {

template <int Dim>
std::size_t declared_bytes() {
  std::size_t bytes = 0;
  Points<Dim> points;
  Points<Dim>::each(points, [&](const PointArray&, const auto& member) { bytes += sizeof(member); });
  return bytes;
}

TEST(Points, EachArrayIsDeclared) {
  // A member that each() forgets would not be ordered, removed or saved with the others.
  EXPECT_EQ(declared_bytes<2>(), sizeof(Points<2>));
  EXPECT_EQ(declared_bytes<3>(), sizeof(Points<3>));
}

TEST(Points, KeysAreUnique) {
  std::set<std::string> keys;
  int arrays = 0;
  Points<3> points;
  Points<3>::each(points, [&](const PointArray& info, const auto&) {
    keys.insert(info.key);
    ++arrays;
    EXPECT_STRNE(info.meaning, "") << info.key;
  });
  EXPECT_EQ(static_cast<int>(keys.size()), arrays);
}

TEST(Points, KindsHaveTheirComponents) {
  Points<3> points;
  Points<3>::each(points, []<class Member>(const PointArray& info, const Member&) {
    std::size_t components = 1;
    if constexpr (requires { std::tuple_size<Member>::value; }) components = std::tuple_size_v<Member>;
    const std::size_t expected = info.kind == PointKind::number   ? 1
                                 : info.kind == PointKind::vector ? 3
                                 : info.kind == PointKind::tensor ? 6
                                                                  : 9;
    EXPECT_EQ(components, expected) << info.key;
  });
}

TEST(Points, EachArrayFollowsItsPoint) {
  // Every number of point i is i, whatever the array: so it is after two points have gone.
  Block<3> block("soil", LinearElastic({1e4, 0.3}));
  for (auto* group : {&block.points.sigma_ahead}) {
    for (auto& column : *group) column.resize(1);
  }
  for (auto& column : block.points.C) column.resize(1);
  for (auto& column : block.points.xi) column.resize(1);
  resize(block, 5);
  for_each_column(block, [](auto& column) { std::iota(column.begin(), column.end(), 0); });
  remove_points(block, {0, 1, 0, 1, 0});
  int arrays = 0;
  for_each_column(block, [&]<class Array>(const Array& column) {
    ++arrays;
    ASSERT_EQ(column.size(), 3u);
    for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(column[i], static_cast<typename Array::value_type>(2 * i));
  });
  EXPECT_EQ(arrays, 4 + 3 * 3 + 3 + 6 + 6 + 9 + 4);
}

}  // namespace
}  // namespace scarp
