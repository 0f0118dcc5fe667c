// Whole steps of a case, ready to be repeated.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>

#include "scarp/step/books.hpp"

namespace scarp::bench {

/// What some steps in a row took and did.
struct Repetition {
  double seconds = 0, cpu_seconds = 0;  ///< on the clock, and of all threads
  std::int64_t steps = 0, point_steps = 0, substeps = 0, changed_element = 0;
  std::array<double, phases> phase_seconds{};  ///< of each Phase, threads added up; zero unless asked for
};

struct Prepared {
  int points = 0, elements = 0;  ///< elements that hold points
  std::function<Repetition(bool profile)> repeat;
};

/// One of the cases of docs/benchmarks.md, with about so many points; "slope-cut-failing" has its own number. Throws
/// InputError for a name that is none.
Prepared prepare(const std::string& name, int points);

}  // namespace scarp::bench
