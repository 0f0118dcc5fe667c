// Times at regular distances, at which something is due.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "scarp/run/archive.hpp"

namespace scarp::run {

class Clock {
 public:
  /// Due `every` seconds from `start` on; never where `every` is 0.
  Clock(double start, double every) : start_(start), every_(every), count_(1) {}
  double next() const { return every_ > 0 ? start_ + every_ * count_ : std::numeric_limits<double>::infinity(); }
  bool due(double time) {
    if (time < next() * (1 - 1e-12)) return false;
    // Straight to the first one after `time`: there may be any number of them in a step.
    count_ = std::max(count_ + 1, std::floor((time - start_) / every_));
    if (next() * (1 - 1e-12) <= time) ++count_;
    return true;
  }

  /// f(Entry, member) for each that a checkpoint keeps (archive.hpp).
  template <class Self, class F>
  static void each_saved(Self& c, F&& f) {
    f(Entry{"start", "s", "time that it counts from"}, c.start_);
    f(Entry{"count", "", "number of the next time that is due"}, c.count_);
  }

 private:
  double start_, every_, count_;
};

}  // namespace scarp::run
