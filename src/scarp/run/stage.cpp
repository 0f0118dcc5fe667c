#include "scarp/run/stage.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "scarp/base/error.hpp"
#include "scarp/base/log.hpp"
#include "scarp/run/build.hpp"
#include "scarp/run/scheme.hpp"

namespace scarp::run {
namespace {

template <int Dim>
void set_to_zero(Body<Dim>& body, const input::StageInputOf<Dim>& stage, Ledger<Dim>& ledger) {
  for (auto& block : body.blocks()) {
    auto& points = block.points;
    if (stage.zero_displacement) {
      points.x_start = points.x;
      std::fill(points.eps_q.begin(), points.eps_q.end(), 0.0);
    }
    if (stage.zero_velocity) {
      for (auto& v : points.v) std::fill(v.begin(), v.end(), 0.0);
      for (auto& C : points.C) std::fill(C.begin(), C.end(), 0.0);
    }
  }
  if (stage.zero_velocity) ledger.removed_kinetic_energy += ledger.last.kinetic_energy;
  record_motion(body, ledger.last);
}

/// A step that reaches `until` evenly, instead of with a sliver at its end.
double fitted(double dt, double until) {
  if (!(until > 0)) return dt;
  return until <= 4 * dt ? until / std::ceil(until / dt * (1 - 1e-12)) : dt;
}

std::string end_text(IntegrationEnd end) {
  switch (end) {
    case IntegrationEnd::unstable:
      return "its law has no answer there: the material is unstable (N:D:G + H is not positive), or a value is not "
             "finite";
    case IntegrationEnd::inadmissible:
      return "its state is not admissible";
    default:
      return "the error stays above the tolerance at the smallest substep";
  }
}

/// "at t = 1 s, step 3, in stage "cut"": when an error after a step came.
template <int Dim>
std::string when(const Context<Dim>& context) {
  const auto& ledger = context.state.ledger;
  return fmt::format("at t = {:.6g} s, step {}, in stage \"{}\"", ledger.time, ledger.steps,
                     context.state.stages.back().name);
}

/// " of region "clay" at (1, 2)": where the point of this number is; nothing where it is gone.
template <int Dim>
std::string place_of(const Body<Dim>& body, int id) {
  for (const auto& block : body.blocks()) {
    const auto found = std::find(block.points.id.begin(), block.points.id.end(), id);
    if (found == block.points.id.end()) continue;
    const auto x = position_of(block.points, static_cast<int>(found - block.points.id.begin()));
    return fmt::format(" of region \"{}\" at ({:.6g})", block.name, fmt::join(x, ", "));
  }
  return "";
}

template <int Dim>
void check_failures(const Context<Dim>& context) {
  const auto& ledger = context.state.ledger;
  if (ledger.failures <= context.input.method.largest_failures) return;
  const auto& first = ledger.last.stress.first_failed;
  throw RunError(
      fmt::format("the stress update of point {}{} failed {}: {}", first.id, place_of(context.body, first.id),
                  when(context), end_text(first.end)),
      fmt::format("{} failures in this run", ledger.failures),
      "look at the last frame; take a smaller safety, with the subloading model a larger p_c_floor, or allow some with "
      "largest_failures in [method]");
}

/// Says once that the books of energy do not close, and stops where they are far from it.
template <int Dim>
void check_energy(const Context<Dim>& context) {
  const auto& energy = context.state.energy;
  bool& said = context.state.stage->energy_said;
  if (energy.ratio() > EnergyCheck::worth_a_warning && !said) {
    said = true;
    context.progress.clear();
    logging::info(energy_warning(energy));
  }
  const double largest = context.input.method.largest_energy_error;
  if (largest <= 0 || energy.ratio() <= largest) return;
  throw RunError(
      fmt::format("the books of energy do not close {}: the motion is not that of the soil", when(context)),
      fmt::format("{:.3g} of the run's energies unaccounted for (largest_energy_error: {:g})", energy.ratio(), largest),
      fmt::format("{}; or allow more with largest_energy_error in [method], 0 for any", energy_remedy));
}

/// One step of the body; an error tells when it came. The ledger's time is then that of the failed step, for its state
/// is what the last frame shows.
template <int Dim>
StepTotals<Dim> step(Context<Dim>& context, const std::string& stage, double dt, const StepSettings& settings) {
  auto& ledger = context.state.ledger;
  try {
    return advance(context.body, dt, settings);
  } catch (const RunError& error) {
    ledger.time += dt;
    throw RunError(fmt::format("{} at t = {:.6g} s, step {}, in stage \"{}\"", error.problem(), ledger.time,
                               ledger.steps + 1, stage),
                   error.value(), error.remedy());
  }
}

template <int Dim>
double stable_time_step(const Context<Dim>& context, double critical) {
  if (!std::isfinite(critical)) {
    throw RunError("no point has any stiffness left, so that there is no critical time step",
                   fmt::format("t = {:.6g} s", context.state.ledger.time),
                   "look at the last frame: all soil has separated");
  }
  return context.input.method.safety * critical;
}

/// How far the soil has gone, in words.
std::string how_far(const StageRecord& record) {
  return fmt::format("largest displacement {:.4g} m, a mass of {:.4g} moved more than {:.3g} m",
                     record.max_displacement, record.moved_mass, record.moved_beyond);
}

template <int Dim>
[[noreturn]] void refuse_unrest(const input::StageInputOf<Dim>& stage, const StageRecord& record,
                                const Ledger<Dim>& ledger, const RestWatch<Dim>& watch) {
  const auto& asked = *stage.rest;
  const std::string rate =
      std::isfinite(watch.rate())
          ? fmt::format("a rate of displacement of {:.3g} heights per second (asked: {:g}), ", watch.rate(), asked.rate)
          : std::string();
  throw RunError(
      fmt::format("the ground does not come to rest in stage \"{}\" within {:g} s", stage.name, stage.duration),
      fmt::format("an unbalanced force ratio of {:.3g} (asked: {:g}), a kinetic energy of {:.3g} of the weight's "
                  "(asked: {:g}), {}a largest velocity of {:.3g} m/s; {}",
                  record.unbalanced_ratio, asked.unbalanced, watch.kinetic(ledger), asked.kinetic, rate,
                  record.max_velocity, how_far(record)),
      "look at the last frame: either the slope does not stand, or the stage needs more time or more damping");
}

/// Lets go, over `release` seconds from the start of a stage, of the imbalance with which it starts.
template <int Dim>
class LettingGo {
 public:
  /// `held`: is the imbalance known, and when not yet, it is found before the first step.
  LettingGo(double release, double start, bool& held, Body<Dim>& body)
      : release_(release), start_(start), held_(held), body_(body) {}
  ~LettingGo() { hold(0); }
  LettingGo(const LettingGo&) = delete;
  LettingGo& operator=(const LettingGo&) = delete;

  void before_step(double time, const StepSettings& settings) {
    if (!held_ && release_ > 0) hold_imbalance(body_, settings);
    held_ = true;
    if (release_ > 0) hold(std::max(0.0, 1 - (time - start_) / release_));
  }
  bool finished(double time) const { return time >= start_ + release_; }
  /// The stage is over.
  void forget() {
    for (auto& field : body_.fields) field.outside.release = {};
  }

 private:
  void hold(double share) {
    for (auto& field : body_.fields) field.outside.release.share = share;
  }

  double release_, start_;
  bool& held_;
  Body<Dim>& body_;
};

/// Soil counts as moved where it has gone more than this share of the body's height at the start of the stage.
constexpr double moved_heights = 0.01;

/// Keeps the record of a stage true at its end, whichever way it ends.
template <int Dim>
class RecordKeeper {
 public:
  RecordKeeper(StageRecord& record, const Context<Dim>& context) : record_(record), context_(context) {}
  ~RecordKeeper() { update(); }
  RecordKeeper(const RecordKeeper&) = delete;
  RecordKeeper& operator=(const RecordKeeper&) = delete;

  void update() {
    const auto& ledger = context_.state.ledger;
    record_.end = ledger.time;
    record_.unbalanced_ratio = ledger.unbalanced_ratio();
    record_.max_velocity = ledger.last.max_velocity;
    record_.max_displacement = max_displacement(context_.body);
    record_.moved_mass = mass_moved(context_.body, record_.moved_beyond);
  }

 private:
  StageRecord& record_;
  const Context<Dim>& context_;
};

}  // namespace

namespace {

/// Puts the next stage under way.
template <int Dim>
void begin_stage(Context<Dim>& context, const StepSettings& settings) {
  auto& [input, body, state, results, progress, interrupted, keep, profile] = context;
  const int index = state.stage_index();
  const auto& stage = input.stages[static_cast<std::size_t>(index)];
  if (stage.remove && !state.cut) {
    state.cut = true;
    state.energy.start(state.ledger);
  }
  auto& record = state.stages.emplace_back();
  record.name = stage.name;
  record.start = state.ledger.time;
  record.removal = stage.remove.has_value();
  record.ended = "failed";
  record.moved_beyond = moved_heights * height(body);
  set_to_zero(body, stage, state.ledger);
  auto& now = state.stage.emplace(input, index, state.ledger, body);
  open_sides(body, input, settings, index);
  now.critical = critical_time_step(body, settings.scheme, settings.damping);
  now.energy_said = state.energy.largest_ratio() > EnergyCheck::worth_a_warning;
}

}  // namespace

template <int Dim>
void run_stage(Context<Dim>& context) {
  auto& [input, body, state, results, progress, interrupted, keep, profile] = context;
  auto& ledger = state.ledger;
  const int index = state.stage_index();
  const auto& stage = input.stages[static_cast<std::size_t>(index)];
  const auto settings = settings_of(input, stage, profile);
  if (!state.stage) begin_stage(context, settings);
  auto& record = state.stages.back();
  auto& now = *state.stage;
  RecordKeeper<Dim> keeper(record, context);
  const double end = record.start + stage.duration;
  LettingGo<Dim> imbalance(stage.release, record.start, now.held, body);

  while (ledger.time < end && !now.resting && !interrupted()) {
    if (now.removal) now.removal->take_due(ledger.time, body, ledger);
    imbalance.before_step(ledger.time, settings);
    const double next_lift = now.removal ? now.removal->next_time() : end;
    const double until = std::min({end, now.frames.next(), next_lift}) - ledger.time;
    const double dt = fitted(stable_time_step(context, now.critical), until);
    const auto totals = step(context, stage.name, dt, settings);
    ledger.add(dt, body.point_count(), totals);
    state.energy.step(ledger);
    if (end - ledger.time < 1e-9 * dt) ledger.time = end;
    now.critical = totals.stress.critical_dt;
    ++record.steps;
    now.resting = now.rest && now.rest->at_rest(ledger, body) && (!now.removal || now.removal->finished()) &&
                  imbalance.finished(ledger.time);

    if (input.output.history <= 0 || now.rows.due(ledger.time) || now.first)
      results.history(index, body.point_count(), ledger);
    if (now.frames.due(ledger.time) || (now.first && stage.remove)) results.frame(body, ledger.time);
    now.first = false;
    progress.show(ledger.time, ledger.point_steps, ledger.unbalanced_ratio(), ledger.last.max_velocity);
    check_failures(context);
    check_energy(context);
    keep();
  }

  keeper.update();
  const bool over = now.resting || ledger.time >= end;
  record.ended = !over ? "interrupted" : now.resting ? "at rest" : "duration";
  progress.stage_ended(fmt::format("{} at t = {:.4g} s; {}", record.ended == "duration" ? "over" : record.ended,
                                   ledger.time, how_far(record)));
  if (!over) return;
  if (stage.rest && stage.rest->required && !now.resting) refuse_unrest(stage, record, ledger, *now.rest);
  imbalance.forget();
  state.stage.reset();
}

template void run_stage<2>(Context<2>&);
template void run_stage<3>(Context<3>&);

}  // namespace scarp::run
