#include "scarp/input/elsewhere.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <map>
#include <vector>

#include "scarp/material/models.hpp"

namespace scarp::input {

std::vector<TableKeys> keys_of_tables() {
  return {
      {"the case itself, above its tables", {"title", "dimension", "axisymmetric", "gravity"}},
      {"[mesh]", {"grid", "file"}},
      {"grid = { ... } in [mesh]", {"origin", "size", "element", "elements"}},
      {"[method]",
       {"scheme", "pic_time", "stress_damping", "stress_damping_time", "shape", "quadrature", "safety", "tolerance",
        "largest_failures", "largest_energy_error", "leaving"}},
      {"[method], and of a [[stage]]", {"flip"}},
      {"checkpoint = { ... } in [output]", {"steps", "time", "keep", "stages"}},
      {"[output]", {"every", "history", "colour", "checkpoint"}},
      {"[start]", {"edited"}},
      {"[[material]]", {"model", "density", "length"}},
      {"[[region]]", {"material", "spacing", "velocity", "K0", "stress", "initial"}},
      {"[[region]], and of remove in a [[stage]]", {"polygon", "stl"}},
      {"[[boundary]]", {"nodes", "line", "fix", "friction", "absorbing"}},
      {"a [[boundary]] with absorbing = true", {"from", "thickness", "impedance"}},
      {"[[stage]]", {"duration", "damping", "release", "zero_displacement", "zero_velocity", "remove", "rest"}},
      {"remove = { ... } in a [[stage]]", {"lifts", "over"}},
      {"rest = { ... } in a [[stage]]", {"unbalanced", "kinetic", "rate", "hold", "required"}},
  };
}

namespace {

using Homes = std::map<std::string, std::string>;

/// The keys of the tables that a case always has; those of the models come from the models.
Homes homes_of_tables() {
  Homes homes;
  for (const auto& [table, keys] : keys_of_tables()) {
    for (const auto& key : keys) homes[key] = table;
  }
  return homes;
}

void add_keys_of_models(Homes& homes) {
  std::map<std::string, std::vector<std::string>> constants, initial;
  for (const auto& model : model_descriptions()) {
    for (const auto& info : model.parameters) constants[info.key].push_back(model.name);
    for (const auto& info : model.settings) constants[info.key].push_back(model.name);
    for (const auto& info : model.initial) initial[info.key].push_back(model.name);
  }
  // What a table has goes before what only some models have.
  for (const auto& [key, models] : initial)
    homes.emplace(key, fmt::format("initial = {{ ... }} in a [[region]] (of {})", fmt::join(models, ", ")));
  for (const auto& [key, models] : constants)
    homes.emplace(key, fmt::format("[[material]] (of {})", fmt::join(models, ", ")));
}

}  // namespace

std::string elsewhere(const std::string& key) {
  static const Homes homes = [] {
    Homes all = homes_of_tables();
    add_keys_of_models(all);
    return all;
  }();
  const auto found = homes.find(key);
  return found == homes.end() ? "" : found->second;
}

}  // namespace scarp::input
