// The folder of a run's results: frames for ParaView, history.csv, summary.json. Reads the body, never changes it.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "scarp/input/case.hpp"
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

template <int Dim>
class Results {
 public:
  /// Prepares the folder: makes it, or clears an earlier result of scarp out of it. Throws InputError where the folder
  /// holds other things, or another run writes into it.
  Results(const input::CaseOf<Dim>& input, const std::string& folder, const Body<Dim>& body);
  ~Results();
  Results(const Results&) = delete;
  Results& operator=(const Results&) = delete;

  void frame(const Body<Dim>& body, double time);
  void history(int stage, int points, const Ledger<Dim>& ledger);
  void summary(const Body<Dim>& body, const Ledger<Dim>& ledger, const RunRecord& record);

 private:
  struct Writers;
  const input::CaseOf<Dim>& input_;
  std::string folder_;
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
