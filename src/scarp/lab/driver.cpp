#include "scarp/lab/driver.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "scarp/base/error.hpp"
#include "scarp/lab/specimen.hpp"

namespace scarp::lab {
namespace {

/// One stage after another on a specimen of one model.
template <class Model>
class Run {
 public:
  Run(const Model& model, const Test& test, const std::function<void(const std::vector<double>&)>& row)
      : specimen_(model, initial(model, test), {test.tolerance, smallest_substep}, test.scheme), row_(row) {
    columns_ = curve_columns(test.model);
  }

  void stage(const Stage& stage, int number) {
    stage_ = &stage;
    number_ = number;
    starts_.clear();
    for (const auto& stop : stage.stops) starts_.push_back(values(0)[column(stop.column)]);
    std::visit([&](const auto& path) { follow(path); }, stage.path);
  }

 private:
  static constexpr double smallest_substep = 1e-11;

  static typename Model::template State<double, 6> initial(const Model& model, const Test& test) {
    std::vector<Problem> problems;
    return model.template initial_state<6>(to_mandel<6>(test.stress), test.stress[2], test.initial, problems);
  }

  void follow(const StrainPath& path) {
    specimen_.drained();
    total_ = static_cast<int>(path.strains.size());
    done_ = 0;
    for (const auto& target : path.strains) {
      if (!finish(specimen_.strain(to_mandel<6>(target), stage_->duration / total_))) return;
    }
  }

  void follow(const Constraints& constraints) {
    specimen_.set_cell(constraints.cell);
    const auto& sixth = constraints.forms[5];
    const double origin = constraints.from_start ? specimen_.value(sixth) : 0.0;
    const int legs = std::max<int>(1, static_cast<int>(constraints.targets.size()));
    total_ = legs * stage_->increments;
    done_ = 0;
    for (int leg = 0; leg < legs; ++leg) {
      Six b = constraints.b;
      if (!constraints.targets.empty()) {
        b[5] = constraints.targets[static_cast<std::size_t>(leg)] + origin - specimen_.value(sixth);
      }
      specimen_.start_leg(constraints.forms, b, stage_->increments, stage_->duration / total_);
      for (int i = 0; i < stage_->increments; ++i) {
        if (!finish(specimen_.next_increment())) return;
      }
    }
  }

  /// Books the increment that has just ended; false where it ends the stage.
  bool finish(const Step& step) {
    if (!step.problem.empty()) fail(step);
    ++done_;
    const auto now = values(step.substeps);
    row_(now);
    for (std::size_t i = 0; i < starts_.size(); ++i) {
      const auto& stop = stage_->stops[i];
      const double value = now[column(stop.column)];
      if ((value - stop.value) * (starts_[i] - stop.value) <= 0) return false;
    }
    return true;
  }

  std::size_t column(const std::string& name) const {
    const auto found = std::find(columns_.begin(), columns_.end(), name);
    if (found == columns_.end()) throw InputError("a curve has no such column", name, "see its header");
    return static_cast<std::size_t>(found - columns_.begin());
  }

  std::vector<double> values(int substeps) const {
    auto all = specimen_.values();
    all.insert(all.begin(), number_);
    all.push_back(substeps);
    return all;
  }

  [[noreturn]] void fail(const Step& step) const {
    const auto& s = specimen_.soil();
    throw RunError(fmt::format("stage {} ({}) stops in increment {} of {}, at {:.3g} of it: {}", number_, stage_->type,
                               done_ + 1, total_, step.reached, step.problem),
                   fmt::format("p = {:.6g}, q = {:.6g}, eps_v = {:.4g}, eps_q = {:.4g}", mean(s.sigma),
                               deviatoric_stress(s.sigma), trace(specimen_.eps()), deviatoric_strain(specimen_.eps())),
                   step.remedy);
  }

  Specimen<Model> specimen_;
  const std::function<void(const std::vector<double>&)>& row_;
  std::vector<std::string> columns_;
  const Stage* stage_ = nullptr;
  int number_ = 0, done_ = 0, total_ = 0;
  std::vector<double> starts_;  ///< of the columns that stop the stage
};

void add_tensor(std::vector<std::string>& columns, const std::string& key) {
  for (const char* component : component_names) columns.push_back(key + "_" + component);
}

}  // namespace

std::vector<std::string> curve_columns(const AnyModel& model) {
  const auto description = description_of(model);
  std::vector<std::string> columns{"stage", "time"};
  add_tensor(columns, "eps");
  add_tensor(columns, "sig");
  for (const char* name : {"p", "q", "theta", "eps_v", "eps_q", "u"}) columns.push_back(name);
  for (const auto& field : description.derived) columns.push_back(field.key);
  for (const auto& field : description.state) {
    if (field.kind == FieldKind::scalar) columns.push_back(field.key);
  }
  for (const auto& field : description.state) {
    if (field.kind == FieldKind::tensor) add_tensor(columns, field.key);
  }
  columns.push_back("substeps");
  return columns;
}

std::vector<Problem> initial_problems(const Test& test) {
  std::vector<Problem> problems;
  std::visit(
      [&](const auto& model) {
        model.template initial_state<6>(to_mandel<6>(test.stress), test.stress[2], test.initial, problems);
      },
      test.model);
  return problems;
}

void run_test(const Test& test, const std::function<void(const std::vector<double>&)>& row) {
  std::visit(
      [&]<class Model>(const Model& model) {
        Run<Model> run(model, test, row);
        int number = 0;
        for (const auto& stage : test.stages) run.stage(stage, ++number);
      },
      test.model);
}

}  // namespace scarp::lab
