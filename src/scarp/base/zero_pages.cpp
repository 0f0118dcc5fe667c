#include "scarp/base/zero_pages.hpp"

#include <sys/mman.h>

namespace scarp::detail {

void* map_zero_pages(std::size_t bytes) {
  if (bytes == 0) return nullptr;
  void* const pages = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
  if (pages == MAP_FAILED) throw std::bad_alloc();
  return pages;
}

void unmap_pages(void* pages, std::size_t bytes) {
  if (pages) munmap(pages, bytes);
}

}  // namespace scarp::detail
