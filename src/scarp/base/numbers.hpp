// A few whole numbers as a value.
#pragma once

#include <array>
#include <cstddef>
#include <span>

namespace scarp {

/// A range of ints that may be copied: up to Most of its own, or a list that outlives it.
template <int Most>
class Numbers {
 public:
  explicit Numbers(std::span<const int> list) : list_(list.data()), size_(list.size()) {}
  /// None yet; at most `Most` may be added.
  Numbers() = default;
  void add(int n) { own_[size_++] = n; }

  const int* begin() const { return list_ ? list_ : own_.data(); }
  const int* end() const { return begin() + size_; }
  int operator[](std::size_t i) const { return begin()[i]; }
  std::size_t size() const { return size_; }

 private:
  const int* list_ = nullptr;
  std::size_t size_ = 0;
  std::array<int, Most> own_;  // set up to size_ only
};

}  // namespace scarp
