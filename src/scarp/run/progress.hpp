// What the user sees while a run goes on: one line that renews itself on a terminal, plain lines elsewhere.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

namespace scarp::run {

class Progress {
 public:
  explicit Progress(bool quiet);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// A stage begins; `latest_end` is when the run ends if no stage ends before its duration [s].
  void stage(const std::string& name, int index, int count, double latest_end);
  /// It ends; `text` says how.
  void stage_ended(const std::string& text);
  /// Shows the state now and then, and notes it once a minute in the log of the run: `time` [s], work done so far as
  /// points × steps, `velocity` the largest [m/s].
  void show(double time, std::int64_t point_steps, double unbalanced, double velocity);
  /// Ends the renewed line, so that other text can follow.
  void clear();

 private:
  using Clock = std::chrono::steady_clock;
  double latest_end_ = 0;
  bool quiet_, terminal_, open_ = false;
  std::string stage_;
  Clock::time_point start_, shown_, noted_;  ///< when it began, was last shown, and last written to the log
};

/// Seconds as "42 s", "3 min 10 s", "2 h 05 min".
std::string duration_text(double seconds);

}  // namespace scarp::run
