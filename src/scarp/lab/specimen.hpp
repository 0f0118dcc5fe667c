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
    if constexpr (HasUpdate<Model>) {
      return whole_increment(b);
    } else {
      return along_rates(b);
    }
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
    if constexpr (!HasUpdate<Model>) {
      double most = 0;
      for (const auto& guess : guesses()) {
        const Law law(model_, *constraints_, b, leg_dt_, {guess});
        const auto found = law.strain(soil_);
        if (!found) continue;
        const double size2 = std::max(dot(*found, *found), 1e-300);
        const double work = dot(law.soil_rate(soil_, *found).change.sigma, *found) / size2;
        if (!best || work > most * (1 + 1e-6)) {
          best = found;
          most = work;
        }
      }
    }
    return best;
  }

  /// Does the soil itself have no answer to some strain, whatever the constraints?
  bool is_unstable(const Law& law) const {
    for (const auto& strain : guesses()) {
      if (!law.soil_rate(soil_, strain).sound) return true;
    }
    return false;
  }

  /// The constraints met at every state along the increment.
  Step along_rates(const Vector6& b) {
    const Law law(model_, *constraints_, b, leg_dt_, guesses());
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
    if (is_unstable(law)) {
      auto unstable = report;
      unstable.end = IntegrationEnd::unstable;
      return outcome(unstable);
    }
    const auto strain = law.strain(soil_);
    // Close to a limit point the strain for the next bit of stress grows without bounds.
    if (!strain || norm(*strain) > 100 * norm(last_)) return no_solution(report.reached);
    return outcome(report);
  }

  /// A law with an update of its own: the constraints met at the end of the increment, along a straight strain.
  Step whole_increment(const Vector6& b) {
    Vector6 d = as_vector(last_);
    for (int i = 0; i < 60; ++i) {
      Soil end = soil_;
      const auto report = integrate_soil(end, {as_sym(d), leg_dt_});
      if (report.end != IntegrationEnd::done) break;
      const Vector6 dsigma = as_vector(end.sigma - soil_.sigma);
      const Vector6 residual = constraints_->E * d + constraints_->S * dsigma - b;
      if (!residual.allFinite()) break;
      if (is_met(residual, d, dsigma, b)) {
        soil_ = end;
        eps_ = eps_ + as_sym(d);
        time_ += leg_dt_;
        last_ = as_sym(d);
        return outcome(report);
      }
      d -= solve_scaled(constraints_->E + constraints_->S * secant(d, dsigma), residual);
    }
    return no_solution(0);
  }

  /// To the tolerance of the integration, beside the whole stress where the increment is small.
  bool is_met(const Vector6& residual, const Vector6& d, const Vector6& dsigma, const Vector6& b) const {
    const Vector6 size = constraints_->E.rowwise().norm() * (d.norm() + 1e-12) +
                         constraints_->S.rowwise().norm() * (dsigma.norm() + 1e-6 * norm(soil_.sigma)) + b.cwiseAbs();
    return ((residual.cwiseAbs() - std::min(1e-8, settings_.tolerance) * size).array() <= 0).all();
  }

  Matrix6 secant(const Vector6& d, const Vector6& dsigma) const {
    const double h = std::max(1e-5 * d.norm(), 1e-9);
    Matrix6 D;
    for (int i = 0; i < 6; ++i) {
      Vector6 moved = d;
      moved[i] += h;
      Soil end = soil_;
      integrate_soil(end, {as_sym(moved), leg_dt_});
      D.col(i) = (as_vector(end.sigma - soil_.sigma) - dsigma) / h;
    }
    return D;
  }

  static Step no_solution(double reached) {
    return {0, reached, "no strain meets the constraints, the soil has come to a limit point",
            "a stress that the soil cannot carry cannot be prescribed: prescribe a strain there"};
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
