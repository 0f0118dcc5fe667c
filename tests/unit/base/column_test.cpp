#include "scarp/base/column.hpp"

#include <gtest/gtest.h>

#include <cstdint>
#include <set>

namespace scarp {
namespace {

std::uintptr_t address(const Column& column) {
  return reinterpret_cast<std::uintptr_t>(column.data());
}

TEST(Column, BeginsAtACacheLine) {
  for (const std::size_t size : {1, 7, 100, 1000, 100000}) {
    EXPECT_EQ(address(Column(size, 1.0)) % 64, 0u) << size;
  }
}

// A point has two dozen columns, and a cache keeps a dozen lines from one place of all pages.
TEST(Column, LargeOnesBeginAtDifferentLinesOfAPage) {
  const std::vector<Column> columns(64, Column(10000, 1.0));
  std::set<std::uintptr_t> places;
  for (const auto& column : columns) places.insert(address(column) % 4096);
  EXPECT_EQ(places.size(), 64u);
}

TEST(Column, KeepsItsEntriesWhenItGrowsIsCopiedOrMoved) {
  Column column;
  for (int i = 0; i < 3000; ++i) column.push_back(i);
  const Column copy = column, moved = std::move(column);
  ASSERT_EQ(moved.size(), 3000u);
  for (int i = 0; i < 3000; ++i) ASSERT_EQ(moved[i], i);
  EXPECT_EQ(copy, moved);
}

TEST(Column, GivesNewEntriesTheValueThatResizeHas) {
  Column column(10, 2.0);
  column.resize(20000, 3.0);
  EXPECT_EQ(column[9], 2.0);
  EXPECT_EQ(column[10], 3.0);
  EXPECT_EQ(column.back(), 3.0);
}

}  // namespace
}  // namespace scarp
