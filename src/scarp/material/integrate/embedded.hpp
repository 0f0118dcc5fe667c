// Explicit integration of a law over a strain increment with embedded Runge–Kutta pairs and automatic error control.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <type_traits>

#include "scarp/material/increment.hpp"
#include "scarp/material/state.hpp"

namespace scarp {

/// Modified Euler (Heun) 2(1): the solution of order 2, the error from its difference to forward Euler.
struct ModifiedEuler {
  static constexpr int stages = 2;
  static constexpr bool doubts = false;  ///< its estimate holds at kinks of a law, too
  static constexpr double order = 2;     ///< of the local error estimate: step factor (tol/err)^(1/order)
  static constexpr std::array<std::array<double, 1>, 2> a{{{0}, {1}}};
  static constexpr std::array<double, 2> b{0.5, 0.5};
  static constexpr std::array<double, 2> e{-0.5, 0.5};
};

/// Dormand & Prince (1980) 5(4).
struct DormandPrince {
  static constexpr int stages = 7;
  static constexpr bool doubts = true;  ///< its estimate supposes a smooth law: see Doubt
  static constexpr double order = 5;
  static constexpr std::array<std::array<double, 6>, 7> a{{
      {0, 0, 0, 0, 0, 0},
      {1.0 / 5, 0, 0, 0, 0, 0},
      {3.0 / 40, 9.0 / 40, 0, 0, 0, 0},
      {44.0 / 45, -56.0 / 15, 32.0 / 9, 0, 0, 0},
      {19372.0 / 6561, -25360.0 / 2187, 64448.0 / 6561, -212.0 / 729, 0, 0},
      {9017.0 / 3168, -355.0 / 33, 46732.0 / 5247, 49.0 / 176, -5103.0 / 18656, 0},
      {35.0 / 384, 0, 500.0 / 1113, 125.0 / 192, -2187.0 / 6784, 11.0 / 84},
  }};
  static constexpr std::array<double, 7> b{35.0 / 384, 0, 500.0 / 1113, 125.0 / 192, -2187.0 / 6784, 11.0 / 84, 0};
  static constexpr std::array<double, 7> e{71.0 / 57600,      0,          -71.0 / 16695, 71.0 / 1920,
                                           -17253.0 / 339200, 22.0 / 525, -1.0 / 40};
};

/// s + Σ w_i k_i over the first changes `k`, in one pass over the components: states are large, and copies of them cost
/// as much as the law.
template <class T, class State, std::size_t n, class... Rates>
inline State combined(const State& s, const std::array<double, n>& w, const Rates&... k) {
  State r;
  for_each_component(
      [&w](auto& x, const auto& y, const auto&... dx) {
        x = y;
        [[maybe_unused]] std::size_t i = 0;
        ((w[i] != 0 ? void(x = x + T(w[i]) * dx) : void(), ++i), ...);
      },
      r, s, k.change...);
  return r;
}

/// Σ e_i k_i, the estimate of the error.
template <class Pair, class T, class First, class... Rates>
inline auto error_of(const First& k0, const Rates&... k) {
  auto r = k0.change;
  for_each_component(
      [](auto& x, const auto&... dx) {
        x = T(Pair::e[0]) * x;
        std::size_t i = 1;
        ((Pair::e[i] != 0 ? void(x = x + T(Pair::e[i]) * dx) : void(), ++i), ...);
      },
      r, k.change...);
  return r;
}

/// One step of a pair, from the stages `k` that there are already. `Step` is an Increment, or whatever a law is driven
/// by that has rate_of(), is_idle() and a product with a number.
template <class Pair, class Model, class State, class Step, class... Rates>
inline auto attempt_pair(const Model& model, const State& s, const Step& step, double tolerance, const Rates&... k) {
  using T = decltype(model.error_norm(s, s));
  constexpr std::size_t done = sizeof...(k);
  if constexpr (done == 0) {
    return attempt_pair<Pair>(model, s, step, tolerance, rate_of(model, s, step));
  } else if constexpr (done < Pair::stages) {
    const auto next = rate_of(model, combined<T>(s, Pair::a[done], k...), step);
    return attempt_pair<Pair>(model, s, step, tolerance, k..., next);
  } else {
    Trial<State, T> trial{combined<T>(s, Pair::b, k...), T(0.0), {}};
    trial.error = model.error_norm(trial.state, error_of<Pair, T>(k...));
    trial.flags = model.accept(trial.state, tolerance);
    trial.flags.sound = (trial.flags.sound && ... && k.sound);
    return trial;
  }
}

/// Does the law bring an integration of its own that advances by the pair, update<Pair>(s, increment, tolerance), and
/// whose error estimate so falls as the pair's?
template <class Model, class Pair, class State, class Step>
concept UpdatesByPair = requires(const Model& model, const State& s, const Step& step) {
  model.template update<Pair>(s, step, 1e-4);
};

/// The whole increment (a strain, or an Increment) at once: by the law's own update where it has one, else by the pair.
template <class Pair, class Model, class State, class Step>
inline auto attempt(const Model& model, const State& s, const Step& increment, double tolerance) {
  const auto step = as_increment(increment);
  if constexpr (UpdatesByPair<Model, Pair, State, std::decay_t<decltype(step)>>) {
    return model.template update<Pair>(s, step, tolerance);
  } else if constexpr (requires { updated(model, s, step, tolerance); }) {
    return updated(model, s, step, tolerance);
  } else {
    return attempt_pair<Pair>(model, s, step, tolerance);
  }
}

struct IntegrationSettings {
  double tolerance = 1e-4;         ///< relative error of one substep, all state variables in one norm
  double smallest_substep = 1e-7;  ///< share of the increment
};

enum class IntegrationEnd { done, not_converged, unstable, inadmissible };

struct IntegrationReport {
  int substeps = 0;  ///< accepted
  int rejected = 0;
  double reached = 0;  ///< share of the increment that was integrated; 1 when done
  IntegrationEnd end = IntegrationEnd::done;
  UpdateFlags<double> flags{};
};

/// A law has kinks: where plastic strain sets in, where a direction turns round. A substep of high order across one has
/// an error that its estimate, which supposes a smooth law, may miss by two orders of magnitude. In smooth motion an
/// estimate goes on from the one before; one that does not is doubted, and the substep confirmed by two of half its
/// size.
class Doubt {
 public:
  Doubt(double order, double tolerance) : order_(order), tolerance_(tolerance) {}

  bool about(double error, double step) const {
    if (error < 1e-3 * tolerance_) return false;
    const double expected = error_ * std::pow(step / step_, order_);
    return !(error < 1.7 * expected && error > 0.6 * expected);
  }
  void accepted(double error, double step) {
    error_ = error;
    step_ = step;
  }

 private:
  double order_, tolerance_;
  double error_ = 0, step_ = 1;  ///< of the last accepted substep
};

/// Two halves of a substep in place of `whole`: its error becomes the difference between both answers.
template <class Pair, class Model, class State, class Step, class Whole>
Whole confirmed(const Model& model, const State& s, const Step& part, double tolerance, const Whole& whole) {
  const auto half = 0.5 * part;
  const auto first = attempt<Pair>(model, s, half, tolerance);
  auto both = attempt<Pair>(model, first.state, half, tolerance);
  State difference = both.state;
  for_each_component([](double& x, const double& y) { x -= y; }, difference, whole.state);
  both.error = model.error_norm(both.state, difference);
  both.flags.sound = both.flags.sound && first.flags.sound;
  both.flags.corrected = both.flags.corrected || first.flags.corrected;
  return both;
}

/// Why the state cannot take even `part`.
template <class Model, class State, class Step>
IntegrationEnd failure(const Model& model, const State& state, const Step& part, double tolerance) {
  if (!model.admissible(state)) return IntegrationEnd::inadmissible;
  bool solvable;
  if constexpr (requires { updated(model, state, part, tolerance); }) {
    solvable = updated(model, state, part, tolerance).flags.sound;
  } else {
    solvable = rate_of(model, state, part).sound;
  }
  return solvable ? IntegrationEnd::not_converged : IntegrationEnd::unstable;
}

/// Order of the error estimate: the pair's, or that of the law's own update.
template <class Pair, class Model, class State, class Step>
constexpr double error_order() {
  constexpr bool own_update = requires(const Model& model, const State& s, const Step& i) {
    updated(model, s, i, 1e-4);
  };
  return own_update && !UpdatesByPair<Model, Pair, State, Step> ? 2 : Pair::order;
}

/// The step control of one increment: which share of it to try next, and what became of that. Sloan-type: factor
/// 0.9 (tolerance/error)^(1/order), bounded, and no growth right after a rejection.
class StepControl {
 public:
  StepControl() = default;
  explicit StepControl(double start) : step_(start) {}

  IntegrationReport report;  ///< but for its end, where stuck()

  bool finished() const { return t_ == 1.0; }
  /// The last trial was rejected, and the next would be smaller than allowed.
  bool stuck(const IntegrationSettings& settings) const { return rejected_ && step_ < settings.smallest_substep; }

  /// The share of the increment to try.
  double next() {
    step_ = std::min(step_, 1.0 - t_);
    // A remainder of round-off size would be a substep of its own.
    if (1.0 - t_ - step_ < 1e-12) step_ = 1.0 - t_;
    return step_;
  }

  /// Is the trial good? A NaN error is not.
  bool judge(double error, const UpdateFlags<double>& flags, double tolerance, double order) {
    const bool good = flags.sound && error <= tolerance;
    const double ratio = tolerance / std::max(error, 1e-16 * tolerance);
    const double power = order == 2 ? std::sqrt(ratio) : std::pow(ratio, 1.0 / order);
    const double factor = std::isfinite(error) ? 0.9 * power : 0.1;
    if (good) {
      const bool corrected = report.flags.corrected || flags.corrected;
      report.flags = flags;
      report.flags.corrected = corrected;
      ++report.substeps;
      t_ = (step_ == 1.0 - t_) ? 1.0 : t_ + step_;
      step_ *= std::clamp(factor, 0.2, rejected_ ? 1.0 : 5.0);
    } else {
      ++report.rejected;
      step_ *= flags.sound ? std::clamp(factor, 0.1, 0.9) : 0.25;
    }
    rejected_ = !good;
    report.reached = t_;
    return good;
  }

 private:
  double step_ = 1, t_ = 0;
  bool rejected_ = false;
};

/// Integrates `state` over an increment (a strain, compression positive, or an Increment), substep by substep. When an
/// error below the tolerance needs less than the smallest substep, `state` is left at the last accepted one and the
/// report says how far it came. `start` is the first substep to try, as a share of the increment.
template <class Pair, class Model, class State, class Step>
IntegrationReport integrate(const Model& model, State& state, const Step& increment,
                            const IntegrationSettings& settings, double start = 1.0) {
  IntegrationReport report;
  const auto whole = as_increment(increment);
  if (is_idle(model, whole)) {
    report.reached = 1;
    report.substeps = 1;
    State same = state;  // a point to which nothing happens keeps its state to the last bit
    report.flags = model.accept(same, settings.tolerance);
    return report;
  }
  constexpr double order = error_order<Pair, Model, State, std::decay_t<decltype(whole)>>();
  StepControl control(start);
  Doubt doubt(order, settings.tolerance);
  while (!control.finished()) {
    const double step = control.next();
    const auto part = step * whole;
    auto trial = attempt<Pair>(model, state, part, settings.tolerance);
    const double estimate = trial.error;
    const bool seems_good = trial.flags.sound && estimate <= settings.tolerance;
    const bool doubted = Pair::doubts && seems_good && doubt.about(estimate, step);
    if (doubted) trial = confirmed<Pair>(model, state, part, settings.tolerance, trial);
    // What a doubted substep misses is the kink's: of first order.
    const double judged = doubted && !(trial.error <= settings.tolerance) ? 1 : order;
    if (control.judge(trial.error, trial.flags, settings.tolerance, judged)) {
      state = trial.state;
      control.report.substeps += doubted;  // both halves count
      doubt.accepted(estimate, step);
    } else if (control.stuck(settings)) {
      control.report.end = failure(model, state, part, settings.tolerance);
      return control.report;
    }
  }
  return control.report;
}

}  // namespace scarp
