#include "scarp/points/points.hpp"

#include <algorithm>
#include <cstddef>
#include <numeric>

namespace scarp {
namespace {

/// Elements that hold points and are not active yet get the slot `taken` and go to active.fresh.
template <int Dim>
void find_fresh(const std::vector<Block<Dim>>& blocks, ActiveElements& active) {
  constexpr int taken = 0;
  active.fresh.clear();
  for (const auto& block : blocks) {
    for (const int e : block.points.element) {
      if (active.slot[e] >= 0) continue;
      active.slot.set(e, taken);
      active.fresh.push_back(e);
    }
  }
  std::sort(active.fresh.begin(), active.fresh.end());
}

/// Merges the fresh elements into the active ones, and takes out those that hold no point any more.
template <int Dim>
bool update_active(const std::vector<Block<Dim>>& blocks, ActiveElements& active) {
  constexpr int empty = -2;
  auto& list = active.element;
  for (const int e : list) active.slot.set(e, empty);
  for (const auto& block : blocks) {
    for (const int e : block.points.element) active.slot.set(e, 0);
  }
  const auto kept = std::remove_if(list.begin(), list.end(), [&](int e) {
    const bool gone = active.slot[e] == empty;
    if (gone) active.slot.set(e, -1);
    return gone;
  });
  const bool changed = kept != list.end() || !active.fresh.empty();
  list.erase(kept, list.end());
  // Merged from the back, in place.
  auto from = static_cast<std::ptrdiff_t>(list.size()) - 1,
       fresh = static_cast<std::ptrdiff_t>(active.fresh.size()) - 1;
  list.resize(list.size() + active.fresh.size());
  for (auto to = static_cast<std::ptrdiff_t>(list.size()) - 1; fresh >= 0; --to) {
    list[to] = from >= 0 && list[from] > active.fresh[fresh] ? list[from--] : active.fresh[fresh--];
  }
  for (int s = 0; s < active.size(); ++s) active.slot.set(list[s], s);
  return changed;
}

/// Counting sort of a block's points by the slots of their elements.
template <int Dim>
void sort_by_slot(Block<Dim>& block, const ActiveElements& active) {
  auto& begin = block.begin;
  begin.assign(static_cast<std::size_t>(active.size()) + 2, 0);
  for (const int e : block.points.element) ++begin[active.slot[e] + 2];
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  // begin[s + 1] is where slot s starts, and where it ends once its points are in.
  block.order.resize(block.size());
  for (int i = 0; i < block.size(); ++i) block.order[begin[active.slot[block.points.element[i]] + 1]++] = i;
}

}  // namespace

template <int Dim>
bool sort_by_element(std::vector<Block<Dim>>& blocks, int element_count, ActiveElements& active) {
  active.slot.resize(element_count);
  find_fresh(blocks, active);
  const bool changed = update_active(blocks, active);
  for (auto& block : blocks) sort_by_slot(block, active);
  return changed;
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

template bool sort_by_element<2>(std::vector<Block<2>>&, int, ActiveElements&);
template bool sort_by_element<3>(std::vector<Block<3>>&, int, ActiveElements&);
template void remove_points<2>(Block<2>&, const std::vector<std::uint8_t>&);
template void remove_points<3>(Block<3>&, const std::vector<std::uint8_t>&);

}  // namespace scarp
