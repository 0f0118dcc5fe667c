// A specimen in the laboratory: the state of one stress point, taken further by strain or by constraints.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "scarp/lab/constrained.hpp"
#include "scarp/material/integrate/embedded.hpp"

namespace scarp::lab {

/// √(2/3) ‖dev ε‖
inline double deviatoric_strain(const Sym<double, 6>& eps) {
  return std::sqrt(2.0 / 3.0) * norm(deviator(eps));
}

/// What an increment came to.
struct Step {
  int substeps = 0;
  double reached = 1;           ///< share of the increment
  std::string problem, remedy;  ///< empty where it was done
};

template <class Model>
class Specimen {
  using Soil = typename Model::template State<double, 6>;
  using Law = Constrained<Model>;

 public:
  Specimen(const Model& model, const Soil& soil, const IntegrationSettings& settings, Scheme scheme)
      : model_(model), settings_(settings), scheme_(scheme), soil_(soil) {
    for (const auto& field : description_of(model).state) fields_.push_back(field.kind);
  }

  const Soil& soil() const { return soil_; }
  const Sym<double, 6>& eps() const { return eps_; }
  double value(const LinearForm& form) const {
    const auto eps = from_mandel(eps_), sigma = from_mandel(soil_.sigma);
    double sum = 0;
    for (std::size_t i = 0; i < 6; ++i) sum += form.E[i] * eps[i] + form.S[i] * sigma[i];
    return sum;
  }

  /// Water may leave: no excess pore pressure.
  void drained() { set_cell({}); }
  /// The total stress of this component stays as it is while water cannot leave. u goes on from an undrained stage to
  /// the next.
  void set_cell(std::optional<std::size_t> component) {
    u_start_ = component && cell_ ? u() : 0.0;
    cell_ = component;
    if (cell_) cell_start_ = soil_.sigma[static_cast<int>(*cell_)];
  }
  double u() const { return cell_ ? u_start_ + cell_start_ - soil_.sigma[static_cast<int>(*cell_)] : 0.0; }

  /// A straight strain increment to the total strain `target`.
  Step strain(const Sym<double, 6>& target, double dt) {
    const auto deps = target - eps_;
    const auto report = integrate_soil(soil_, {deps, dt});
    eps_ = eps_ + report.reached * deps;
    time_ += report.reached * dt;
    return outcome(report);
  }

  /// The next increments, `count` of `dt` each, share E·dε + S·dσ = b.
  void start_leg(const std::array<LinearForm, 6>& forms, const Six& b, int count, double dt) {
    constraints_.emplace(forms);
    leg_start_ = constraints_->value(eps_, soil_.sigma);
    leg_b_ = Vector6(b.data());
    leg_dt_ = dt;
    count_ = count;
    done_ = 0;
    const Vector6 part = leg_b_ / count;
    last_ = stable_start(part).value_or(last_);
  }

  Step next_increment() {
    // What is left to the value wanted at its end: errors of the increments before do not add up.
    const Vector6 wanted = leg_start_ + leg_b_ * ((done_ + 1.0) / count_);
    const Vector6 b = wanted - constraints_->value(eps_, soil_.sigma);
    ++done_;
    return increment(b);
  }

  /// time, eps, sigma, p, q, theta, eps_v, eps_q, u, derived fields, state scalars, state tensors.
  std::vector<double> values() const {
    const auto s = deviator(soil_.sigma);
    std::vector<double> all{time_};
    add(all, eps_);
    add(all, soil_.sigma);
    for (double x : {mean(soil_.sigma), deviatoric_stress(soil_.sigma), std::acos(cos_3_lode(s)) / 3, trace(eps_),
                     deviatoric_strain(eps_), u()})
      all.push_back(x);
    for (double x : model_.derived(soil_)) all.push_back(x);
    std::vector<double> state;  // sigma, and the fields of the description in its order
    for_each_component([&](const double& x) { state.push_back(x); }, soil_);
    for (const FieldKind wanted : {FieldKind::scalar, FieldKind::tensor}) {
      std::size_t at = 6;
      for (const FieldKind kind : fields_) {
        if (kind == wanted && kind == FieldKind::scalar) all.push_back(state[at]);
        if (kind == wanted && kind == FieldKind::tensor) {
          Sym<double, 6> tensor;
          std::copy_n(state.begin() + static_cast<std::ptrdiff_t>(at), 6, tensor.c.begin());
          add(all, tensor);
        }
        at += kind == FieldKind::tensor ? 6 : 1;
      }
    }
    return all;
  }

 private:
  static void add(std::vector<double>& all, const Sym<double, 6>& tensor) {
    for (double x : from_mandel(tensor)) all.push_back(x);
  }

  IntegrationReport integrate_soil(Soil& soil, const Increment<double, 6>& step) const {
    return scheme_ == Scheme::dormand_prince ? integrate<DormandPrince>(model_, soil, step, settings_)
                                             : integrate<ModifiedEuler>(model_, soil, step, settings_);
  }

  /// Where to look for a strain rate: the last one, its reverse, none, and single components.
  std::vector<Sym<double, 6>> guesses() const {
    std::vector<Sym<double, 6>> all{last_, -1.0 * last_, Sym<double, 6>::zero()};
    for (int i = 0; i < 6; ++i) {
      for (double sense : {1e-4, -1e-4}) {
        auto unit = Sym<double, 6>::zero();
        unit[i] = sense;
        all.push_back(unit);
      }
    }
    return all;
  }

  /// The strain that a leg starts with. Softening soil can answer a falling stress by unloading and by failing further:
  /// it unloads, the answer with the larger second-order work dσ:dε.
  std::optional<Sym<double, 6>> stable_start(const Vector6& b) const {
    std::optional<Sym<double, 6>> best;
    double most = 0;
    for (const auto& guess : guesses()) {
      const Law law(model_, *constraints_, b, leg_dt_, {guess});
      const auto found = law.start(soil_);
      if (!found) continue;
      if (!best || found->work > most * (1 + 1e-6)) {
        best = found->strain;
        most = found->work;
      }
    }
    return best;
  }

  /// Does the soil itself have no answer to some strain, whatever the constraints?
  bool is_unstable(const Law& law, const Soil& soil) const {
    if constexpr (HasUpdate<Model>) {
      return false;  // a law is not accepted with constants that make it so
    } else {
      const auto all = guesses();
      return !std::all_of(all.begin(), all.end(), [&](const auto& d) { return law.soil_rate(soil, d).sound; });
    }
  }

  /// The next increment, to the value b of the constraints.
  Step increment(const Vector6& b) {
    auto places = guesses();
    if (HasUpdate<Model>) places.resize(3);  // the leg's start has looked elsewhere
    const Law law(model_, *constraints_, b, leg_dt_, places);
    typename Law::template State<double, 6> s{soil_, eps_};
    const auto report = scheme_ == Scheme::dormand_prince ? integrate<DormandPrince>(law, s, Share{1.0}, settings_)
                                                          : integrate<ModifiedEuler>(law, s, Share{1.0}, settings_);
    const auto moved = s.eps - eps_;
    soil_ = s.soil;
    eps_ = s.eps;
    time_ += report.reached * leg_dt_;
    if (report.end == IntegrationEnd::done) {
      if (norm(moved) > 0) last_ = moved;
      return outcome(report);
    }
    return failed(law, report);
  }

  /// Why the integration of an increment gave up: the soil is unstable, no strain is left that meets the constraints,
  /// or the error. Close to a limit point the strain for the next bit of stress grows without bounds.
  Step failed(const Law& law, IntegrationReport report) const {
    if (HasUpdate<Model> && report.end == IntegrationEnd::unstable) return no_solution(report.reached);
    bool unstable = is_unstable(law, soil_);
    const auto start = law.start(soil_);
    const bool soft =
        start && (norm(start->strain) > 100 * norm(last_) || (!TimeDependent<Model> && start->softness > 1000));
    bool limit = !start || soft;
    if constexpr (!HasUpdate<Model>) {  // or just ahead, as where plastic straining sets in?
      if (!unstable && !limit) {
        const auto ahead = advanced(soil_, 1e-6, law.soil_rate(soil_, start->strain).change);
        unstable = is_unstable(law, ahead);
        limit = !law.start(ahead);
      }
    }
    if (!unstable && limit) return no_solution(report.reached);
    if (unstable) report.end = IntegrationEnd::unstable;
    return outcome(report);
  }

  Step no_solution(double reached) const {
    bool stress = false;  // is one driven?
    for (int row = 0; row < 6; ++row) stress = stress || (leg_b_[row] != 0 && !constraints_->S.row(row).isZero(0));
    return {0, reached, "no strain meets the constraints, the soil has come to a limit point",
            stress ? "a stress that the soil cannot carry cannot be prescribed: prescribe a strain there"
                   : "at the stresses held the soil fails faster than it is strained: hold strains in their place"};
  }

  static Step outcome(const IntegrationReport& report) {
    Step step{report.substeps, report.reached, "", ""};
    switch (report.end) {
      case IntegrationEnd::done:
        break;
      case IntegrationEnd::not_converged:
        step.problem = "the error stays above the tolerance at the smallest substep";
        step.remedy = "enlarge tolerance, or take more increments";
        break;
      case IntegrationEnd::unstable:
        step.problem = "the soil is unstable, it softens faster than it can be strained (N:D:G + H <= 0)";
        step.remedy = "this is a property of the soil; slower softening or a stiffer elastic law avoid it";
        break;
      case IntegrationEnd::inadmissible:
        step.problem = "the state is inadmissible";
        step.remedy = "look at the last rows of the curve";
        break;
    }
    return step;
  }

  const Model& model_;
  IntegrationSettings settings_;
  Scheme scheme_;
  std::vector<FieldKind> fields_;  ///< of the state
  Soil soil_;
  Sym<double, 6> eps_ = Sym<double, 6>::zero();
  double time_ = 0;
  std::optional<std::size_t> cell_;
  double cell_start_ = 0, u_start_ = 0;
  std::optional<ConstraintMatrices> constraints_;
  Vector6 leg_start_ = Vector6::Zero(), leg_b_ = Vector6::Zero();
  double leg_dt_ = 0;
  int count_ = 1, done_ = 0;
  Sym<double, 6> last_ = Sym<double, 6>::zero();  ///< strain of the last increment
};

}  // namespace scarp::lab
