#include "scarp/run/runner.hpp"

#include <fmt/format.h>
#include <atomic>
#include <csignal>
#include <functional>
#include <new>
#include <numeric>
#include <utility>

#include "scarp/base/error.hpp"
#include "scarp/base/log.hpp"
#include "scarp/run/advice.hpp"
#include "scarp/run/body_state.hpp"
#include "scarp/run/stage.hpp"

namespace scarp::run {
namespace {

std::atomic<bool> asked_to_stop{false};

/// Turns signals that ask to stop into a request for as long as it lives.
class SignalGuard {
 public:
  SignalGuard() {
    asked_to_stop = false;
    for (std::size_t i = 0; i < signals.size(); ++i)
      old_[i] = std::signal(signals[i], [](int) { asked_to_stop = true; });
  }
  ~SignalGuard() {
    for (std::size_t i = 0; i < signals.size(); ++i) std::signal(signals[i], old_[i]);
  }
  SignalGuard(const SignalGuard&) = delete;
  SignalGuard& operator=(const SignalGuard&) = delete;

 private:
  static constexpr std::array signals{SIGINT, SIGTERM, SIGHUP};
  std::array<void (*)(int), signals.size()> old_{};
};

bool interrupted() {
  return asked_to_stop.load();
}

/// Energies, over that of the weight, which are of no account: a fall by a thousandth of the height.
constexpr double of_no_account = 1e-3;

void say_whether_energy_closes(const EnergyCheck& energy) {
  if (energy.largest_ratio() > EnergyCheck::worth_a_warning) logging::warn(energy_warning(energy));
}

/// How the time of the steps was spent, threads added up.
template <int Dim>
void print_profile(const Ledger<Dim>& ledger) {
  const double total = std::accumulate(ledger.seconds.begin(), ledger.seconds.end(), 0.0);
  if (!(total > 0)) return;
  fmt::print("phase of the step                      share   ns per point and step\n");
  for (int i = 0; i < phases; ++i) {
    if (ledger.seconds[i] == 0) continue;  // no part of these steps
    fmt::print("{:36} {:6.1f} %  {:8.1f}\n", phase_names[i], 100 * ledger.seconds[i] / total,
               1e9 * ledger.seconds[i] / static_cast<double>(ledger.point_steps));
  }
}

/// When the run ends if this stage, which starts at `time`, and those after it take all their durations [s].
template <int Dim>
double latest_end(const input::CaseOf<Dim>& input, std::size_t stage, double time) {
  for (std::size_t i = stage; i < input.stages.size(); ++i) time += input.stages[i].duration;
  return time;
}

/// What cannot be written any more is not what the user wants to hear of.
template <class F>
void try_to(F&& f) {
  try {
    f();
  } catch (const Error&) {
  }
}

}  // namespace

template <int Dim>
RunState<Dim> new_state(const Body<Dim>& body) {
  Ledger<Dim> ledger;
  record_motion(body, ledger.last);
  ledger.initial_mass = ledger.last.mass;
  ledger.initial_kinetic_energy = ledger.last.kinetic_energy;
  const EnergyCheck energy(ledger, of_no_account * weight_energy(body));
  return {ledger, energy, {}, false, {}, {}, 0, {}};
}

template <int Dim>
Runner<Dim>::Runner(const input::CaseOf<Dim>& input, const Options& options, int threads, Body<Dim>& body,
                    RunState<Dim>& state, Results<Dim>& results, CheckpointHead head)
    : input_(input),
      options_(options),
      body_(body),
      state_(state),
      results_(results),
      head_(std::move(head)),
      writer_(results.folder(), input.output.checkpoint),
      threads_(threads),
      wall_before_(state.wall_seconds) {}

template <int Dim>
Outcome Runner<Dim>::go() {
  const SignalGuard guard;
  try {
    writer_.start(state_.ledger.steps, state_.ledger.time);
    write_summary("running", "");
    if (state_.ledger.steps == 0 && writer_.on()) save(checkpoint_name(0));
    go_through_stages();
    writer_.finish();
  } catch (const RunError& error) {
    fail(error);
    throw;
  }
  if (options_.profile) print_profile(state_.ledger);
  const bool done = !state_.stage && state_.stages.size() == input_.stages.size();
  if (done || interrupted()) say_whether_energy_closes(state_.energy);
  warn_of_losses(state_.ledger, body_.point_count());
  write_summary(done ? "done" : "interrupted", "");
  if (!done && !options_.quiet) logging::info("stopped as asked; to go on with it: scarp resume " + results_.folder());
  return done ? Outcome::done : Outcome::interrupted;
}

template <int Dim>
void Runner<Dim>::go_through_stages() {
  Progress progress(options_.quiet);
  const std::function<bool()> stop = interrupted;
  const std::function<void()> keep = [this] { keep_when_due(); };
  Context<Dim> context{input_, body_, state_, results_, progress, stop, keep, options_.profile};
  const std::size_t count = input_.stages.size();
  while (static_cast<std::size_t>(state_.stage_index()) < count && !interrupted()) {
    const int index = state_.stage_index();
    const auto i = static_cast<std::size_t>(index);
    const double start = state_.stage ? state_.stages[i].start : state_.ledger.time;
    progress.stage(input_.stages[i].name, index, static_cast<int>(count), latest_end(input_, i, start));
    run_stage(context);
    if (state_.stage)
      save(checkpoint_name(state_.ledger.steps));  // interrupted: what follows is not for those who go on
    results_.history(index, body_.point_count(), state_.ledger);
    results_.frame(body_, state_.ledger.time);
    if (!state_.stage && input_.output.checkpoint.stages) save(stage_checkpoint_name(state_.ledger.steps, index));
  }
}

template <int Dim>
void Runner<Dim>::keep_when_due() {
  if (writer_.due(state_.ledger.steps, state_.ledger.time)) save(checkpoint_name(state_.ledger.steps));
}

template <int Dim>
void Runner<Dim>::save(const std::string& name) {
  state_.results = results_.state();
  state_.wall_seconds = wall_seconds();
  state_.warnings = logging::warnings();
  head_.time = state_.ledger.time;
  head_.steps = state_.ledger.steps;
  head_.within = state_.stage.has_value();
  head_.stage = state_.stages.empty() ? "" : state_.stages.back().name;
  try {
    io::Hdf5Image image(size_of_state(body_));
    const Saver saver(image, "scarp");
    save_head(saver, head_);
    save_run(saver, state_);
    save_body(saver, body_);
    writer_.write(name, image.finish(), [this] { results_.sync(); });
  } catch (const std::bad_alloc&) {
    // The run itself needs no more memory than it has.
    logging::info(fmt::format("no memory for the checkpoint {}: the run goes on without it", name));
  }
}

template <int Dim>
double Runner<Dim>::wall_seconds() const {
  return wall_before_ + std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

template <int Dim>
void Runner<Dim>::write_summary(const std::string& status, const std::string& message) {
  results_.summary(body_, state_.ledger,
                   {status, message, wall_seconds(), threads_, state_.energy.relative(state_.ledger),
                    state_.energy.largest_ratio(), state_.stages});
}

template <int Dim>
void Runner<Dim>::fail(const RunError& error) {
  try_to([&] { writer_.finish(); });
  try_to([&] { results_.frame(body_, state_.ledger.time); });
  head_.failed = true;
  try_to([&] {
    save(failed_checkpoint_name);
    writer_.finish();
  });
  say_whether_energy_closes(state_.energy);
  logging::note(error.what());
  try_to([&] { write_summary("failed", error.what()); });
}

template RunState<2> new_state<2>(const Body<2>&);
template RunState<3> new_state<3>(const Body<3>&);
template class Runner<2>;
template class Runner<3>;

}  // namespace scarp::run
