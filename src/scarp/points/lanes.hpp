// A few points at once, one in each lane of a SIMD batch.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <vector>

#include "scarp/base/column.hpp"
#include "scarp/tensor/batch.hpp"

namespace scarp {

/// Points order[0] ... order[count - 1] of a block.
struct PointRange {
  const int* order;
  int count;
};

/// Do the points of a range lie beside each other in the arrays?
[[gnu::always_inline]] inline bool lie_beside(const int* order, int count) {
  int off = 0;
  for (int l = 1; l < count; ++l) off |= order[l] - order[0] - l;
  return off == 0;
}

/// The points order[0] ... order[count - 1] in the lanes of a batch T, count ≤ its size. Where they lie beside each
/// other in the arrays (sorted points do, all but a few) their values are loaded at once; otherwise one by one. Lanes
/// without a point are zero, so that they have no mass and no volume.
template <class T>
class Lanes {
 public:
  static constexpr int W = lanes_of<T>;

  Lanes(const int* order, int count) : order_(order), count_(count), beside_(lie_beside(order, count)) {}

  int count() const { return count_; }
  int point(int lane) const { return order_[lane]; }
  /// Do they fill the lanes, beside each other?
  bool whole() const { return beside_ && count_ == W; }

  [[gnu::always_inline]] T load(const Column& column) const {
    if (!beside_) [[unlikely]]
      return load_one_by_one(column);
    const double* from = column.data() + order_[0];
    return count_ == W ? T::load_unaligned(from) : load_first<T>(from, count_);
  }

  [[gnu::always_inline]] void store(const T& value, Column& column) const {
    if (!beside_) [[unlikely]] {
      store_one_by_one(value, column);
      return;
    }
    double* to = column.data() + order_[0];
    if (count_ == W) {
      value.store_unaligned(to);
    } else {
      store_first(value, to, count_);
    }
  }

  void store(std::uint8_t value, std::vector<std::uint8_t>& column) const {
    if (beside_) [[likely]] {
      std::memset(column.data() + order_[0], value, static_cast<std::size_t>(count_));
    } else {
      for (int l = 0; l < count_; ++l) column[order_[l]] = value;
    }
  }

 private:
  [[gnu::noinline]] T load_one_by_one(const Column& column) const {
    double lanes[W] = {};
    for (int l = 0; l < count_; ++l) lanes[l] = column[order_[l]];
    return T::load_unaligned(lanes);
  }
  [[gnu::noinline]] void store_one_by_one(const T& value, Column& column) const {
    double lanes[W];
    value.store_unaligned(lanes);
    for (int l = 0; l < count_; ++l) column[order_[l]] = lanes[l];
  }

  const int* order_;
  int count_;
  bool beside_;
};

/// The points first ... first + W − 1 in the lanes of a batch: Lanes that need no questions asked.
template <class T>
class WholeLanes {
 public:
  static constexpr int W = lanes_of<T>;

  explicit WholeLanes(int first) : first_(static_cast<std::size_t>(first)) {}

  static constexpr int count() { return W; }
  int point(int lane) const { return static_cast<int>(first_) + lane; }
  T load(const Column& column) const { return T::load_unaligned(column.data() + first_); }
  void store(const T& value, Column& column) const { value.store_unaligned(column.data() + first_); }
  void store(std::uint8_t value, std::vector<std::uint8_t>& column) const {
    std::memset(column.data() + first_, value, W);
  }

 private:
  std::size_t first_;
};

/// f(lanes, first) for the points of a range, a batch at a time; `first` is the place of its first point in the range.
template <class T, class F>
inline void for_each_batch(const PointRange& range, F&& f) {
  for (int k = 0; k < range.count; k += lanes_of<T>) {
    f(Lanes<T>(range.order + k, range.count - k < lanes_of<T> ? range.count - k : lanes_of<T>), k);
  }
}

/// The same for the points of one element, which lie beside each other as a rule; f is called with Lanes or WholeLanes.
/// Asked for each batch: a loop over all points of an element, of which there are now more and now fewer, would cost a
/// wrong guess of the processor in many elements.
template <class T, class F>
inline void for_each_batch_of_element(const PointRange& range, F&& f) {
  constexpr int W = lanes_of<T>;
  int k = 0;
  for (; k + W <= range.count && lie_beside(range.order + k, W); k += W) f(WholeLanes<T>(range.order[k]), k);
  for (; k < range.count; k += W) f(Lanes<T>(range.order + k, range.count - k < W ? range.count - k : W), k);
}

}  // namespace scarp
