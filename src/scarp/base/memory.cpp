#include "scarp/base/memory.hpp"

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <limits>

namespace scarp {
namespace {

constexpr double unknown = std::numeric_limits<double>::max();

/// The number after a key, or the first of the file without one; unknown where there is none ("max").
double number_in(const char* path, const std::string& key) {
  std::ifstream file(path);
  std::string word;
  while (!key.empty() && file >> word && word != key) {
  }
  double number = 0;
  return file >> number ? number : unknown;
}

}  // namespace

FreeMemory free_memory() {
  double memory = unknown;
  const double available = number_in("/proc/meminfo", "MemAvailable:");  // kB
  if (available < unknown) memory = 1024 * available;
  const double group = number_in("/sys/fs/cgroup/memory.max", ""),
               used = number_in("/sys/fs/cgroup/memory.current", "");
  if (group < unknown && used < unknown) memory = std::min(memory, std::max(0.0, group - used));
  double addresses = unknown;
  rlimit limit{};
  const double pages = number_in("/proc/self/statm", "");
  if (getrlimit(RLIMIT_AS, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY) {
    const double taken = pages < unknown ? pages * static_cast<double>(sysconf(_SC_PAGESIZE)) : 0.0;
    addresses = std::max(0.0, static_cast<double>(limit.rlim_cur) - taken);
  }
  return {memory, addresses};
}

std::string as_bytes(double bytes) {
  constexpr std::array units{"bytes", "kB", "MB", "GB", "TB", "PB"};
  std::size_t unit = 0;
  while (bytes >= 1000 && unit + 1 < units.size()) {
    bytes /= 1000;
    ++unit;
  }
  if (!(bytes < 1e6)) return "more than 10^21 bytes";
  const double tens = bytes < 99.5 ? 1 : 10;  // two digits, and no exponent
  return bytes < 9.95 ? fmt::format("{:.2g} {}", bytes, units[unit])
                      : fmt::format("{:.0f} {}", tens * std::round(bytes / tens), units[unit]);
}

}  // namespace scarp
