#include "scarp/points/points.hpp"

#include <algorithm>
#include <cstddef>
#include <numeric>

namespace scarp {
namespace {

/// What `slot` says of an element that is not active.
constexpr int empty = -1, found = -2;

/// Counts the points of each slot into begin[slot + 1] of every block, and finds the fresh elements. Returns whether
/// the active elements are what they were: those hold points, and no others do.
template <int Dim>
bool count_points(std::vector<Block<Dim>>& blocks, const ChunkOfElement& chunk_of, ActiveElements& active) {
  for (auto& block : blocks) {
    block.begin.assign(static_cast<std::size_t>(active.size()) + 1, 0);
    int* count = block.begin.data() + 1;
    for (const int e : block.points.element) {
      const int slot = active.slot[e];
      if (slot >= 0) [[likely]] {
        ++count[slot];
      } else if (slot == empty) {
        active.slot.set(e, found);
        active.fresh.push_back({chunk_of(e), e});
      }
    }
  }
  bool same = active.fresh.empty();
  for (int s = 0; s < active.size() && same; ++s)
    same = std::any_of(blocks.begin(), blocks.end(), [s](const auto& block) { return block.begin[s + 1] > 0; });
  return same;
}

/// Takes those out of the active elements that hold no point any more, and merges the fresh ones in.
template <int Dim>
void update_active(const std::vector<Block<Dim>>& blocks, ActiveElements& active) {
  auto& [element, chunk, slot, fresh, emptied, end] = active;
  std::size_t kept = 0;
  for (std::size_t s = 0; s < element.size(); ++s) {
    if (std::any_of(blocks.begin(), blocks.end(), [s](const auto& block) { return block.begin[s + 1] > 0; })) {
      element[kept] = element[s];
      chunk[kept++] = chunk[s];
    } else {
      slot.set(element[s], empty);
      emptied.push_back(element[s]);
    }
  }
  std::sort(fresh.begin(), fresh.end());
  element.resize(kept + fresh.size());
  chunk.resize(element.size());
  // From the back, in place.
  std::size_t from = kept, left = fresh.size();
  for (std::size_t to = element.size(); left > 0; --to) {
    const bool old = from > 0 && ActiveElements::Place{chunk[from - 1], element[from - 1]} > fresh[left - 1];
    element[to - 1] = old ? element[from - 1] : fresh[left - 1].element;
    chunk[to - 1] = old ? chunk[from - 1] : fresh[left - 1].chunk;
    --(old ? from : left);
  }
  for (int s = 0; s < active.size(); ++s) slot.set(element[s], s);
}

/// Counting sort of a block's points by the slots of their elements, once begin[slot + 1] are the numbers of these. A
/// point whose id is lower than that of one before it in its element goes before that: few do, for arrays are in order
/// but for the points that changed element since.
template <int Dim>
void sort_by_slot(Block<Dim>& block, ActiveElements& active) {
  auto& begin = block.begin;
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  active.end.assign(begin.begin(), begin.end() - 1);
  block.order.resize(static_cast<std::size_t>(block.size()));
  int *order = block.order.data(), *end = active.end.data();
  const int *element = block.points.element.data(), *id = block.points.id.data();
  for (int i = 0; i < block.size(); ++i) {
    const int slot = active.slot[element[i]], first = begin[slot];
    int at = end[slot]++;
    // One question whose answer is no for nearly all: whether a point is the first of its element is none to guess.
    const int last = order[std::max(at - 1, 0)], before = at > first ? last : i;
    if (id[before] > id[i]) [[unlikely]] {
      for (; at > first && id[order[at - 1]] > id[i]; --at) order[at] = order[at - 1];
    }
    order[at] = i;
  }
}

}  // namespace

void ActiveElements::reserve(std::size_t elements) {
  element.reserve(elements);
  chunk.reserve(elements);
  fresh.reserve(elements);
  emptied.reserve(elements);
  end.reserve(elements);
}

template <int Dim>
bool sort_by_element(std::vector<Block<Dim>>& blocks, int element_count, const ChunkOfElement& chunk_of,
                     ActiveElements& active) {
  active.slot.resize(static_cast<std::size_t>(element_count));
  active.fresh.clear();
  active.emptied.clear();
  const bool same = count_points(blocks, chunk_of, active);
  if (!same) {
    update_active(blocks, active);
    count_points(blocks, chunk_of, active);
  }
  for (auto& block : blocks) sort_by_slot(block, active);
  return !same;
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

template bool sort_by_element<2>(std::vector<Block<2>>&, int, const ChunkOfElement&, ActiveElements&);
template bool sort_by_element<3>(std::vector<Block<3>>&, int, const ChunkOfElement&, ActiveElements&);
template void remove_points<2>(Block<2>&, const std::vector<std::uint8_t>&);
template void remove_points<3>(Block<3>&, const std::vector<std::uint8_t>&);

}  // namespace scarp
