// Running a case: stages, time loop, progress, output times. No equations.
#pragma once

#include <string>

#include "scarp/input/case.hpp"

namespace scarp::run {

enum class Outcome { done, interrupted };

struct Options {
  std::string out;             ///< folder of the results, made if it is not there
  int threads = 0;             ///< 0: as many as the system gives
  bool quiet = false;          ///< no progress
  bool profile = false;        ///< print at the end how the time was spent
  bool overwrite = false;      ///< an earlier run's results in the folder are replaced
  bool edited = false;         ///< a checkpoint may have been changed by other programs
  std::string case_name = {};  ///< of the case file, for the record; "": as the case has it
  std::string command = {};    ///< how the program was called, for the record
};

/// Runs the case and writes points.pvd with its frames, mesh.vtu, history.csv, summary.json, checkpoints, the record of
/// the run and a copy of the case into the folder. An earlier result in the folder is replaced once the case has been
/// found good, where that is asked for, or refused; files of other origin with the same names are refused. SIGINT,
/// SIGTERM and SIGHUP end the run after the step under way, with everything written up to there. Throws InputError for
/// a bad case and RunError for a computation that cannot go on (its last state is written first).
Outcome run_case(const input::AnyCase& input, const Options& options);

/// Goes on with the run whose results are in the folder `options.out`, from its latest checkpoint, as if it had never
/// stopped: the results are the same to the last bit, but for times of the wall clock and numbers of threads. Where the
/// run was stopped before its first checkpoint it starts again. Throws InputError where there is no run, where its case
/// or a file that it reads has changed, or where another process is at it; else as run_case() does.
Outcome resume_case(const Options& options);

/// Builds mesh, points and initial state, and describes them: what `scarp check` prints.
std::string check_case(const input::AnyCase& input);

}  // namespace scarp::run
