// A few points at once, one in each lane of a SIMD batch.
#pragma once

#include <cstdint>
#include <vector>

#include "scarp/tensor/batch.hpp"

namespace scarp {

/// Points order[0] ... order[count - 1] of a block.
struct PointRange {
  const int* order;
  int count;
};

/// The points order[0] ... order[count - 1] in the lanes of a batch T, count ≤ its size. Where they lie beside each
/// other in the arrays (sorted points do, all but a few) their values are loaded as one; otherwise one by one. Lanes
/// without a point are zero, so that they have no mass and no volume.
template <class T>
class Lanes {
 public:
  static constexpr int W = lanes_of<T>;

  Lanes(const int* order, int count) : order_(order), count_(count) {
    for (int l = 1; l < count; ++l) side_by_side_ = side_by_side_ && order[l] == order[0] + l;
  }

  int count() const { return count_; }
  int point(int lane) const { return order_[lane]; }

  T load(const std::vector<double>& column) const {
    if (side_by_side_) [[likely]] {
      const double* first = column.data() + order_[0];
      return count_ == W ? T::load_unaligned(first) : load_first<T>(first, count_);
    }
    double lanes[W] = {};
    for (int l = 0; l < count_; ++l) lanes[l] = column[order_[l]];
    return T::load_unaligned(lanes);
  }

  void store(const T& value, std::vector<double>& column) const {
    if (side_by_side_ && count_ == W) [[likely]] {
      value.store_unaligned(column.data() + order_[0]);
      return;
    }
    double lanes[W];
    value.store_unaligned(lanes);
    for (int l = 0; l < count_; ++l) column[order_[l]] = lanes[l];
  }

  void store(std::uint8_t value, std::vector<std::uint8_t>& column) const {
    for (int l = 0; l < count_; ++l) column[order_[l]] = value;
  }

 private:
  const int* order_;
  int count_;
  bool side_by_side_ = true;
};

/// f(lanes, first) for the points of a range, a batch at a time; `first` is the place of its first point in the range.
template <class T, class F>
inline void for_each_batch(const PointRange& range, F&& f) {
  for (int k = 0; k < range.count; k += lanes_of<T>) {
    f(Lanes<T>(range.order + k, range.count - k < lanes_of<T> ? range.count - k : lanes_of<T>), k);
  }
}

}  // namespace scarp
