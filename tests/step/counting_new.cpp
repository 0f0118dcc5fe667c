// operator new that counts. In a file of its own: compilers that see it beside its use warn of a delete that frees.
#include "counting_new.hpp"

#include <atomic>
#include <cstdlib>
#include <new>

namespace {
std::atomic<long> count{0};
}

namespace scarp::test {
long allocations() {
  return count;
}
}  // namespace scarp::test

#if defined(__has_feature)
#if __has_feature(thread_sanitizer)
#define SCARP_COUNTS_NOTHING  // the sanitizer brings an operator new of its own
#endif
#endif

#if !defined(SCARP_COUNTS_NOTHING)
// Every other form of new ends in one of these two.
void* operator new(std::size_t size) {
  ++count;
  if (void* memory = std::malloc(size)) return memory;
  throw std::bad_alloc();
}
void* operator new(std::size_t size, std::align_val_t alignment) {
  ++count;
  const auto line = static_cast<std::size_t>(alignment);
  if (void* memory = std::aligned_alloc(line, (size + line - 1) / line * line)) return memory;
  throw std::bad_alloc();
}
void operator delete(void* memory) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::align_val_t) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
  std::free(memory);
}
#endif
