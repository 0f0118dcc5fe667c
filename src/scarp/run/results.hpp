// The folder of a run's results: frames for ParaView, history.csv, summary.json. Reads the body, never changes it.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "scarp/input/case.hpp"
#include "scarp/run/archive.hpp"
#include "scarp/run/folder_lock.hpp"
#include "scarp/run/ledger.hpp"
#include "scarp/step/body.hpp"

namespace scarp::run {

/// One finished stage, for summary.json.
struct StageRecord {
  std::string name;
  double start = 0, end = 0;
  std::int64_t steps = 0;
  double unbalanced_ratio = 0, max_velocity = 0, max_displacement = 0;  ///< at its end
  double moved_mass = 0, moved_beyond = 0;  ///< of points that have moved more than this length [m]
  bool removal = false;
  std::string ended;  ///< "at rest", "duration", "interrupted" or "failed"

  /// f(Entry, member) for each that a checkpoint keeps (archive.hpp).
  template <class Self, class F>
  static void each_saved(Self& s, F&& f) {
    f(Entry{"name", "", "of the stage"}, s.name);
    f(Entry{"start", "s", "time of its start"}, s.start);
    f(Entry{"end", "s", "time of its end"}, s.end);
    f(Entry{"steps", "", "in the stage"}, s.steps);
    f(Entry{"unbalanced_ratio", "", "at its end"}, s.unbalanced_ratio);
    f(Entry{"max_velocity", "m/s", "at its end"}, s.max_velocity);
    f(Entry{"max_displacement", "m", "at its end"}, s.max_displacement);
    f(Entry{"moved_mass", "Mg", "of points that have moved more than moved_beyond"}, s.moved_mass);
    f(Entry{"moved_beyond", "m", "a hundredth of the body's height at the start of the stage"}, s.moved_beyond);
    f(Entry{"removal", "", "1 where soil is taken away in it"}, s.removal);
    f(Entry{"ended", "", "how it ended; \"failed\" before it has"}, s.ended);
  }
};

/// How a run stands, for summary.json.
struct RunRecord {
  std::string status;   ///< "running", "done", "failed", "interrupted"
  std::string message;  ///< of a failure
  double wall_seconds = 0;
  int threads = 1;
  double energy_error = 0, largest_energy_error = 0;  ///< see docs/output.md
  std::vector<StageRecord> stages;
};

/// How far the files of a run have come, so that another process can go on with them.
struct ResultsState {
  std::vector<double> frame_times;        ///< of the frames [s]
  double last_frame = -1, last_row = -1;  ///< times; what falls due at the end of a stage is written once
  std::int64_t history_bytes = 0;         ///< size of history.csv

  template <class Self, class F>
  static void each_saved(Self& r, F&& f) {
    f(Entry{"frame_times", "s", "of the frames written"}, r.frame_times);
    f(Entry{"last_frame", "s", "time of the last frame"}, r.last_frame);
    f(Entry{"last_row", "s", "time of the last row of history.csv"}, r.last_row);
    f(Entry{"history_bytes", "", "size of history.csv"}, r.history_bytes);
  }
};

/// What summary.json says of the run from its first moment on; empty where there is none.
struct Marker {
  std::string title, case_name;
};
Marker marker_in(const std::string& folder);

/// What is in the folder of a run's results before it begins.
enum class Before {
  nothing,  ///< no results: an earlier run's are refused
  replace,  ///< an earlier run's results are removed
};

template <int Dim>
class Results {
 public:
  /// Prepares the folder: makes it, or clears an earlier result of scarp out of it where that is to be replaced. Throws
  /// InputError where the folder holds other things, or another run writes into it. `case_name` is that of the case
  /// file that is run.
  Results(const input::CaseOf<Dim>& input, const std::string& folder, const Body<Dim>& body, Before before,
          const std::string& case_name);
  /// Goes on in a folder that is locked already, with the files as they were when `state` was kept: what was written
  /// after that is removed.
  Results(const input::CaseOf<Dim>& input, const std::string& folder, std::unique_ptr<FolderLock> lock,
          const ResultsState& state, const std::string& case_name);
  ~Results();
  Results(const Results&) = delete;
  Results& operator=(const Results&) = delete;

  const std::string& folder() const { return folder_; }
  /// The case as the folder keeps it.
  const std::string& case_text() const { return case_text_; }
  /// How far the files have come; those are on the disk after sync().
  ResultsState state() const;
  void sync() const;

  void frame(const Body<Dim>& body, double time);
  void history(int stage, int points, const Ledger<Dim>& ledger);
  void summary(const Body<Dim>& body, const Ledger<Dim>& ledger, const RunRecord& record);

 private:
  struct Writers;
  const input::CaseOf<Dim>& input_;
  std::string folder_, case_name_, case_text_;
  std::unique_ptr<FolderLock> lock_;  ///< held as long as there is something to write
  std::unique_ptr<Writers> writers_;
};

/// The largest displacement of a point [m].
template <int Dim>
double max_displacement(const Body<Dim>& body);

/// Mass of the points whose displacement is larger than `length` [m].
template <int Dim>
double mass_moved(const Body<Dim>& body, double length);

}  // namespace scarp::run
