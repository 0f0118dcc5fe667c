// What a run is doing, besides its body: all that the next step and the results depend on.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "scarp/input/case.hpp"
#include "scarp/run/archive.hpp"
#include "scarp/run/clock.hpp"
#include "scarp/run/energy_check.hpp"
#include "scarp/run/ledger.hpp"
#include "scarp/run/removal.hpp"
#include "scarp/run/rest_watch.hpp"
#include "scarp/run/results.hpp"
#include "scarp/step/body.hpp"

namespace scarp::run {

/// How a stage that is under way stands.
template <int Dim>
struct StageState {
  /// At the start of stage number `index`, which is now.
  StageState(const input::CaseOf<Dim>& input, int index, const Ledger<Dim>& ledger, const Body<Dim>& body);

  Clock frames, rows;  ///< when a frame and a row of history.csv are due
  std::optional<Removal<Dim>> removal;
  std::optional<RestWatch<Dim>> rest;
  double critical = 0;       ///< critical time step [s]
  bool first = true;         ///< is its first step still to come?
  bool resting = false;      ///< did the last step find the body at rest?
  bool energy_said = false;  ///< has it been said that the books do not close?
  bool held = false;         ///< is the imbalance at its start known?

  template <class Self, class F>
  static void each_saved(Self& s, F&& f) {
    f(Entry{"critical", "s", "critical time step"}, s.critical);
    f(Entry{"first", "", "1 before its first step"}, s.first);
    f(Entry{"resting", "", "1 where the last step found the body at rest"}, s.resting);
    f(Entry{"energy_said", "", "1 where it was said that the books of energy do not close"}, s.energy_said);
    f(Entry{"held", "", "1 where the imbalance at its start is known"}, s.held);
    Clock::each_saved(s.frames, f.within("frames"));
    Clock::each_saved(s.rows, f.within("rows"));
    if (s.removal) Removal<Dim>::each_saved(*s.removal, f.within("removal"));
    if (s.rest) RestWatch<Dim>::each_saved(*s.rest, f.within("rest"));
  }
};

template <int Dim>
struct RunState {
  Ledger<Dim> ledger;
  EnergyCheck energy;
  std::vector<StageRecord> stages;       ///< those begun
  bool cut = false;                      ///< has soil been cut away?
  std::optional<StageState<Dim>> stage;  ///< that under way, the last of `stages`; none between stages
  ResultsState results;
  double wall_seconds = 0;  ///< since the start of the run, without the time between its parts
  std::vector<std::string> warnings;

  /// Number of the stage that is under way, or comes next.
  int stage_index() const { return static_cast<int>(stages.size()) - (stage ? 1 : 0); }
};

template <int Dim>
void save_run(const Saver& save, const RunState<Dim>& state);

/// Into the state of a run that has just begun. Throws InputError for a file that does not fit the case.
template <int Dim>
void load_run(const Loader& load, const input::CaseOf<Dim>& input, const Body<Dim>& body, RunState<Dim>& state);

}  // namespace scarp::run
