#include "scarp/base/column.hpp"

#include <atomic>
#include <cstdint>

namespace scarp::detail {
namespace {

/// In front of a column: the memory that it is in.
using Header = void*;

/// Distance from the beginning of a page, another one each time.
std::size_t next_place() {
  constexpr std::size_t lines = page / cache_line, apart = 5;  // neighbours are fetched together
  static std::atomic<std::size_t> count{0};
  return count++ * apart % lines * cache_line;
}

}  // namespace

void* allocate_column(std::size_t bytes) {
  const bool large = bytes >= page;
  char* memory =
      static_cast<char*>(::operator new (cache_line + (large ? page : 0) + bytes, std::align_val_t{cache_line}));
  char* column = memory + cache_line;
  if (large) column += (page + next_place() - reinterpret_cast<std::uintptr_t>(column) % page) % page;
  reinterpret_cast<Header*>(column)[-1] = memory;
  return column;
}

void free_column(void* column) {
  ::operator delete (static_cast<Header*>(column)[-1], std::align_val_t{cache_line});
}

}  // namespace scarp::detail
