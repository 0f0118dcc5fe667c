#include "scarp/input/case.hpp"

#include <fmt/format.h>

#include <functional>

#include "scarp/input/readers.hpp"

namespace scarp::input {
namespace {

RemovalInput read_removal(const Node& node, double duration) {
  Table table(node, "remove");
  RemovalInput removal;
  removal.polygon =
      read_polygon(table.need("polygon", "add the corners of the soil that is taken away"), "the polygon of remove");
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

BoundaryInput read_boundary(const Node& node) {
  Table table(node, "[[boundary]]");
  BoundaryInput boundary;
  boundary.position = node.position;
  const Node* nodes = table.find("nodes");
  const Node* line = table.find("line");
  if ((nodes != nullptr) == (line != nullptr)) {
    throw InputError("a boundary has either nodes, the name of a set, or a line", nodes ? "both" : "neither",
                     "write nodes = \"bottom\" or line = [[0.0, 0.0], [45.0, 0.0]]", node.position);
  }
  if (nodes) {
    boundary.nodes = text_in(*nodes, "nodes");
  } else {
    const auto* ends = std::get_if<List>(&line->value);
    if (!ends || ends->size() != 2)
      throw InputError("line is a list of two points", describe(*line), "write line = [[0.0, 0.0], [45.0, 0.0]]",
                       line->position);
    const auto a = numbers_in((*ends)[0], "a point", 2), b = numbers_in((*ends)[1], "a point", 2);
    if (a == b)
      throw InputError("the two points of line differ", "the same point twice", "give its two ends", line->position);
    boundary.line = {Vec<2>{a[0], a[1]}, Vec<2>{b[0], b[1]}};
  }
  const Node& fix = table.need("fix", "write fix = [\"x\"], [\"y\"] or [\"x\", \"y\"]");
  const auto* components = std::get_if<List>(&fix.value);
  if (!components || components->empty())
    throw InputError("fix is a list of components", describe(fix), "write fix = [\"x\"], [\"y\"] or [\"x\", \"y\"]",
                     fix.position);
  for (const auto& component : *components) {
    const auto name = text_in(component, "a component of fix");
    if (name != "x" && name != "y")
      throw InputError("a component of fix is \"x\" or \"y\"", describe(component),
                       "write fix = [\"x\"], [\"y\"] or [\"x\", \"y\"]", component.position);
    (name == "x" ? boundary.fix_x : boundary.fix_y) = true;
  }
  if (const Node* friction = table.find("friction")) {
    boundary.friction = number_in(*friction, "friction", not_negative);
    if (boundary.fix_x == boundary.fix_y) {
      throw InputError("a wall with friction fixes one component, its normal", "both x and y fixed",
                       "fix only the component across the wall", friction->position);
    }
  }
  table.finish();
  return boundary;
}

StageInput read_stage(const Node& node) {
  Table table(node, "[[stage]]");
  StageInput stage;
  stage.position = node.position;
  stage.name = table.text("name", "add name = \"at rest\", for instance");
  stage.duration = table.number("duration", positive, "add the time that the stage takes at most, in seconds");
  stage.damping = table.number_or("damping", {0, 1, false, true}, 0);
  if (const Node* flip = table.find("flip")) stage.flip = number_in(*flip, "flip", {0, 1});
  stage.zero_displacement = table.truth_or("zero_displacement", false);
  stage.zero_velocity = table.truth_or("zero_velocity", false);
  if (const Node* remove = table.find("remove")) stage.remove = read_removal(*remove, stage.duration);
  if (const Node* rest = table.find("rest")) stage.rest = read_rest(*rest);
  table.finish();
  return stage;
}

MethodInput read_method(const Node& node) {
  Table table(node, "[method]");
  MethodInput method;
  method.flip = table.number_or("flip", {0, 1}, method.flip);
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

OutputInput read_output(const Node& node) {
  Table table(node, "[output]");
  OutputInput output;
  output.every = table.number_or("every", not_negative, output.every);
  output.history = table.number_or("history", not_negative, output.history);
  output.colour = table.text_or("colour", output.colour);
  table.finish();
  return output;
}

Case read_case(const std::string& path, const std::vector<std::string>& overrides) {
  Node document = parse_file(path);
  for (const auto& text : overrides) apply_override(document, text);
  document.position = {path, 0, 0};
  Table table(document, "the case");
  Case result;
  result.path = path;
  result.title = table.text_or("title", path);
  result.gravity = table.vector("gravity").value_or(result.gravity);
  result.mesh = read_mesh(table.need("mesh", "add [mesh] with a file or a grid"), path);
  if (const Node* method = table.find("method")) result.method = read_method(*method);
  if (const Node* output = table.find("output")) result.output = read_output(*output);
  result.materials = read_all<MaterialInput>(table, "material", "the soil",
                                             [&](const Node& node) { return read_material(node, path); });
  result.regions = read_all<RegionInput>(table, "region", "where the soil is",
                                         [&](const Node& node) { return read_region(node, result.materials); });
  result.boundaries = read_all<BoundaryInput>(table, "boundary", "", read_boundary);
  result.stages = read_all<StageInput>(table, "stage", "what happens to it", read_stage);
  table.finish();
  if (result.gravity[0] != 0 || result.gravity[1] > 0) {
    for (const auto& region : result.regions) {
      if (!region.stress) {
        throw InputError(
            "with gravity that does not point down, stresses cannot come from the weight of the soil above",
            fmt::format("gravity = [{}, {}]", result.gravity[0], result.gravity[1]),
            "give the region a stress instead of K0", region.position);
      }
    }
  }
  return result;
}

}  // namespace scarp::input
