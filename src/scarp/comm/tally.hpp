// What all processes of a run find together.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "scarp/base/error.hpp"
#include "scarp/base/exact_sum.hpp"

namespace scarp::comm {

/// Numbers of this process that become those of all: sums over the processes, the least and the largest of theirs.
struct Tally {
  std::span<ExactSum> sums;
  std::span<double> least, most;
  std::span<std::int64_t> counts;
};

/// What went wrong at a point. The first of several is that of the lowest region, and there of the lowest id.
struct Failure {
  int region, id;
  RunError error;
};

}  // namespace scarp::comm
