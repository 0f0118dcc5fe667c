#include "scarp/run/run_state.hpp"

#include <fmt/format.h>

#include "scarp/base/error.hpp"

namespace scarp::run {

template <int Dim>
StageState<Dim>::StageState(const input::CaseOf<Dim>& input, int index, const Ledger<Dim>& ledger,
                            const Body<Dim>& body)
    : frames(ledger.time, input.output.every), rows(ledger.time, input.output.history) {
  const auto& stage = input.stages[static_cast<std::size_t>(index)];
  if (stage.remove) removal.emplace(*stage.remove, ledger.time);
  if (stage.rest) rest.emplace(*stage.rest, body);
}

namespace {

/// f(group, members) for all parts of a state but lists.
template <class Self, class F>
void each_part(Self& state, const F& f) {
  using L = std::decay_t<decltype(state.ledger)>;
  const auto ledger = f.within("ledger");
  L::each_saved(state.ledger, ledger);
  std::decay_t<decltype(state.ledger.last)>::template each_saved<Entry>(state.ledger.last, ledger.within("last"));
  SearchCounts::each_saved<Entry>(state.ledger.search, ledger.within("search"));
  EnergyCheck::each_saved(state.energy, f.within("energy_check"));
  ResultsState::each_saved(state.results, f.within("results"));
  f(Entry{"cut", "", "1 after soil was first cut away"}, state.cut);
  f(Entry{"wall_seconds", "s", "that the run has taken"}, state.wall_seconds);
}

std::string of_stage(std::size_t i) {
  return fmt::format("stages/{}", i);
}
std::string of_warning(std::size_t i) {
  return fmt::format("warnings/{}", i);
}
constexpr Entry of_text{"text", "", "of a warning that was given"};

}  // namespace

template <int Dim>
void save_run(const Saver& save, const RunState<Dim>& state) {
  each_part(state, save);
  for (std::size_t i = 0; i < state.stages.size(); ++i)
    StageRecord::each_saved(state.stages[i], save.within(of_stage(i)));
  if (state.stage) StageState<Dim>::each_saved(*state.stage, save.within("stage_under_way"));
  for (std::size_t i = 0; i < state.warnings.size(); ++i) save.within(of_warning(i))(of_text, state.warnings[i]);
}

template <int Dim>
void load_run(const Loader& load, const input::CaseOf<Dim>& input, const Body<Dim>& body, RunState<Dim>& state) {
  each_part(state, load);
  for (std::size_t i = 0; load.within(of_stage(i)).has("name"); ++i) {
    auto& record = state.stages.emplace_back();
    StageRecord::each_saved(record, load.within(of_stage(i)));
    if (i >= input.stages.size() || input.stages[i].name != record.name) {
      throw InputError("this file has a stage that the case does not have",
                       fmt::format("stage \"{}\" in {}", record.name, load.file_name()),
                       "go on with the case as it was run");
    }
  }
  const auto under_way = load.within("stage_under_way");
  if (!state.stages.empty() && under_way.has("critical")) {
    state.stage.emplace(input, static_cast<int>(state.stages.size()) - 1, state.ledger, body);
    StageState<Dim>::each_saved(*state.stage, under_way);
    if (const auto& removal = state.stage->removal; removal && !removal->possible()) {
      throw InputError("this file's number of lifts that are taken away (stage_under_way/removal/done) cannot be",
                       load.file_name(), "it is 0 to the lifts of the stage");
    }
  }
  for (std::size_t i = 0; load.within(of_warning(i)).has("text"); ++i)
    load.within(of_warning(i))(of_text, state.warnings.emplace_back());
}

template struct StageState<2>;
template struct StageState<3>;
template void save_run<2>(const Saver&, const RunState<2>&);
template void save_run<3>(const Saver&, const RunState<3>&);
template void load_run<2>(const Loader&, const input::CaseOf<2>&, const Body<2>&, RunState<2>&);
template void load_run<3>(const Loader&, const input::CaseOf<3>&, const Body<3>&, RunState<3>&);

}  // namespace scarp::run
