#include "scarp/input/lab_test.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Dense>
#include <algorithm>
#include <filesystem>

#include "scarp/input/csv.hpp"
#include "scarp/input/readers.hpp"
#include "scarp/lab/driver.hpp"
#include "scarp/lab/named_tests.hpp"
#include "scarp/material/increment.hpp"

namespace scarp::input {
namespace {

/// What the readers of the stages share.
struct Context {
  std::string path;
  bool time_dependent;
  std::vector<std::string> columns;  ///< of the curve
  std::vector<std::string> files;
};

lab::Six six_in(const Node& node, const std::string& name) {
  const auto numbers = numbers_in(node, name, 6);
  lab::Six six;
  std::copy(numbers.begin(), numbers.end(), six.begin());
  return six;
}

lab::StrainPath read_strain_path(Table& table, Context& context) {
  const Node& node =
      table.need("file", "add file = \"strains.csv\", columns eps_xx,eps_yy,eps_zz,eps_xy,eps_yz,eps_zx");
  const std::filesystem::path name = text_in(node, "file");
  const auto path = (name.is_absolute() ? name : std::filesystem::path(context.path).parent_path() / name).string();
  std::error_code none;
  if (!std::filesystem::is_regular_file(path, none))
    throw InputError("the file of strains is not there", path, "names are relative to the test file's folder",
                     node.position);
  context.files.push_back(path);
  std::vector<std::string> names;
  for (const char* component : lab::component_names) names.push_back(std::string("eps_") + component);
  lab::StrainPath strains;
  for (const auto& row : read_columns(path, names)) {
    lab::Six six;
    std::copy(row.begin(), row.end(), six.begin());
    strains.strains.push_back(six);
  }
  return strains;
}

const List& six_rows(Table& table, const std::string& key) {
  const Node& node = table.need(key, "E and S are 6 rows of 6 numbers, b 6 numbers: E·dε + S·dσ = b over the stage");
  const auto* rows = std::get_if<List>(&node.value);
  if (!rows || rows->size() != 6)
    throw InputError(
        fmt::format("{} has 6 rows of 6 numbers", key), rows ? fmt::format("{} rows", rows->size()) : describe(node),
        "one row for each constraint; components xx, yy, zz, xy, yz, zx, tensor shear once", node.position);
  return *rows;
}

lab::Constraints read_constraints(Table& table) {
  lab::Constraints constraints;
  const List& E = six_rows(table, "E");
  const List& S = six_rows(table, "S");
  Eigen::Matrix<double, 6, 12> all;
  for (std::size_t row = 0; row < 6; ++row) {
    auto& form = constraints.forms[row];
    form = {six_in(E[row], "a row of E"), six_in(S[row], "a row of S")};
    for (std::size_t i = 0; i < 6; ++i) {
      all(static_cast<int>(row), static_cast<int>(i)) = form.E[i];
      all(static_cast<int>(row), static_cast<int>(i) + 6) = form.S[i];
    }
    const double size = all.row(static_cast<int>(row)).norm();
    if (size == 0)
      throw InputError("each constraint says something", fmt::format("row {} of E and S is zero", row + 1),
                       "give it a strain or a stress", E[row].position);
    all.row(static_cast<int>(row)) /= size;
  }
  constraints.b = six_in(table.need("b", "add b = [6 numbers], the changes over the stage"), "b");
  if (Eigen::FullPivLU<Eigen::Matrix<double, 6, 12>>(all).rank() < 6)
    throw InputError("the six constraints are independent of each other", "one follows from the others",
                     "replace it by one on another component", table.position());
  return constraints;
}

/// One number, or two with cycles.
std::vector<double> read_targets(const Node& node, const std::string& key, int cycles) {
  if (!node.is_list()) {
    if (cycles > 0)
      throw InputError(fmt::format("with cycles, {} has its two limits", key), describe(node),
                       fmt::format("write {} = [0.01, -0.01], for instance", key), node.position);
    return {number_in(node, key, any_number)};
  }
  const auto limits = numbers_in(node, key, 2);
  if (cycles == 0)
    throw InputError(fmt::format("two limits of {} make a cyclic test", key), "no cycles",
                     "add cycles = 10, for instance, or give one number", node.position);
  std::vector<double> targets;
  for (int i = 0; i < cycles; ++i) targets.insert(targets.end(), limits.begin(), limits.end());
  return targets;
}

lab::Constraints read_named(Table& table, const lab::NamedTest& test) {
  lab::Constraints constraints;
  constraints.cell = test.cell;
  std::copy(test.held.begin(), test.held.end(), constraints.forms.begin());
  if (test.drives.empty()) return constraints;
  std::vector<std::string> keys;
  const lab::Drive* chosen = nullptr;
  const Node* value = nullptr;
  for (const auto& drive : test.drives) {
    keys.push_back(drive.key);
    if (const Node* node = table.find(drive.key)) {
      if (chosen)
        throw InputError(fmt::format("one quantity drives the test {}", test.type),
                         fmt::format("{} and {}", chosen->key, drive.key), "remove one of them", node->position);
      chosen = &drive;
      value = node;
    }
  }
  if (!chosen)
    throw InputError(fmt::format("the test {} needs what drives it", test.type), "",
                     fmt::format("give one of {}", fmt::join(keys, ", ")), table.position());
  constraints.forms[5] = chosen->form;
  constraints.from_start = chosen->strain;
  const int cycles = table.whole_or("cycles", 1, 1000000, 0);
  constraints.targets = read_targets(*value, chosen->key, cycles);
  return constraints;
}

const lab::NamedTest& named(const Node& type, Table& table) {
  std::string name = text_in(type, "type");
  if (name == "simple-shear") name += table.truth_or("drained", true) ? "-drained" : "-undrained";
  std::vector<std::string> known{"strain-path", "constraints"};
  for (const auto& test : lab::named_tests()) {
    if (test.type == name) return test;
    known.push_back(test.type);
  }
  throw InputError("there is no such type of stage", describe(type),
                   fmt::format("choose one of {}", fmt::join(known, ", ")), type.position);
}

std::vector<lab::Stop> read_stops(Table& table, const Context& context) {
  std::vector<lab::Stop> stops;
  const Node* node = table.find("stop");
  if (!node) return stops;
  Table conditions(*node, "stop");
  for (const auto& [column, value] : conditions.rest()) {
    if (std::find(context.columns.begin(), context.columns.end(), column) == context.columns.end())
      throw InputError("a stop condition names a column of the curve", column,
                       fmt::format("choose one of {}", fmt::join(context.columns, ", ")), value->position);
    stops.push_back({column, number_in(*value, column, any_number)});
  }
  return stops;
}

lab::Stage read_lab_stage(const Node& node, Context& context) {
  Table table(node, "[[stage]]");
  const Node& type = table.need("type", "add type = \"triaxial-undrained\", for instance");
  lab::Stage stage;
  stage.type = text_in(type, "type");
  table.find("name");  // for the reader of the file
  if (stage.type == "strain-path") {
    stage.path = read_strain_path(table, context);
  } else {
    stage.path = stage.type == "constraints" ? read_constraints(table) : read_named(table, named(type, table));
    stage.increments = table.whole_or("increments", 1, 10000000, 100);
  }
  const Node* duration = table.find("duration");
  if (duration) stage.duration = number_in(*duration, "duration", positive);
  if (!duration && context.time_dependent)
    throw InputError("the model depends on time: each stage has a duration", "none", "add duration = 3600.0 [s]",
                     node.position);
  stage.stops = read_stops(table, context);
  table.finish();
  return stage;
}

void read_integration(Table& table, lab::Test& test) {
  const Node* node = table.find("integration");
  if (!node) return;
  Table integration(*node, "[integration]");
  test.tolerance = integration.number_or("tolerance", {1e-13, 0.1}, test.tolerance);
  if (const Node* scheme = integration.find("scheme")) {
    const auto word = text_in(*scheme, "scheme");
    if (word != "dormand-prince" && word != "modified-euler")
      throw InputError("scheme is \"dormand-prince\" or \"modified-euler\"", describe(*scheme),
                       "dormand-prince is the better one for small tolerances", scheme->position);
    test.scheme = word == "dormand-prince" ? lab::Scheme::dormand_prince : lab::Scheme::modified_euler;
  }
  integration.finish();
}

/// Stress and initial values; refuses what the model cannot start from, at the key that is to blame.
void read_initial_state(const Node& node, lab::Test& test) {
  Table table(node, "[initial]");
  const Node& stress = table.need("stress", "add stress = [xx, yy, zz, xy, yz, zx], compression positive");
  test.stress = six_in(stress, "stress");
  std::map<std::string, Position> places;
  test.initial = read_initial(table, test.model, places);
  const auto problems = lab::initial_problems(test);
  if (problems.empty()) return;
  const auto& problem = problems.front();
  const auto found = places.find(problem.key);
  throw InputError(problem.what, problem.value, problem.remedy, found == places.end() ? node.position : found->second);
}

}  // namespace

LabTest read_lab_test(const std::string& path, const std::vector<std::string>& overrides) {
  return parse_lab_test(path, read_text(path), overrides);
}

LabTest parse_lab_test(const std::string& path, const std::string& text, const std::vector<std::string>& overrides) {
  Node document = parse_text(text, path);
  for (const auto& change : overrides) apply_override(document, change);
  document.position = {path, 0, 0};
  Table table(document, "the test");
  const std::string title = table.text_or("title", path);
  Table material(table.need("material", "add [material] with model and its constants"), "[material]");
  material.find("name");
  lab::Test test{read_law(material, path), {}, {}, lab::Scheme::dormand_prince, 1e-7, {}};
  material.finish();
  read_initial_state(table.need("initial", "add [initial] with stress = [...]"), test);
  read_integration(table, test);
  const bool time_dependent = std::visit([]<class Model>(const Model&) { return TimeDependent<Model>; }, test.model);
  Context context{path, time_dependent, lab::curve_columns(test.model), {path}};
  const Node& stages = table.need("stage", "add [[stage]] with a type");
  const auto* list = std::get_if<List>(&stages.value);
  if (!list || list->empty())
    throw InputError("stage is an array of tables", describe(stages), "write [[stage]] with double brackets",
                     stages.position);
  for (const auto& node : *list) test.stages.push_back(read_lab_stage(node, context));
  table.finish();
  return {title, std::move(test), std::move(context.files)};
}

}  // namespace scarp::input
