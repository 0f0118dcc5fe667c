// Materials and regions of a case.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <filesystem>

#include "scarp/base/log.hpp"
#include "scarp/base/words.hpp"
#include "scarp/input/elsewhere.hpp"
#include "scarp/input/readers.hpp"
#include "scarp/material/nonlocal.hpp"

namespace scarp::input {
namespace {

[[noreturn]] void refuse(const Problem& problem, const std::map<std::string, Position>& places, const Position& table) {
  const auto found = places.find(problem.key);
  throw InputError(problem.what, problem.value, problem.remedy, found == places.end() ? table : found->second);
}

std::string capitals(std::string text) {
  for (char& c : text) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return text;
}

/// The description of the model called `name`; empty where there is none.
ModelDescription description_of_kind(const std::string& name) {
  static const auto all = model_descriptions();
  for (const auto& description : all) {
    if (description.name == name) return description;
  }
  return {};
}

/// One value of a region's initial state: a number, a word or a list of numbers.
Value value_of(const Node& node, const std::string& key) {
  if (const auto* number = std::get_if<double>(&node.value))
    return number_in({node.position, *number}, key, any_number);
  if (const auto* text = std::get_if<std::string>(&node.value)) return *text;
  if (node.is_list()) return numbers_in(node, key, 0);
  throw InputError(fmt::format("{} is a number, a text or a list of numbers", key), describe(node),
                   "see `scarp models` for what it takes", node.position);
}

/// A setting of a model, of any kind that a file can hold; the model says whether it is the right one.
Value setting_of(const Node& node, const std::string& key, SettingKind kind) {
  const auto* list = std::get_if<List>(&node.value);
  if (!list || kind != SettingKind::records) return value_of(node, key);
  std::vector<Record> records;
  for (const auto& item : *list) {
    Table table(item, "a table of " + key);
    Record record;
    for (const auto& [name, value] : table.rest()) record.keys[name] = value_of(*value, name);
    records.push_back(std::move(record));
  }
  return records;
}

/// Names of files are relative to the folder of `file`; a material's own name stands in where a model asks for one.
void complete_settings(Values& settings, const ModelDescription& model, Table& table, const std::string& file) {
  for (const auto& info : model.settings) {
    const Node* name = table.find("name");
    if (info.key == "cmname" && name && !settings.contains(info.key))
      settings[info.key] = capitals(text_in(*name, "name")).substr(0, 80);
    if (info.key != "library" || !settings.contains(info.key)) continue;
    if (auto* path = std::get_if<std::string>(&settings[info.key]))
      *path = (std::filesystem::path(file).parent_path() / *path).string();
  }
}

}  // namespace

Values read_initial(Table& table, const AnyModel& model, std::map<std::string, Position>& places) {
  const auto description = description_of(model);
  Values values;
  std::set<std::string> known;
  for (const auto& info : description.initial) known.insert(info.key);
  for (const auto& [key, item] : table.rest()) {
    if (!known.contains(key)) {
      const auto like = nearest(key, known);
      throw InputError(fmt::format("the model {} has no initial value {}", description.name, key), describe(*item),
                       known.empty()             ? "leave initial out: this model has no state of its own"
                       : !elsewhere(key).empty() ? fmt::format("{} is a key of {}", key, elsewhere(key))
                       : like                    ? fmt::format("did you mean {}?", *like)
                                                 : fmt::format("its initial values are {}", fmt::join(known, ", ")),
                       item->position);
    }
    places[key] = item->position;
    values[key] = value_of(*item, key);
  }
  return values;
}

namespace {

bool has_constant(const ModelDescription& model, const std::string& key) {
  return std::any_of(model.parameters.begin(), model.parameters.end(),
                     [&](const auto& info) { return info.key == key; });
}

/// A key in a material that another table, or another model, has.
void refuse_misplaced(const ModelDescription& model, const std::string& key, const Node& node) {
  const auto is_key = [&](const auto& info) { return info.key == key; };
  if (model.name.empty() || std::any_of(model.parameters.begin(), model.parameters.end(), is_key) ||
      std::any_of(model.settings.begin(), model.settings.end(), is_key))
    return;
  const auto other = elsewhere(key);
  if (other.empty()) return;
  throw InputError(fmt::format("the model {} has no constant {}", model.name, key), describe(node),
                   fmt::format("{} is a key of {}; `scarp models {}` lists its constants", key, other, model.name),
                   node.position);
}

}  // namespace

AnyModel read_law(Table& table, const std::string& file) {
  const Node& model = table.need("model", "add model = \"subloading\", for instance; `scarp models` lists them");
  const std::string model_name = text_in(model, "model");
  const auto description = description_of_kind(model_name);
  std::map<std::string, double> values;
  Values settings;
  std::map<std::string, Position> places{{"model", model.position}};
  for (const auto& [key, item] : table.rest()) {
    refuse_misplaced(description, key, *item);
    places[key] = item->position;
    const auto setting = std::find_if(description.settings.begin(), description.settings.end(),
                                      [&key = key](const auto& info) { return info.key == key; });
    if (setting != description.settings.end()) {
      settings[key] = setting_of(*item, key, setting->kind);
      continue;
    }
    // Its bounds are the model's; make_model() checks that it is finite, too.
    const auto* number = std::get_if<double>(&item->value);
    if (!number && !description.name.empty() && !has_constant(description, key))
      throw InputError(fmt::format("the model {} has no constant {}", model_name, key), describe(*item),
                       fmt::format("`scarp models {}` lists its constants", model_name), item->position);
    if (!number)
      throw InputError(fmt::format("{} is a number", key), describe(*item), "write a number, without quotes",
                       item->position);
    values[key] = *number;
  }
  complete_settings(settings, description, table, file);
  auto result = make_model(model_name, values, settings);
  if (!result.problems.empty()) refuse(result.problems.front(), places, table.position());
  for (const auto& warning : result.warnings) {
    const auto found = places.find(warning.key);
    logging::warn(InputError(warning.what, warning.value, warning.remedy,
                             found == places.end() ? table.position() : found->second)
                      .what());
  }
  return *result.model;
}

namespace {

/// The length over which a material softens, for laws that have something to lose with plastic strain.
void read_length(const Node& node, MaterialInput& material) {
  material.length = number_in(node, "length", not_negative);
  material.length_position = node.position;
  if (material.length == 0 || kappa_c_of(material.model) > 0) return;
  const bool can = std::visit([]<class Law>(const Law&) { return Averaged<Law>; }, material.model);
  const auto name = description_of(material.model).name;
  throw InputError(
      can ? fmt::format(
                "the model {} softens over a length only where it softens, and these constants leave nothing to", name)
          : fmt::format("the model {} has no softening that could have a length", name),
      fmt::format("length = {:g}", material.length),
      can ? "give it bonds to lose (c_b > 0) or residual strengths, or leave length out" : "leave length out",
      node.position);
}

}  // namespace

MaterialInput read_material(const Node& node, const std::string& case_path) {
  Table table(node, "[[material]]");
  std::string name = table.text("name", "add name = \"clay\", for instance");
  const double density = table.number("density", positive, "add the density of the soil, such as density = 1.8");
  const Node* length = table.find("length");
  MaterialInput material{std::move(name), read_law(table, case_path), density, node.position, 0, {}};
  if (length) read_length(*length, material);
  return material;
}

namespace {

/// Index of the material that a region names.
std::size_t find_material(const Node& material, const std::vector<MaterialInput>& materials) {
  const std::string wanted = text_in(material, "material");
  std::vector<std::string> names;
  for (std::size_t m = 0; m < materials.size(); ++m) {
    if (materials[m].name == wanted) return m;
    names.push_back('"' + materials[m].name + '"');
  }
  throw InputError("there is no such material", '"' + wanted + '"',
                   fmt::format("choose one of {}", fmt::join(names, ", ")), material.position);
}

template <int Dim>
void read_stress(Table& table, RegionInputOf<Dim>& region) {
  const Node* K0 = table.find("K0");
  const Node* stress = table.find("stress");
  if ((K0 != nullptr) == (stress != nullptr)) {
    throw InputError("a region has either K0, for stresses from the weight of the soil, or a uniform stress",
                     K0 ? "both" : "neither",
                     fmt::format("write K0 = 0.6, K0 = \"model\" or stress = [{}]",
                                 Dim == 2 ? "0.0, 0.0, 0.0, 0.0" : "0.0, 0.0, 0.0, 0.0, 0.0, 0.0"),
                     table.position());
  }
  if (stress) {
    const auto numbers = numbers_of<Dim>(*stress, "stress", 4, 6);
    region.stress.emplace();
    std::copy(numbers.begin(), numbers.end(), region.stress->begin());
  } else if (std::holds_alternative<std::string>(K0->value)) {
    if (std::get<std::string>(K0->value) != "model")
      throw InputError("K0 is a number or \"model\"", describe(*K0), "write K0 = 0.6 or K0 = \"model\"", K0->position);
  } else {
    region.K0 = number_in(*K0, "K0", not_negative);
  }
}

}  // namespace

template <int Dim>
RegionInputOf<Dim> read_region(const Node& node, const std::vector<MaterialInput>& materials,
                               const std::string& case_path) {
  Table table(node, "[[region]]");
  RegionInputOf<Dim> region;
  region.position = node.position;
  region.name = table.text("name", "add name = \"slope\", for instance");
  region.material =
      find_material(table.need("material", "add material = \"...\", the name of a [[material]]"), materials);
  static_cast<Place<Dim>&>(region) = read_place<Dim>(table, "the region", case_path);
  region.spacing =
      table.number("spacing", positive, "add the distance between material points, such as spacing = 0.25");
  if (const Node* velocity = table.find("velocity")) region.velocity = vector_in<Dim>(*velocity, "velocity");
  read_stress(table, region);
  if (const Node* initial = table.find("initial")) {
    Table keys(*initial, "initial");
    std::map<std::string, Position> places;
    region.initial = read_initial(keys, materials[region.material].model, places);
  }
  table.finish();
  return region;
}

template RegionInputOf<2> read_region<2>(const Node&, const std::vector<MaterialInput>&, const std::string&);
template RegionInputOf<3> read_region<3>(const Node&, const std::vector<MaterialInput>&, const std::string&);

}  // namespace scarp::input
