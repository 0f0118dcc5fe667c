// A run from where it stands to its end: one stage after the other, with its results and checkpoints.
#pragma once

#include <chrono>
#include <string>
#include <vector>

#include "scarp/input/case.hpp"
#include "scarp/run/checkpoint.hpp"
#include "scarp/run/checkpoint_writer.hpp"
#include "scarp/run/results.hpp"
#include "scarp/run/run.hpp"
#include "scarp/run/run_state.hpp"
#include "scarp/step/body.hpp"

namespace scarp::run {

/// The state of a run that has not begun.
template <int Dim>
RunState<Dim> new_state(const Body<Dim>& body);

template <int Dim>
class Runner {
 public:
  /// `files` are those that the case reads.
  Runner(const input::CaseOf<Dim>& input, const Options& options, int threads, Body<Dim>& body, RunState<Dim>& state,
         Results<Dim>& results, CheckpointHead head);

  /// Takes the run through its stages. SIGINT, SIGTERM and SIGHUP end it after the step under way, with everything
  /// written up to there and a checkpoint. Throws RunError for a computation that cannot go on: its last state is
  /// written first, as far as the disk takes it.
  Outcome go();

 private:
  void go_through_stages();
  void keep_when_due();
  void save(const std::string& name);
  void write_summary(const std::string& status, const std::string& message);
  void fail(const RunError& error);
  double wall_seconds() const;

  const input::CaseOf<Dim>& input_;
  const Options& options_;
  Body<Dim>& body_;
  RunState<Dim>& state_;
  Results<Dim>& results_;
  CheckpointHead head_;
  CheckpointWriter writer_;
  int threads_;
  double wall_before_;  ///< of the parts before this one [s]
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace scarp::run
