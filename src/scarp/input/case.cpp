#include "scarp/input/case.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <type_traits>
#include <utility>

#include "scarp/base/log.hpp"
#include "scarp/input/readers.hpp"

namespace scarp::input {
namespace {

template <int Dim>
RemovalInputOf<Dim> read_removal(const Node& node, double duration, const std::string& case_path) {
  Table table(node, "remove");
  RemovalInputOf<Dim> removal;
  static_cast<Place<Dim>&>(removal) = read_place<Dim>(table, "remove", case_path);
  removal.lifts = table.whole_or("lifts", 1, 1000000, 1);
  removal.over = table.number_or("over", {0, duration}, 0);
  table.finish();
  return removal;
}

RestInput read_rest(const Node& node) {
  Table table(node, "rest");
  RestInput rest;
  rest.unbalanced = table.number_or("unbalanced", positive, rest.unbalanced);
  rest.kinetic = table.number_or("kinetic", positive, rest.kinetic);
  rest.rate = table.number_or("rate", positive, rest.rate);
  rest.hold = table.number_or("hold", not_negative, rest.hold);
  rest.required = table.truth_or("required", rest.required);
  table.finish();
  return rest;
}

/// The tables of an array such as [[region]]; at least one when `least` says so.
const List& tables(Table& document, const std::string& key, const char* purpose) {
  static const List none;
  const Node* node = document.find(key);
  if (!node) {
    if (!*purpose) return none;
    throw InputError(fmt::format("the case has no [[{}]]", key), "", fmt::format("add at least one: {}", purpose),
                     document.position());
  }
  const auto* list = std::get_if<List>(&node->value);
  if (!list)
    throw InputError(fmt::format("{} is an array of tables", key), describe(*node),
                     fmt::format("write [[{}]] with double brackets", key), node->position);
  if (list->empty() && *purpose) {
    throw InputError(fmt::format("the case has no [[{}]]", key), "an empty list",
                     fmt::format("add at least one: {}", purpose), node->position);
  }
  return *list;
}

template <class Item>
void check_name(const std::vector<Item>& items, const Item& item, const std::string& kind) {
  for (const auto& other : items) {
    if (other.name == item.name) {
      throw InputError(fmt::format("each [[{}]] has a name of its own", kind), fmt::format("\"{}\" twice", item.name),
                       "rename one of them", item.position);
    }
  }
}

template <class Item, class Read>
std::vector<Item> read_all(Table& document, const std::string& key, const char* purpose, Read&& read) {
  std::vector<Item> items;
  for (const auto& node : tables(document, key, purpose)) {
    Item item = read(node);
    if constexpr (requires { item.name; }) check_name(items, item, key);
    items.push_back(std::move(item));
  }
  return items;
}

}  // namespace

template <int Dim>
StageInputOf<Dim> read_stage(const Node& node, const std::string& case_path) {
  Table table(node, "[[stage]]");
  StageInputOf<Dim> stage;
  stage.position = node.position;
  stage.name = table.text("name", "add name = \"at rest\", for instance");
  stage.duration = table.number("duration", positive, "add the time that the stage takes at most, in seconds");
  stage.damping = table.number_or("damping", {0, 1, false, true}, 0);
  if (const Node* flip = table.find("flip")) stage.flip = number_in(*flip, "flip", {0, 1});
  stage.release = table.number_or("release", {0, stage.duration}, 0);
  stage.zero_displacement = table.truth_or("zero_displacement", false);
  stage.zero_velocity = table.truth_or("zero_velocity", false);
  if (const Node* remove = table.find("remove")) stage.remove = read_removal<Dim>(*remove, stage.duration, case_path);
  if (const Node* rest = table.find("rest")) stage.rest = read_rest(*rest);
  table.finish();
  return stage;
}

template StageInputOf<2> read_stage<2>(const Node&, const std::string&);
template StageInputOf<3> read_stage<3>(const Node&, const std::string&);

namespace {

GridFunctions read_shape(const Node& node) {
  const auto word = text_in(node, "shape");
  if (word == "linear") return GridFunctions::linear;
  if (word == "gimp") return GridFunctions::gimp;
  if (word == "b-spline") return GridFunctions::b_spline;
  throw InputError("shape is \"linear\", \"gimp\" or \"b-spline\"", describe(node),
                   "\"linear\" works on every mesh, the others on grids", node.position);
}

/// GIMP and B-splines are products of functions along the axes of a grid.
template <int Dim>
void check_shape(const CaseOf<Dim>& input) {
  if (input.method.shape == GridFunctions::gimp && input.axisymmetric) {
    throw InputError("the points of a body of revolution are rings, not the boxes of GIMP",
                     "shape = \"gimp\" with axisymmetric = true", "choose shape = \"b-spline\" or \"linear\"",
                     input.method.shape_position);
  }
  if (input.method.shape == GridFunctions::linear || input.mesh.grid) return;
  throw InputError("GIMP and B-splines need a mesh that is a grid",
                   fmt::format("shape = \"{}\" on the mesh of a file",
                               input.method.shape == GridFunctions::gimp ? "gimp" : "b-spline"),
                   "give [mesh] a grid, or leave shape out for linear functions", input.method.shape_position);
}

}  // namespace

namespace {

/// The scheme and its constants. A constant that the scheme has no use for is refused; but flip, which cases from
/// before there was a choice have, is no more than ignored (and run says so).
void read_scheme(Table& table, MethodInput& method) {
  if (const Node* scheme = table.find("scheme")) {
    const auto word = text_in(*scheme, "scheme");
    if (word != "two-term" && word != "report" && word != "apic")
      throw InputError("scheme is \"two-term\", \"report\" or \"apic\"", describe(*scheme),
                       "leave it out for \"two-term\", whose results do not depend on the time step", scheme->position);
    method.scheme = word == "two-term" ? SchemeName::two_term : word == "apic" ? SchemeName::apic : SchemeName::report;
  }
  const auto only_with = [&](const char* key, bool right, const char* scheme) {
    const Node* found = table.find(key);
    if (found && !right)
      throw InputError(fmt::format("{} belongs to scheme = {}", key, scheme), describe(*found),
                       fmt::format("leave it out, or choose that scheme"), found->position);
    return found;
  };
  if (const Node* flip = table.find("flip")) {
    method.flip = number_in(*flip, "flip", {0, 1});
    if (method.scheme != SchemeName::report) method.ignored_flip = flip->position;
  }
  if (const Node* time = only_with("pic_time", method.scheme == SchemeName::two_term, "\"two-term\""))
    method.pic_time = number_in(*time, "pic_time", positive);
  const bool damped = method.scheme != SchemeName::report;
  const Node* share = only_with("stress_damping", damped, "\"two-term\" or \"apic\"");
  const Node* time = only_with("stress_damping_time", damped, "\"two-term\" or \"apic\"");
  if (share && time)
    throw InputError("the damping of stress rates is given by stress_damping or by stress_damping_time", "both",
                     "leave one of them out", time->position);
  if (share) method.stress_damping = number_in(*share, "stress_damping", {0, 10});
  if (time) method.stress_damping_time = number_in(*time, "stress_damping_time", positive);
  if (method.scheme == SchemeName::report) method.safety = 0.5;
}

}  // namespace

MethodInput read_method(const Node& node) {
  Table table(node, "[method]");
  MethodInput method;
  read_scheme(table, method);
  if (const Node* shape = table.find("shape")) {
    method.shape = read_shape(*shape);
    method.shape_position = shape->position;
  }
  if (const Node* quadrature = table.find("quadrature")) {
    const auto word = text_in(*quadrature, "quadrature");
    if (word != "corrected" && word != "points")
      throw InputError("quadrature is \"corrected\" or \"points\"", describe(*quadrature),
                       "\"points\" is the report's sum over points, \"corrected\" makes it exact inside the soil",
                       quadrature->position);
    method.corrected_quadrature = word == "corrected";
  }
  method.safety = table.number_or("safety", {0, 1, true, false}, method.safety);
  method.tolerance = table.number_or("tolerance", {1e-12, 0.1}, method.tolerance);
  method.largest_energy_error = table.number_or("largest_energy_error", not_negative, method.largest_energy_error);
  method.largest_failures = table.whole_or("largest_failures", 0, 1000000000, 0);
  if (const Node* leaving = table.find("leaving")) {
    const auto word = text_in(*leaving, "leaving");
    if (word != "error" && word != "remove")
      throw InputError("leaving is \"error\" or \"remove\"", describe(*leaving),
                       "choose what happens to a point that leaves the mesh", leaving->position);
    method.remove_leaving = word == "remove";
  }
  table.finish();
  return method;
}

namespace {

CheckpointInput read_checkpoint(const Node& node) {
  Table table(node, "checkpoint");
  CheckpointInput checkpoint;
  checkpoint.every = table.number_or("every", not_negative, checkpoint.every);
  checkpoint.steps = table.whole_or("steps", 0, 1000000000, 0);
  checkpoint.time = table.number_or("time", not_negative, 0);
  checkpoint.keep = table.whole_or("keep", 1, 1000000, checkpoint.keep);
  checkpoint.stages = table.truth_or("stages", checkpoint.stages);
  table.finish();
  return checkpoint;
}

StartInput read_start(const Node& node, const std::string& case_path) {
  Table table(node, "[start]");
  StartInput start;
  start.position = node.position;
  start.from = resolved(table.text("from", "name the folder of the results of another run"), case_path);
  if (const Node* stage = table.find("stage")) {
    start.stage = text_in(*stage, "stage");
    start.stage_position = stage->position;
  }
  start.edited = table.truth_or("edited", false);
  table.finish();
  return start;
}

}  // namespace

OutputInput read_output(const Node& node) {
  Table table(node, "[output]");
  OutputInput output;
  if (const Node* checkpoint = table.find("checkpoint")) output.checkpoint = read_checkpoint(*checkpoint);
  output.every = table.number_or("every", not_negative, output.every);
  output.history = table.number_or("history", not_negative, output.history);
  output.colour = table.text_or("colour", output.colour);
  table.finish();
  return output;
}

namespace {

/// Stresses come from the weight above only where gravity points down.
template <int Dim>
void check_gravity(const CaseOf<Dim>& input) {
  bool down = input.gravity[Dim - 1] <= 0;
  for (int j = 0; j + 1 < Dim; ++j) down = down && input.gravity[j] == 0;
  for (const auto& region : input.regions) {
    if (down || region.stress) continue;
    throw InputError("with gravity that does not point down, stresses cannot come from the weight of the soil above",
                     fmt::format("gravity = [{}]", fmt::join(input.gravity, ", ")),
                     "give the region a stress instead of K0", region.position);
  }
}

/// A side absorbs from a stage on, and what holds it then is what held it in the stage before.
template <int Dim>
void check_absorbing(const CaseOf<Dim>& input) {
  for (const auto& boundary : input.boundaries) {
    if (!boundary.absorbing) continue;
    const auto& its = *boundary.absorbing;
    const auto stage = std::find_if(input.stages.begin(), input.stages.end(),
                                    [&](const auto& candidate) { return candidate.name == its.from; });
    if (stage == input.stages.end())
      throw InputError("no stage has this name", fmt::format("from = \"{}\"", its.from),
                       "name the [[stage]] with which the side begins to absorb", its.position);
    if (stage == input.stages.begin() && !input.start)  // with a start it was held in the run before
      throw InputError("a side is fixed for a stage before it absorbs, so that its reaction is known",
                       fmt::format("from = \"{}\", the first stage", its.from),
                       "put a stage with rest before it, or start from a run that has come to rest", its.position);
  }
}

template <int Dim>
Vec<Dim> read_gravity(const Node& node, bool axisymmetric) {
  const auto gravity = vector_in<Dim>(node, "gravity");
  if (!axisymmetric || gravity[0] == 0) return gravity;
  throw InputError("gravity points along the axis of a body of revolution",
                   fmt::format("gravity = [{}] with axisymmetric = true", fmt::join(gravity, ", ")),
                   "give 0 for its first component, or leave out axisymmetric", node.position);
}

template <int Dim>
CaseOf<Dim> read_tables(Table& table, const std::string& path) {
  CaseOf<Dim> result;
  result.path = path;
  result.title = table.text_or("title", path);
  if constexpr (Dim == 2) {
    result.axisymmetric = table.truth_or("axisymmetric", false);
  } else {
    refuse_keys<3>(table, {"axisymmetric"},
                   "a body of revolution is a case in two dimensions, its meridian plane: leave out dimension = 3");
  }
  if (const Node* gravity = table.find("gravity")) result.gravity = read_gravity<Dim>(*gravity, result.axisymmetric);
  result.mesh = read_mesh<Dim>(table.need("mesh", "add [mesh] with a file or a grid"), path);
  if (const Node* method = table.find("method")) result.method = read_method(*method);
  check_shape(result);
  if (const Node* output = table.find("output")) result.output = read_output(*output);
  if (const Node* start = table.find("start")) result.start = read_start(*start, path);
  result.materials = read_all<MaterialInput>(table, "material", "the soil",
                                             [&](const Node& node) { return read_material(node, path); });
  result.regions = read_all<RegionInputOf<Dim>>(table, "region", "where the soil is", [&](const Node& node) {
    return read_region<Dim>(node, result.materials, path);
  });
  result.boundaries = read_all<BoundaryInput>(table, "boundary", "", read_boundary<Dim>);
  result.stages = read_all<StageInputOf<Dim>>(table, "stage", "what happens to it",
                                              [&](const Node& node) { return read_stage<Dim>(node, path); });
  table.finish();
  check_gravity(result);
  check_absorbing(result);
  return result;
}

}  // namespace

namespace {

/// The case as it is run: the file itself, or what overrides have made of it.
std::string text_of_run(const Node& document, const std::string& path, const std::string& file,
                        const std::vector<std::string>& overrides) {
  if (overrides.empty()) return file;
  std::string head = fmt::format("# {}, with these values changed:\n", path);
  for (const auto& text : overrides) head += fmt::format("#   --set {}\n", text);
  return head + to_toml(document);
}

}  // namespace

namespace {

AnyCase read_document(const std::string& file, const std::string& path, const std::vector<std::string>& overrides) {
  logging::forget_warnings();  // of an earlier case
  Node document = parse_text(file, path);
  for (const auto& text : overrides) apply_override(document, text);
  document.position = {path, 0, 0};
  Table table(document, "the case");
  const auto read = [&]<int Dim>(std::integral_constant<int, Dim>) -> AnyCase {
    auto result = read_tables<Dim>(table, path);
    result.text = text_of_run(document, path, file, overrides);
    return result;
  };
  if (table.whole_or("dimension", 2, 3, 2) == 2) return read(std::integral_constant<int, 2>{});
  return read(std::integral_constant<int, 3>{});
}

}  // namespace

AnyCase read_any_case(const std::string& path, const std::vector<std::string>& overrides) {
  return read_document(read_text(path), path, overrides);
}

AnyCase read_case_text(const std::string& text, const std::string& path) {
  return read_document(text, path, {});
}

Case read_case(const std::string& path, const std::vector<std::string>& overrides) {
  auto result = read_any_case(path, overrides);
  if (auto* plane = std::get_if<Case>(&result)) return std::move(*plane);
  throw InputError("only cases in two dimensions can be computed here", "dimension = 3",
                   "leave dimension out and give polygons instead of solids", {path, 0, 0});
}

}  // namespace scarp::input
