// Taking soil away: the cut of a stage, at once or in lifts from the top down.
#pragma once

#include "scarp/input/case.hpp"
#include "scarp/run/ledger.hpp"
#include "scarp/step/body.hpp"

namespace scarp::run {

/// The lifts of one removal within a stage that starts at `start` [s].
template <int Dim>
class Removal {
 public:
  Removal(const input::RemovalInputOf<Dim>& input, double start);

  bool finished() const { return done_ == input_.lifts; }
  /// Can so many lifts be done? A checkpoint may say anything.
  bool possible() const { return done_ >= 0 && done_ <= input_.lifts; }
  /// When the next lift is due.
  double next_time() const;
  /// f(Entry, member) for each that a checkpoint keeps (archive.hpp).
  template <class Self, class F>
  static void each_saved(Self& r, F&& f) {
    f(Entry{"start", "s", "time at which the stage began"}, r.start_);
    f(Entry{"done", "", "lifts that have been taken away"}, r.done_);
  }

  /// Takes out the points of all lifts that are due at `time`; mass and kinetic energy go to the ledger. Throws
  /// RunError when no point is left in the body.
  void take_due(double time, Body<Dim>& body, Ledger<Dim>& ledger);

 private:
  const input::RemovalInputOf<Dim>& input_;
  double start_;
  int done_ = 0;
  BoxOf<Dim> box_;
};

}  // namespace scarp::run
