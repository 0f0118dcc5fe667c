// Arrays of points in the order of their elements. Oracle: what belongs to a point follows from its id alone.
#include "scarp/exec/arrange.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

namespace scarp::exec {
namespace {

/// What the k-th column of a block holds of the point with this number.
double value_of(int column, int id) {
  return column * 1000.0 + id;
}

/// A block whose every column tells of the point and of itself, with points in any order of elements.
template <int Dim>
Block<Dim> shuffled_block(int size, std::mt19937& random) {
  Block<Dim> block("soil", LinearElastic({1e4, 0.3}));
  resize(block, size);
  block.state.resize(3, Column(static_cast<std::size_t>(size)));
  int k = 0;
  for_each_column(block, [&]<class Array>(Array& column) {
    for (int i = 0; i < size; ++i)
      column[i] = static_cast<typename Array::value_type>(value_of(sizeof(column[i]) == 1 ? 0 : k, i));
    ++k;
  });
  for (int i = 0; i < size; ++i) {
    block.points.id[i] = i;
    block.points.element[i] = static_cast<int>(random() % 40);
  }
  return block;
}

/// Every column holds at each place what its point had, and elements ascend.
template <int Dim>
void expect_in_order(const Block<Dim>& before, Block<Dim>& block) {
  EXPECT_TRUE(std::is_sorted(block.points.element.begin(), block.points.element.end()));
  std::vector<const void*> columns;
  auto old = before;
  for_each_column(old, [&](const auto& column) { columns.push_back(&column); });
  std::size_t k = 0;
  for_each_column(block, [&]<class Array>(const Array& column) {
    const auto& was = *static_cast<const Array*>(columns[k]);
    for (int i = 0; i < block.size(); ++i) ASSERT_EQ(column[i], was[block.points.id[i]]) << "column " << k;
    ++k;
  });
  EXPECT_GT(k, 20u);
  // Points of one element go by their ids.
  for (int i = 1; i < block.size(); ++i) {
    const bool same = block.points.element[i] == block.points.element[i - 1];
    EXPECT_TRUE(!same || block.points.id[i - 1] < block.points.id[i]);
  }
  for (int i = 0; i < block.size(); ++i) EXPECT_EQ(block.order[i], i);
}

template <int Dim, class Arrange>
void expect_arranged(Arrange&& arrange) {
  std::mt19937 random(6);
  std::vector<Block<Dim>> blocks;
  for (const int size : {300, 1, 7}) blocks.push_back(shuffled_block<Dim>(size, random));
  const auto before = blocks;
  ActiveElements active;
  sort_by_element<Dim>(
      blocks, 40, [](int e) { return static_cast<std::uint64_t>(e / 8); }, active);
  arrange(blocks);
  for (std::size_t b = 0; b < blocks.size(); ++b) expect_in_order(before[b], blocks[b]);
  // Once more changes nothing.
  const auto once = blocks;
  arrange(blocks);
  for (std::size_t b = 0; b < blocks.size(); ++b) EXPECT_EQ(blocks[b].points.id, once[b].points.id);
}

TEST(Arrange, TakesEveryColumnAlong) {
  expect_arranged<2>(arrange_in_order<2>);
  expect_arranged<3>(arrange_in_order<3>);
}

TEST(Arrange, InNewMemoryToo) {
  expect_arranged<2>(arrange_in_new_memory<2>);
  expect_arranged<3>(arrange_in_new_memory<3>);
}

}  // namespace
}  // namespace scarp::exec
