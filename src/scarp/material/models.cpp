#include "scarp/material/models.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <cmath>
#include <set>
#include <type_traits>
#include <utility>

#include "scarp/base/words.hpp"

namespace scarp {
namespace {

/// f(std::type_identity<Model>) for each model of the list.
template <class F>
void for_each_model(F&& f) {
  [&]<class... Models>(std::type_identity<std::variant<Models...>>) {
    (f(std::type_identity<Models>{}), ...);
  }(std::type_identity<AnyModel>{});
}

std::string bounds_text(const ParameterInfo& info) {
  std::string text;
  if (info.low) text += fmt::format("{} {} ", info.low->value, info.low->open ? "<" : "<=");
  text += info.key;
  if (info.high) text += fmt::format(" {} {}", info.high->open ? "<" : "<=", info.high->value);
  return text;
}

/// What to choose: "0 <= nu < 0.5", or "a finite number" where all of them will do.
std::string range_remedy(const ParameterInfo& info) {
  return info.low || info.high ? "a number with " + bounds_text(info) : "a finite number";
}

/// "did you mean ...? ", or nothing.
std::string meant(const std::string& word, const std::set<std::string>& known) {
  const auto like = nearest(word, known);
  return like ? fmt::format("did you mean {}? ", *like) : "";
}

/// A value as messages show it.
std::string text_of(const Value& value) {
  if (const auto* number = std::get_if<double>(&value)) return fmt::format("the number {}", *number);
  if (const auto* text = std::get_if<std::string>(&value)) return fmt::format("the text \"{}\"", *text);
  return std::holds_alternative<std::vector<double>>(value) ? "a list of numbers" : "a list of tables";
}

bool within(const ParameterInfo& info, double x) {
  if (!std::isfinite(x)) return false;
  if (info.low && (x < info.low->value || (info.low->open && x == info.low->value))) return false;
  return !(info.high && (x > info.high->value || (info.high->open && x == info.high->value)));
}

/// All keys that a material of this model may have.
std::set<std::string> keys_of(const ModelDescription& model) {
  std::set<std::string> keys{"name", "model", "density", "length"};
  for (const auto& info : model.parameters) keys.insert(info.key);
  for (const auto& info : model.settings) keys.insert(info.key);
  return keys;
}

/// The constants in full, standard values filled in; what is missing, unknown or out of bounds becomes a problem.
std::map<std::string, double> checked(const ModelDescription& model, const std::map<std::string, double>& values,
                                      std::vector<Problem>& problems) {
  std::map<std::string, double> full;
  for (const auto& info : model.parameters) {
    const auto found = values.find(info.key);
    if (found == values.end()) {
      if (!info.standard_key.empty()) continue;
      if (!info.standard) {
        problems.push_back(
            {info.key,
             fmt::format("the constant {} ({}) of the model {} is missing", info.key, info.meaning, model.name), "",
             fmt::format("add {} = ..., with {}", info.key, bounds_text(info))});
      } else {
        full[info.key] = *info.standard;
      }
      continue;
    }
    if (!within(info, found->second)) {
      const bool finite = std::isfinite(found->second);
      problems.push_back(
          {info.key, finite ? fmt::format("{} must satisfy {}", info.key, bounds_text(info)) : info.key + " is finite",
           fmt::format("{}", found->second),
           fmt::format("choose {} ({}: {})", range_remedy(info), info.symbol, info.meaning)});
    }
    full[info.key] = found->second;
  }
  for (const auto& info : model.parameters) {
    const auto other = full.find(info.standard_key);
    if (!full.contains(info.key) && other != full.end()) full[info.key] = other->second;
  }
  for (const auto& [key, value] : values) {
    bool known = false;
    for (const auto& info : model.parameters) known = known || info.key == key;
    if (!known) {
      problems.push_back(
          {key, fmt::format("the model {} has no constant {}", model.name, key), fmt::format("{}", value),
           fmt::format("{}`scarp models {}` lists its constants", meant(key, keys_of(model)), model.name)});
    }
  }
  return full;
}

/// Settings that are missing, unknown or of another kind become problems.
void check_settings(const ModelDescription& model, const Values& settings, std::vector<Problem>& problems) {
  for (const auto& info : model.settings) {
    const auto found = settings.find(info.key);
    const auto wanted = static_cast<std::size_t>(info.kind);
    if (found == settings.end()) {
      if (info.required) {
        problems.push_back(
            {info.key, fmt::format("the key {} ({}) of the model {} is missing", info.key, info.meaning, model.name),
             "", fmt::format("add {} = ..., a {}", info.key, info.takes)});
      }
    } else if (found->second.index() != wanted) {
      problems.push_back({info.key, fmt::format("{} is a {}", info.key, info.takes), text_of(found->second),
                          fmt::format("{}: {}", info.key, info.meaning)});
    }
  }
  for (const auto& [key, value] : settings) {
    const auto is_key = [&key = key](const auto& info) { return info.key == key; };
    if (std::any_of(model.settings.begin(), model.settings.end(), is_key)) continue;
    const bool number = std::any_of(model.parameters.begin(), model.parameters.end(), is_key);
    problems.push_back(
        {key, number ? fmt::format("{} is a number", key) : fmt::format("the model {} has no key {}", model.name, key),
         text_of(value),
         fmt::format("{}`scarp models {}` lists its keys", number ? "" : meant(key, keys_of(model)), model.name)});
  }
}

/// Takes out the numbers that stand where the model has a setting of another kind.
void refuse_numbers(const ModelDescription& model, std::map<std::string, double>& values,
                    std::vector<Problem>& problems) {
  for (const auto& info : model.settings) {
    const auto found = values.find(info.key);
    if (found == values.end()) continue;
    problems.push_back({info.key, fmt::format("{} is a {}", info.key, info.takes), text_of(found->second),
                        fmt::format("{}: {}", info.key, info.meaning)});
    values.erase(found);
  }
}

}  // namespace

ModelDescription description_of(const AnyModel& any) {
  return std::visit([](const auto& model) { return description_of(model); }, any);
}

std::vector<ModelDescription> model_descriptions() {
  std::vector<ModelDescription> all;
  for_each_model([&](auto model) { all.push_back(decltype(model)::type::description()); });
  return all;
}

ModelResult make_model(const std::string& name, const std::map<std::string, double>& values, const Values& settings) {
  ModelResult result;
  std::vector<std::string> names;
  bool known = false;
  for_each_model([&](auto model) {
    using Model = typename decltype(model)::type;
    static const auto description = Model::description();
    names.push_back(description.name);
    if (description.name != name) return;
    known = true;
    auto numbers = values;
    refuse_numbers(description, numbers, result.problems);
    const auto full = checked(description, numbers, result.problems);
    check_settings(description, settings, result.problems);
    if (!result.problems.empty()) return;
    std::optional<Model> made;
    if constexpr (requires { Model::from_values(full, settings, result.problems, result.warnings); }) {
      made = Model::from_values(full, settings, result.problems, result.warnings);
    } else {
      made = Model::from_values(full, result.problems, result.warnings);
    }
    if (result.problems.empty()) result.model = std::move(*made);
  });
  if (!known) {
    result.problems.push_back(
        {"model", "there is no such model", '"' + name + '"',
         fmt::format("{}choose one of {}", meant(name, {names.begin(), names.end()}), fmt::join(names, ", "))});
  }
  return result;
}

}  // namespace scarp
