#include "scarp/material/umat.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "scarp/base/error.hpp"
#include "scarp/base/log.hpp"
#include "scarp/material/initial_values.hpp"
#include "scarp/material/umat_guard.hpp"

namespace scarp {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr std::size_t guards = 16;  ///< values behind PROPS and STATEV that the routine should not touch
constexpr double stress_shear = 1.0 / sqrt2, strain_shear = sqrt2;  ///< Abaqus's shear component over Mandel's

/// Place of a Mandel component (11, 22, 33, 12, 23, 13) among Abaqus's (11, 22, 33, 12, 13, 23), and back.
template <int N>
constexpr int place(int i) {
  return N == 6 && i >= 4 ? 9 - i : i;
}

template <int N>
void to_abaqus(const double* mandel, double sign, double shear, double* out) {
  for (int i = 0; i < N; ++i) out[place<N>(i)] = sign * (i < 3 ? 1.0 : shear) * mandel[i];
}
template <int N>
void from_abaqus(const double* in, double sign, double shear, double* mandel) {
  for (int i = 0; i < N; ++i) mandel[i] = sign * in[place<N>(i)] / (i < 3 ? 1.0 : shear);
}

/// f(variable, first index) for each variable of STATEV.
template <int N, class F>
void for_each_variable(const std::vector<Umat::Variable>& state, F&& f) {
  int at = 0;
  for (const auto& variable : state) {
    f(variable, at);
    at += variable.kind == Umat::Kind::scalar ? 1 : N;
  }
}

double shear_of(Umat::Kind kind) {
  return kind == Umat::Kind::strain ? strain_shear : stress_shear;
}

/// The arguments that differ from call to call, in Abaqus's signs and order.
template <int N>
struct Arguments {
  std::array<double, N> stress{}, stran{}, dstran{}, ddsddt{}, drplde{};
  std::array<double, Umat::most_statev + guards> statev;
  std::array<double, N * N> ddsdde{};
  double pnewdt = 1e10;  ///< "a large value before each call"

  Arguments(const Umat::State<double, N>& s, const Sym<double, N>& deps, const std::vector<Umat::Variable>& state) {
    to_abaqus<N>(s.sigma.c.data(), -1, stress_shear, stress.data());
    to_abaqus<N>(s.strain.c.data(), -1, strain_shear, stran.data());
    to_abaqus<N>(deps.c.data(), -1, strain_shear, dstran.data());
    statev.fill(untouched);
    for_each_variable<N>(state, [&](const Umat::Variable& variable, int at) {
      if (variable.kind == Umat::Kind::scalar) {
        statev[at] = s.values[at];
      } else {
        to_abaqus<N>(&s.values[at], 1, shear_of(variable.kind), &statev[at]);
      }
    });
  }

  void take(Umat::State<double, N>& s, const std::vector<Umat::Variable>& state) const {
    from_abaqus<N>(stress.data(), -1, stress_shear, s.sigma.c.data());
    for_each_variable<N>(state, [&](const Umat::Variable& variable, int at) {
      if (variable.kind == Umat::Kind::scalar) {
        s.values[at] = statev[at];
      } else {
        from_abaqus<N>(&statev[at], 1, shear_of(variable.kind), &s.values[at]);
      }
    });
  }

  static constexpr double untouched = -8.127564e211;  ///< no state variable's value
};

template <int N>
void invoke(umat::Routine routine, Arguments<N>& a, const std::vector<double>& props, const Umat::Parameters& p,
            double time, double dt, int increment, int nstatv, double coords, double stretch) {
  constexpr std::array<double, 9> identity{1, 0, 0, 0, 1, 0, 0, 0, 1};
  const double beside = std::isnan(stretch) ? stretch : 0;
  const std::array<double, 9> F{stretch, beside, beside, beside, stretch, beside, beside, beside, stretch};
  const std::array<double, 3> x{coords, coords, coords};
  constexpr std::array<int, 4> jstep{1, 1, 1, 0};  // step 1, static, large displacements, no perturbation
  constexpr double zero = 0;
  constexpr int one = 1, ndi = 3, nshr = N - 3, ntens = N;
  double sse = 0, spd = 0, scd = 0, rpl = 0, drpldt = 0;
  const int nprops = static_cast<int>(p.constants.size());
  const std::array<double, 2> times{time, time};
  routine(a.stress.data(), a.statev.data(), a.ddsdde.data(), &sse, &spd, &scd, &rpl, a.ddsddt.data(), a.drplde.data(),
          &drpldt, a.stran.data(), a.dstran.data(), times.data(), &dt, &zero, &zero, &zero, &zero, p.cmname.data(),
          &ndi, &nshr, &ntens, &nstatv, props.data(), &nprops, x.data(), identity.data(), &a.pnewdt, &p.celent,
          F.data(), F.data(), &one, &one, &one, &one, jstep.data(), &increment, p.cmname.size());
}

/// Largest term on the diagonal of DDSDDE; not finite where one is not.
template <int N>
double stiffness(const Arguments<N>& a) {
  double largest = 0;
  for (int i = 0; i < N; ++i) {
    const double x = a.ddsdde[i * (N + 1)];
    if (!std::isfinite(x)) return x;
    largest = std::max(largest, x);
  }
  return largest;
}

}  // namespace

Umat::Umat(Parameters parameters) {
  parameters.cmname.resize(80, ' ');
  for (const auto& variable : parameters.state) {
    size4_ += variable.kind == Kind::scalar ? 1 : 4;
    size6_ += variable.kind == Kind::scalar ? 1 : 6;
  }
  props_ = parameters.constants;
  props_.insert(props_.end(), guards, nan);
  parameters_ = std::make_shared<const Parameters>(std::move(parameters));
}

std::string Umat::title() const {
  const auto& name = parameters_->cmname;
  return fmt::format("the UMAT of the material {} ({})", name.substr(0, name.find_last_not_of(' ') + 1),
                     parameters_->library->path());
}

std::string Umat::Fault::text() const {
  return index == 0 ? fmt::format("{} = {:.6g}", array, value) : fmt::format("{}({}) = {:.6g}", array, index, value);
}

template <int N>
Umat::Fault Umat::call(const State<double, N>& s, const Increment<double, N>& i, State<double, N>& next,
                       const NotPassed& blank) const {
  const auto& p = *parameters_;
  const int nstatv = statev_size<N>();
  const double dt = i.dt > 0 ? i.dt : shortest_time;
  Arguments<N> a(s, i.deps, p.state);
  try {
    std::unique_lock<std::mutex> turn(p.library->turn(), std::defer_lock);
    if (p.one_at_a_time) turn.lock();
    if (p.library->ended()) throw umat::EndedProgram("an earlier call of it ended the program");
    const int increment = static_cast<int>(std::min(s.increments, 2e9)) + 1;
    umat::call_guarded([&] {
      invoke(p.library->routine(), a, props_, p, s.time, dt, increment, nstatv, blank.coords, blank.stretch);
    });
  } catch (const umat::Stopped& stop) {
    throw RunError(title() + " ends the analysis", stop.what(),
                   "see what it writes, and what it demands of its constants and state");
  } catch (const umat::EndedProgram& end) {
    p.library->set_ended();
    throw RunError(title() + " ends the analysis", end.what(),
                   "see what it writes, and what it demands of its constants and state");
  } catch (const umat::Crashed& crash) {
    p.library->set_ended();
    throw RunError(title() + " crashes", fmt::format("{} at TIME(2) = {:.6g}", crash.what(), s.time),
                   fmt::format("compile it with -g -fcheck=all to see where; check the numbers of constants (NPROPS = "
                               "{}) and of values of state (NSTATV = {})",
                               p.constants.size(), nstatv));
  }
  for (int k = nstatv; k < static_cast<int>(a.statev.size()); ++k) {
    if (a.statev[k] != Arguments<N>::untouched) return {Fault::Kind::overrun, "STATEV", k + 1, a.statev[k]};
  }
  if (a.pnewdt < 1) return {Fault::Kind::cut_back, "PNEWDT", 0, a.pnewdt};
  next = s;
  a.take(next, p.state);
  next.strain = s.strain + i.deps;
  next.time = s.time + dt;
  next.increments = s.increments + 1;
  if (p.wave_modulus == 0) {
    const double now = stiffness(a);
    if (!std::isfinite(now)) return {Fault::Kind::not_finite, "a diagonal term of DDSDDE", 0, now};
    next.modulus = std::max(s.modulus, now);
  }
  for (int k = 0; k < N; ++k) {
    if (!std::isfinite(a.stress[k])) return {Fault::Kind::not_finite, "STRESS", k + 1, a.stress[k]};
  }
  for (int k = 0; k < nstatv; ++k) {
    if (!std::isfinite(a.statev[k])) return {Fault::Kind::not_finite, "STATEV", k + 1, a.statev[k]};
  }
  return {};
}

template <int N>
Trial<Umat::State<double, N>, double> Umat::update(const State<double, N>& s, const Increment<double, N>& i,
                                                   double) const {
  Trial<State<double, N>, double> trial{s, 0.0, {}};
  const Fault fault = call(s, i, trial.state, {});
  if (fault.kind == Fault::Kind::overrun) {
    throw RunError(title() + " writes beyond its state",
                   fmt::format("{}, with NSTATV = {}", fault.text(), statev_size<N>()),
                   "list every variable of STATEV in state = [...]");
  }
  if (fault.kind == Fault::Kind::not_finite && parameters_->library->first_complaint()) {
    logging::warn(fmt::format(
        "{} answers with {}; a shorter increment is tried. Later cases are not shown (COORDS, "
        "DFGRD0 and DFGRD1{} are NaN: scarp does not pass them)",
        title(), fault.text(), std::isnan(parameters_->celent) ? ", and CELENT without the key celent," : ""));
  }
  trial.flags = {false, false, false, fault.kind == Fault::Kind::none};
  return trial;
}

template <int N>
std::string Umat::not_passed_but_used(const State<double, N>& start) const {
  // Answers to a call without strain, as bits: those that the arguments have no part in are equal.
  const auto answer = [&](const NotPassed& blank) {
    State<double, N> next = start;
    const Fault fault = call(start, Increment<double, N>{Sym<double, N>::zero(), 0.0}, next, blank);
    std::vector<double> all{fault.kind == Fault::Kind::none ? 0.0 : 1.0};
    for_each_component([&](const double& x) { all.push_back(x); }, next);
    return all;
  };
  constexpr NotPassed nothing{0, 1}, above{1e6, 1}, below{-1e6, 1}, strained{0, 1.5};
  const auto plain = answer(nothing);
  if (answer(nothing) != plain) return {};  // not even the same for the same: nothing is learnt from it
  const auto differs = [&](const NotPassed& blank) { return answer(blank) != plain; };
  const bool coords = differs({nan, 1}) || differs(above) || differs(below),
             stretch = differs({0, nan}) || differs(strained);
  return coords && stretch ? "COORDS and DFGRD0 or DFGRD1" : coords ? "COORDS" : stretch ? "DFGRD0 or DFGRD1" : "";
}

template <int N>
void Umat::check_start(const State<double, N>& start, std::vector<Problem>& problems, double& modulus) const {
  State<double, N> next = start;
  Fault fault;
  try {
    if (parameters_->library->first_probe()) {
      if (const auto used = not_passed_but_used(start); !used.empty()) {
        problems.push_back({"model", fmt::format("{} uses {}, which scarp does not pass", title(), used),
                            "an answer that depends on it",
                            "rewrite it in terms of STRESS, STATEV and DSTRAN (for what depends on the place, one "
                            "material for each region), or take another law"});
        return;
      }
    }
    fault = call(start, Increment<double, N>{Sym<double, N>::zero(), 0.0}, next, {});
  } catch (const RunError& error) {
    problems.push_back({"model", error.problem(), error.value(), error.remedy()});
    return;
  }
  if (fault.kind == Fault::Kind::not_finite && std::isnan(parameters_->celent)) {
    auto with_length = *parameters_;
    with_length.celent = 1;
    Umat other(*this);
    other.parameters_ = std::make_shared<const Parameters>(std::move(with_length));
    State<double, N> unused = start;
    if (other.call(start, Increment<double, N>{Sym<double, N>::zero(), 0.0}, unused, {}).kind == Fault::Kind::none) {
      problems.push_back({"celent", title() + " uses CELENT, the length of an element, which scarp does not pass",
                          fault.text(), "add celent = ..., the length that its softening is meant for"});
      return;
    }
  }
  if (fault.kind == Fault::Kind::overrun) {
    problems.push_back({"state", title() + " writes beyond its state",
                        fmt::format("{}, with NSTATV = {}", fault.text(), statev_size<N>()),
                        "list every variable of STATEV in state = [...]"});
  } else if (fault.kind != Fault::Kind::none) {
    problems.push_back(
        {"model", title() + " does not take the initial state: a first call without strain fails", fault.text(),
         fmt::format("check number (NPROPS = {}) and order of constants, number (NSTATV = {}) and initial "
                     "values of state, and the initial stress",
                     parameters_->constants.size(), statev_size<N>())});
  } else if (const double change = norm(next.sigma - start.sigma); change > 1e-6 * norm(start.sigma)) {
    problems.push_back(
        {"model", title() + " does not keep the initial stress: a first call without strain changes it",
         fmt::format("a change of {:.3g}, the stress is {:.3g}", change, norm(start.sigma)),
         "start from a stress that it admits; one that computes stress from the total strain or from the "
         "deformation gradient starts from no stress only, or is not for scarp"});
  } else if (parameters_->wave_modulus == 0 && !(next.modulus > 0)) {
    problems.push_back({"wave_modulus", title() + " gives no stiffness DDSDDE, which the time step needs", "0",
                        "add wave_modulus = ..., its K + 4G/3"});
  }
  modulus = parameters_->wave_modulus > 0 ? parameters_->wave_modulus : next.modulus;
}

template <int N>
Umat::State<double, N> Umat::initial_state(const Sym<double, N>& sigma, double, const Values& keys,
                                           std::vector<Problem>& problems) const {
  State<double, N> s{sigma, Sym<double, N>::zero(), parameters_->wave_modulus, 0.0, 0.0, {}};
  for_each_variable<N>(parameters_->state, [&](const Variable& variable, int at) {
    const auto key = keys.find(variable.name);
    if (variable.kind == Kind::scalar) {
      if (!variable.initial.empty()) s.values[at] = variable.initial[0];
      if (const auto value = initial::number(keys, variable.name, problems)) s.values[at] = *value;
      return;
    }
    const auto* list = key == keys.end() ? &variable.initial : std::get_if<std::vector<double>>(&key->second);
    if (!list) {
      problems.push_back({variable.name, fmt::format("{} takes the 6 components xx, yy, zz, xy, yz, zx", variable.name),
                          "no list of numbers", "write the tensor components (not multiplied by 2) in brackets"});
    } else if (key != keys.end() || !list->empty()) {
      const auto tensor = initial::tensor<N>(variable.name, *list, problems);
      if (tensor) std::copy(tensor->c.begin(), tensor->c.end(), s.values.begin() + at);
    }
  });
  if (problems.empty()) check_start(s, problems, s.modulus);
  return s;
}

template Trial<Umat::State<double, 4>, double> Umat::update<4>(const State<double, 4>&, const Increment<double, 4>&,
                                                               double) const;
template Trial<Umat::State<double, 6>, double> Umat::update<6>(const State<double, 6>&, const Increment<double, 6>&,
                                                               double) const;
template Umat::State<double, 4> Umat::initial_state<4>(const Sym<double, 4>&, double, const Values&,
                                                       std::vector<Problem>&) const;
template Umat::State<double, 6> Umat::initial_state<6>(const Sym<double, 6>&, double, const Values&,
                                                       std::vector<Problem>&) const;

}  // namespace scarp
