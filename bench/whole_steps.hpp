// Whole steps of a case, ready to be repeated.
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <ctime>
#include <functional>
#include <string>

#include "scarp/step/totals.hpp"

namespace scarp::bench {

struct Times {
  double seconds = 0, cpu_seconds = 0;  ///< on the clock, and of all threads
};

/// What some steps in a row took and did.
struct Repetition : Times {
  std::int64_t steps = 0, point_steps = 0, substeps = 0, changed_element = 0;
  std::array<double, phases> phase_seconds{};  ///< of each Phase, threads added up; zero unless asked for
};

/// A checkpoint: its copy, for which the run waits, and its way to the disk, for which it does not.
struct CheckpointTimes {
  Times copy, disk;
  double bytes = 0, state_bytes = 0;  ///< of the file, and of the arrays of the points
};

struct Prepared {
  int points = 0, elements = 0;  ///< elements that hold points
  Times start;                   ///< from the case to the first step
  std::function<Repetition(bool profile)> repeat;
  std::function<Times(const std::string& path)> write_frame;  ///< an output frame for ParaView
  std::function<CheckpointTimes(const std::string& path)> write_checkpoint;
};

/// Since it was made.
class Timer {
  using Clock = std::chrono::steady_clock;

 public:
  void read(Times& times) const {
    times.seconds = std::chrono::duration<double>(Clock::now() - start_).count();
    times.cpu_seconds = static_cast<double>(std::clock() - cpu_) / CLOCKS_PER_SEC;
  }

 private:
  std::clock_t cpu_ = std::clock();
  Clock::time_point start_ = Clock::now();
};

/// One of the cases of docs/benchmarks.md, with about so many points; "slope-cut-failing" has its own number. Steps of
/// the standard scheme, or of the report's where ":report" follows the name. Throws InputError for a name that is none.
Prepared prepare(const std::string& name, int points);

}  // namespace scarp::bench
