// One stage of a case: from its first step to its end.
#pragma once

#include <functional>
#include <string>

#include "scarp/input/case.hpp"
#include "scarp/run/progress.hpp"
#include "scarp/run/results.hpp"
#include "scarp/run/run_state.hpp"
#include "scarp/step/body.hpp"

namespace scarp::run {

/// Everything that stages share.
template <int Dim>
struct Context {
  const input::CaseOf<Dim>& input;
  Body<Dim>& body;
  RunState<Dim>& state;
  Results<Dim>& results;
  Progress& progress;
  const std::function<bool()>& interrupted;
  const std::function<void()>&
      keep;              ///< called after each step, when what the next one needs is all in `body`, `state`
  bool profile = false;  ///< book the time of each phase of a step
};

/// Runs the stage that is under way in the state, to its end, or begins the next one, and keeps its record. Ends early
/// at rest, where the stage asks for it, or when interrupted: then it is still under way. Throws RunError where the
/// body does not come to rest but has to, where stress updates fail more often than allowed, where the books of energy
/// are far from closed, or where a step cannot be taken; the record tells how far it came.
template <int Dim>
void run_stage(Context<Dim>& context);

}  // namespace scarp::run
