// Arrays with an entry for each of very many things of which few are ever used: what is not touched costs address
// space, no memory.
#pragma once

#include <cstddef>
#include <new>
#include <utility>
#include <vector>

namespace scarp {

namespace detail {
/// Whole pages from the system, zero in every byte. Throws std::bad_alloc.
void* map_zero_pages(std::size_t bytes);
void unmap_pages(void* pages, std::size_t bytes);
}  // namespace detail

template <class Value>
struct ZeroPagesAllocator {
  using value_type = Value;

  ZeroPagesAllocator() = default;
  template <class Other>
  ZeroPagesAllocator(const ZeroPagesAllocator<Other>&) {}

  Value* allocate(std::size_t count) { return static_cast<Value*>(detail::map_zero_pages(count * sizeof(Value))); }
  void deallocate(Value* values, std::size_t count) { detail::unmap_pages(values, count * sizeof(Value)); }
  /// A new entry is the zero bytes that are there.
  template <class Other>
  void construct(Other*) {}
  template <class Other, class... From>
  void construct(Other* at, From&&... from) {
    ::new (static_cast<void*>(at)) Other(std::forward<From>(from)...);
  }
  friend bool operator==(const ZeroPagesAllocator&, const ZeroPagesAllocator&) { return true; }
};

/// For values that zero bytes stand for; to be sized once: what a shorter vector leaves behind is not zero.
template <class Value>
using ZeroPages = std::vector<Value, ZeroPagesAllocator<Value>>;

/// A whole number of each of very many things, -1 where none was set; to be sized once. What costs memory are those
/// that were set, and their neighbours.
template <class Int>
class MostlyNone {
 public:
  MostlyNone() = default;
  explicit MostlyNone(std::size_t count) : next_(count) {}
  void resize(std::size_t count) { next_.resize(count); }
  bool empty() const { return next_.empty(); }
  std::size_t size() const { return next_.size(); }

  int operator[](std::size_t i) const { return next_[i] - 1; }
  void set(std::size_t i, int value) { next_[i] = static_cast<Int>(value + 1); }

 private:
  ZeroPages<Int> next_;  ///< one more
};

}  // namespace scarp
