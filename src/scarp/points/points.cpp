#include "scarp/points/points.hpp"

#include <algorithm>
#include <cstddef>
#include <numeric>

namespace scarp {
namespace {

/// column[i] = column[order[i]]
struct Permute {
  const std::vector<int>& order;

  template <class Value>
  void operator()(std::vector<Value>& column) const {
    std::vector<Value> arranged(column.size());
    for (std::size_t i = 0; i < order.size(); ++i) arranged[i] = column[order[i]];
    column.swap(arranged);
  }
};

}  // namespace

template <int Dim>
void sort_by_element(std::vector<Block<Dim>>& blocks, int element_count, ActiveElements& active) {
  active.slot.assign(element_count, -1);
  for (const auto& block : blocks) {
    for (const int e : block.points.element) active.slot[e] = 0;
  }
  active.element.clear();
  for (int e = 0; e < element_count; ++e) {
    if (active.slot[e] < 0) continue;
    active.slot[e] = active.size();
    active.element.push_back(e);
  }
  for (auto& block : blocks) {
    auto& begin = block.begin;
    begin.assign(active.size() + 1, 0);
    for (const int e : block.points.element) ++begin[active.slot[e] + 1];
    std::partial_sum(begin.begin(), begin.end(), begin.begin());
    block.order.resize(block.size());
    std::vector<int> next(begin.begin(), begin.end() - 1);
    for (int i = 0; i < block.size(); ++i) block.order[next[active.slot[block.points.element[i]]]++] = i;
  }
}

template <int Dim>
void arrange_in_order(std::vector<Block<Dim>>& blocks) {
  for (auto& block : blocks) {
    if (std::is_sorted(block.order.begin(), block.order.end())) continue;
    for_each_column(block, Permute{block.order});
    std::iota(block.order.begin(), block.order.end(), 0);
  }
}

template <int Dim>
void remove_points(Block<Dim>& block, const std::vector<std::uint8_t>& gone) {
  std::vector<int> kept;
  for (int i = 0; i < block.size(); ++i) {
    if (!gone[i]) kept.push_back(i);
  }
  for_each_column(block, [&kept](auto& column) {
    for (std::size_t i = 0; i < kept.size(); ++i) column[i] = column[kept[i]];
    column.resize(kept.size());
  });
}

template void sort_by_element<2>(std::vector<Block<2>>&, int, ActiveElements&);
template void arrange_in_order<2>(std::vector<Block<2>>&);
template void remove_points<2>(Block<2>&, const std::vector<std::uint8_t>&);

}  // namespace scarp
