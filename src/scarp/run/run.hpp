// Running a case: stages, time loop, progress, output times. No equations.
#pragma once

#include <string>

#include "scarp/input/case.hpp"

namespace scarp::run {

enum class Outcome { done, interrupted };

struct Options {
  std::string out;       ///< folder of the results, made if it is not there
  int threads = 0;       ///< 0: as many as the system gives
  bool quiet = false;    ///< no progress
  bool profile = false;  ///< print at the end how the time was spent
};

/// Runs the case and writes points.pvd with its frames, mesh.vtu, history.csv, summary.json and a copy of the case into
/// the folder. An earlier result in the folder is replaced once the case has been found good; files of
/// other origin with the same names are refused. SIGINT and SIGTERM end the run after the step under way, with
/// everything written up to there. Throws InputError for a bad case and RunError for a computation that cannot go on
/// (its last state is written first).
Outcome run_case(const input::AnyCase& input, const Options& options);

/// Builds mesh, points and initial state, and describes them: what `scarp check` prints.
std::string check_case(const input::AnyCase& input);

}  // namespace scarp::run
