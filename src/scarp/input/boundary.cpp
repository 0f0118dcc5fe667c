// Boundaries of a case.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "scarp/input/readers.hpp"

namespace scarp::input {
namespace {

/// What messages say, which differs between two and three dimensions.
template <int Dim>
struct Words;
template <>
struct Words<2> {
  static constexpr const char* either = "a boundary has either nodes, the name of a set, or a line";
  static constexpr const char* example = "write nodes = \"bottom\" or line = [[0.0, 0.0], [45.0, 0.0]]";
  static constexpr const char* component = "a component of fix is \"x\" or \"y\"";
  static constexpr const char* fix = "write fix = [\"x\"], [\"y\"] or [\"x\", \"y\"]";
};
template <>
struct Words<3> {
  static constexpr const char* either = "a boundary has either nodes, the name of a set, or a box";
  static constexpr const char* example =
      "write nodes = \"bottom\" or box = [[0.0, 0.0, 0.0], [45.0, 20.0, 0.0]], which may be flat";
  static constexpr const char* component = "a component of fix is \"x\", \"y\" or \"z\"";
  static constexpr const char* fix = "write fix = [\"z\"] or [\"x\", \"y\", \"z\"], for instance";
};

std::array<Vec<2>, 2> read_line(const Node& node) {
  const auto* ends = std::get_if<List>(&node.value);
  if (!ends || ends->size() != 2)
    throw InputError("line is a list of two points", describe(node), "write line = [[0.0, 0.0], [45.0, 0.0]]",
                     node.position);
  const auto a = vector_in<2>((*ends)[0], "a point"), b = vector_in<2>((*ends)[1], "a point");
  if (a == b)
    throw InputError("the two points of line differ", "the same point twice", "give its two ends", node.position);
  return {a, b};
}

template <int Dim>
void read_fix(const Node& fix, BoundaryInput& boundary) {
  const auto* components = std::get_if<List>(&fix.value);
  if (!components || components->empty())
    throw InputError("fix is a list of components", describe(fix), Words<Dim>::fix, fix.position);
  for (const auto& component : *components) {
    const auto name = text_in(component, "a component of fix");
    if (name == "x") {
      boundary.fix_x = true;
    } else if (name == "y") {
      boundary.fix_y = true;
    } else if (Dim == 3 && name == "z") {
      boundary.fix_z = true;
    } else {
      throw InputError(Words<Dim>::component, describe(component),
                       fmt::format("{}{}", Words<Dim>::fix,
                                   name == "z" ? "; for \"z\" set dimension = 3 at the top of the case" : ""),
                       component.position);
    }
  }
}

template <int Dim>
void read_friction(const Node& friction, BoundaryInput& boundary) {
  boundary.friction = number_in(friction, "friction", not_negative);
  std::vector<std::string> fixed;
  for (int j = 0; j < Dim; ++j) {
    if (boundary.fixed()[j]) fixed.emplace_back(1, "xyz"[j]);
  }
  if (fixed.size() == 1) return;
  throw InputError("a wall with friction fixes one component, its normal",
                   Dim == 2 ? "both x and y fixed" : fmt::format("{} fixed", fmt::join(fixed, " and ")),
                   "fix only the component across the wall", friction.position);
}

std::array<double, 2> read_impedance(const Node& node) {
  const auto Z = vector_in<2>(node, "impedance");
  if (Z[0] > 0 && Z[1] > 0) return Z;
  throw InputError("impedance is that of compression and of shear waves, both above zero",
                   fmt::format("[{:.6g}, {:.6g}]", Z[0], Z[1]),
                   "give density times wave speed of the soil beyond, such as impedance = [600.0, 300.0]",
                   node.position);
}

void read_absorbing(Table& table, const Node& word, BoundaryInput& boundary) {
  const bool* absorbing = std::get_if<bool>(&word.value);
  if (!absorbing || !*absorbing)
    throw InputError("absorbing is true, or left out", describe(word), "write absorbing = true", word.position);
  if (boundary.friction)
    throw InputError("a side that absorbs is no wall with friction", "both friction and absorbing",
                     "leave one of them out", word.position);
  const Node& from = table.need("from", "add from = \"shake\", the name of the stage with which it begins");
  auto& its = boundary.absorbing.emplace();
  its.from = text_in(from, "from");
  its.position = from.position;
  if (const Node* thickness = table.find("thickness")) its.thickness = number_in(*thickness, "thickness", not_negative);
  if (const Node* impedance = table.find("impedance")) its.impedance = read_impedance(*impedance);
}

}  // namespace

template <int Dim>
BoundaryInput read_boundary(const Node& node) {
  Table table(node, "[[boundary]]");
  BoundaryInput boundary;
  boundary.position = node.position;
  refuse_keys<Dim>(table, {Dim == 2 ? "box" : "line"}, Words<Dim>::example);
  const Node* nodes = table.find("nodes");
  const Node* where = table.find(Dim == 2 ? "line" : "box");
  if ((nodes != nullptr) == (where != nullptr))
    throw InputError(Words<Dim>::either, nodes ? "both" : "neither", Words<Dim>::example, node.position);
  if (nodes) {
    boundary.nodes = text_in(*nodes, "nodes");
  } else if (Dim == 2) {
    boundary.line = read_line(*where);
  } else {
    boundary.box = read_box(*where);
    if (boundary.box->low == boundary.box->high)
      throw InputError("the two corners of box differ", "the same corner twice", "give two opposite corners",
                       where->position);
  }
  read_fix<Dim>(table.need("fix", Words<Dim>::fix), boundary);
  if (const Node* friction = table.find("friction")) read_friction<Dim>(*friction, boundary);
  if (const Node* word = table.find("absorbing")) read_absorbing(table, *word, boundary);
  table.finish();
  return boundary;
}

template BoundaryInput read_boundary<2>(const Node&);
template BoundaryInput read_boundary<3>(const Node&);

}  // namespace scarp::input
