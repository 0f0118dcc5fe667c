// Arrays with one number for each of many things, that loops stream through.
#pragma once

#include <cstddef>
#include <new>
#include <utility>
#include <vector>

namespace scarp {

namespace detail {
inline constexpr std::size_t cache_line = 64, page = 4096;
/// Memory that begins at a cache line, and each time at another one of a page.
void* allocate_column(std::size_t bytes);
void free_column(void* column);
}  // namespace detail

/// resize(n) leaves new entries as they are, for memory goes to the thread that writes there first; resize(n, 0.0) sets
/// them.
/// A SIMD batch at a multiple of its size lies in one cache line, not across two. Equal places of several arrays are at
/// different places of a page: large blocks of memory all begin at a page, and a cache keeps only a few lines (twelve,
/// say) from the same place of pages, fewer than a point has columns.
template <class Value>
struct ColumnAllocator {
  using value_type = Value;

  ColumnAllocator() = default;
  template <class Other>
  ColumnAllocator(const ColumnAllocator<Other>&) {}

  Value* allocate(std::size_t count) { return static_cast<Value*>(detail::allocate_column(count * sizeof(Value))); }
  void deallocate(Value* values, std::size_t) { detail::free_column(values); }
  template <class Other>
  void construct(Other* at) {
    ::new (static_cast<void*>(at)) Other;
  }
  template <class Other, class... From>
  void construct(Other* at, From&&... from) {
    ::new (static_cast<void*>(at)) Other(std::forward<From>(from)...);
  }
  friend bool operator==(const ColumnAllocator&, const ColumnAllocator&) { return true; }
};

using Column = std::vector<double, ColumnAllocator<double>>;

}  // namespace scarp
