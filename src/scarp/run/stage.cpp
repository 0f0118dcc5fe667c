#include "scarp/run/stage.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "scarp/base/error.hpp"
#include "scarp/base/log.hpp"
#include "scarp/run/build.hpp"
#include "scarp/run/removal.hpp"
#include "scarp/run/rest_watch.hpp"
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

/// Times at regular distances from the start of a stage.
class Clock {
 public:
  Clock(double start, double every) : start_(start), every_(every), count_(1) {}
  double next() const { return every_ > 0 ? start_ + every_ * count_ : std::numeric_limits<double>::infinity(); }
  bool due(double time) {
    if (time < next() * (1 - 1e-12)) return false;
    // Straight to the first one after `time`: there may be any number of them in a step.
    count_ = std::max(count_ + 1, std::floor((time - start_) / every_));
    if (next() * (1 - 1e-12) <= time) ++count_;
    return true;
  }

 private:
  double start_, every_, count_;
};

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

template <int Dim>
void check_failures(const Context<Dim>& context) {
  const auto& ledger = context.ledger;
  if (ledger.failures <= context.input.method.largest_failures) return;
  throw RunError(
      fmt::format("the stress update of point {} failed at t = {:.6g} s, step {}: {}",
                  ledger.last.stress.first_failed.id, ledger.time, ledger.steps,
                  end_text(ledger.last.stress.first_failed.end)),
      fmt::format("{} failures in this run", ledger.failures),
      "look at the last frame; take a smaller safety, with the subloading model a larger p_c_floor, or allow some with "
      "largest_failures in [method]");
}

/// Says once that the books of energy do not close, and stops where they are far from it.
template <int Dim>
void check_energy(const Context<Dim>& context, bool& said) {
  const auto& energy = context.energy;
  if (energy.ratio() > EnergyCheck::worth_a_warning && !said) {
    said = true;
    context.progress.clear();
    logging::info(energy_warning(energy));
  }
  const double largest = context.input.method.largest_energy_error;
  if (largest <= 0 || energy.ratio() <= largest) return;
  throw RunError(
      fmt::format("the books of energy do not close at t = {:.6g} s, step {}: the motion is not that of the soil",
                  context.ledger.time, context.ledger.steps),
      fmt::format("{:.3g} of the run's energies unaccounted for (largest_energy_error: {:g})", energy.ratio(), largest),
      fmt::format("{}; or allow more with largest_energy_error in [method], 0 for any", energy_remedy));
}

/// One step of the body; an error tells when it came. The ledger's time is then that of the failed step, for its state
/// is what the last frame shows.
template <int Dim>
StepTotals<Dim> step(Context<Dim>& context, const std::string& stage, double dt, const StepSettings& settings) {
  try {
    return advance(context.body, dt, settings);
  } catch (const RunError& error) {
    context.ledger.time += dt;
    throw RunError(fmt::format("{} at t = {:.6g} s, step {}, in stage \"{}\"", error.problem(), context.ledger.time,
                               context.ledger.steps + 1, stage),
                   error.value(), error.remedy());
  }
}

template <int Dim>
double stable_time_step(const Context<Dim>& context, double critical) {
  if (!std::isfinite(critical)) {
    throw RunError("no point has any stiffness left, so that there is no critical time step",
                   fmt::format("t = {:.6g} s", context.ledger.time), "look at the last frame: all soil has separated");
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
  LettingGo(double release, double start, Body<Dim>& body) : release_(release), start_(start), body_(body) {}
  ~LettingGo() { hold(0); }
  LettingGo(const LettingGo&) = delete;
  LettingGo& operator=(const LettingGo&) = delete;

  void before_step(double time, const StepSettings& settings) {
    if (!held_ && release_ > 0) hold_imbalance(body_, settings);
    held_ = true;
    if (release_ > 0) hold(std::max(0.0, 1 - (time - start_) / release_));
  }
  bool finished(double time) const { return time >= start_ + release_; }

 private:
  void hold(double share) {
    for (auto& field : body_.fields) field.outside.release.share = share;
  }

  double release_, start_;
  bool held_ = false;
  Body<Dim>& body_;
};

/// Soil counts as moved where it has gone more than this share of the body's height at the start of the stage.
constexpr double moved_heights = 0.01;

/// Keeps the record of a stage true at its end, whichever way it ends.
template <int Dim>
class RecordKeeper {
 public:
  RecordKeeper(StageRecord& record, const Context<Dim>& context) : record_(record), context_(context) {
    record_.moved_beyond = moved_heights * height(context.body);
  }
  ~RecordKeeper() { update(); }
  RecordKeeper(const RecordKeeper&) = delete;
  RecordKeeper& operator=(const RecordKeeper&) = delete;

  void update() {
    const auto& ledger = context_.ledger;
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

template <int Dim>
void run_stage(Context<Dim>& context, int index, StageRecord& record) {
  const auto& stage = context.input.stages[index];
  auto& [input, body, ledger, results, progress, energy, interrupted, profile] = context;
  record = {};
  record.name = stage.name;
  record.start = ledger.time;
  record.removal = stage.remove.has_value();
  record.ended = "failed";
  RecordKeeper<Dim> keeper(record, context);
  const double end = ledger.time + stage.duration;
  set_to_zero(body, stage, ledger);
  std::optional<Removal<Dim>> removal;
  if (stage.remove) removal.emplace(*stage.remove, ledger.time);
  std::optional<RestWatch<Dim>> rest;
  if (stage.rest) rest.emplace(*stage.rest, body);
  const StepSettings settings{scheme_of(input.method, stage.flip),
                              stage.damping,
                              input.method.corrected_quadrature ? QuadratureRule::corrected : QuadratureRule::points,
                              {input.method.tolerance, 1e-5},
                              input.method.remove_leaving,
                              profile};
  open_sides(body, input, settings, index);
  LettingGo<Dim> imbalance(stage.release, ledger.time, body);
  Clock frames(ledger.time, input.output.every), rows(ledger.time, input.output.history);
  double critical = critical_time_step(body, settings.scheme, settings.damping);
  bool resting = false, first = true, energy_said = energy.largest_ratio() > EnergyCheck::worth_a_warning;

  while (ledger.time < end && !resting && !interrupted()) {
    if (removal) removal->take_due(ledger.time, body, ledger);
    imbalance.before_step(ledger.time, settings);
    const double next_lift = removal ? removal->next_time() : end;
    const double until = std::min({end, frames.next(), next_lift}) - ledger.time;
    const double dt = fitted(stable_time_step(context, critical), until);
    const auto totals = step(context, stage.name, dt, settings);
    ledger.add(dt, body.point_count(), totals);
    energy.step(ledger);
    if (end - ledger.time < 1e-9 * dt) ledger.time = end;
    critical = totals.stress.critical_dt;
    ++record.steps;
    resting =
        rest && rest->at_rest(ledger, body) && (!removal || removal->finished()) && imbalance.finished(ledger.time);

    if (input.output.history <= 0 || rows.due(ledger.time) || first) results.history(index, body.point_count(), ledger);
    if (frames.due(ledger.time) || (first && stage.remove)) results.frame(body, ledger.time);
    first = false;
    progress.show(ledger.time, ledger.point_steps, ledger.unbalanced_ratio(), ledger.last.max_velocity);
    check_failures(context);
    check_energy(context, energy_said);
  }

  keeper.update();
  record.ended = interrupted() ? "interrupted" : resting ? "at rest" : "duration";
  progress.stage_ended(fmt::format("{} at t = {:.4g} s; {}", record.ended == "duration" ? "over" : record.ended,
                                   ledger.time, how_far(record)));
  if (stage.rest && stage.rest->required && !resting && !interrupted()) refuse_unrest(stage, record, ledger, *rest);
}

template void run_stage<2>(Context<2>&, int, StageRecord&);
template void run_stage<3>(Context<3>&, int, StageRecord&);

}  // namespace scarp::run
