// Arrays with one number for each of many things, that loops stream through.
#pragma once

#include <cstddef>
#include <new>
#include <vector>

namespace scarp {

/// Allocates from the beginning of a cache line on: a SIMD batch at a multiple of its size then lies in one line, not
/// across two.
template <class Value>
struct LineAllocator {
  using value_type = Value;
  static constexpr std::align_val_t line{64};

  LineAllocator() = default;
  template <class Other>
  LineAllocator(const LineAllocator<Other>&) {}

  Value* allocate(std::size_t count) { return static_cast<Value*>(::operator new(count * sizeof(Value), line)); }
  void deallocate(Value* values, std::size_t) { ::operator delete(values, line); }
  friend bool operator==(const LineAllocator&, const LineAllocator&) { return true; }
};

using Column = std::vector<double, LineAllocator<double>>;

}  // namespace scarp
