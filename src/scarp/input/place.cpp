// Where soil is: polygons and solids.
#include <fmt/format.h>

#include <algorithm>

#include "scarp/input/readers.hpp"
#include "scarp/input/stl.hpp"

namespace scarp::input {
namespace {

/// A polygon in the plane of two axes, such as "xy"; `corner` reads one of its corners.
template <class Corner>
Polygon read_polygon(const Node& node, const std::string& name, const std::string& plane, Corner&& corner) {
  const auto* corners = std::get_if<List>(&node.value);
  if (!corners || corners->size() < 3) {
    throw InputError(fmt::format("{} is a list of at least 3 corners [{}, {}]", name, plane[0], plane[1]),
                     corners ? fmt::format("{} corners", corners->size()) : describe(node),
                     "write polygon = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0]], for instance", node.position);
  }
  Polygon polygon;
  for (const auto& item : *corners) polygon.push_back(corner(item));
  if (const auto crossing = self_crossing(polygon)) {
    const auto [i, j] = *crossing;
    const auto edge = [&](std::size_t k) {
      const auto &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
      return fmt::format("({:g}, {:g})-({:g}, {:g})", a[0], a[1], b[0], b[1]);
    };
    throw InputError(fmt::format("{} does not cross or touch itself", name),
                     fmt::format("edges {} and {}, which meet", edge(i), edge(j)),
                     "list the corners in order around the polygon, each once, without repeating the first",
                     (*corners)[j].position);
  }
  const Box box = bounds(polygon);
  if (moments(polygon).area <= 1e-12 * (box.high[0] - box.low[0]) * (box.high[1] - box.low[1])) {
    throw InputError(fmt::format("{} has an area", name), "none", "give corners that are not on one line",
                     node.position);
  }
  return polygon;
}

/// A corner in the plane of an extruded polygon.
Vec<2> section_corner(const Node& node, int axis) {
  const auto [i, j] = section_axes(axis);
  const auto* list = std::get_if<List>(&node.value);
  if (list && list->size() == 3) {
    throw InputError("a corner is a list of 2 numbers", "3 items",
                     fmt::format("beside {} the corners of the polygon are [{}, {}]", "xyz"[axis], "xyz"[i], "xyz"[j]),
                     node.position);
  }
  const auto numbers = numbers_in(node, "a corner", 2);
  return {numbers[0], numbers[1]};
}

Prism read_prism(Table& table, const Node& polygon, const std::string& name) {
  const std::string example = "write y = [0.0, 20.0] beside a polygon of corners [x, z], for instance";
  Prism prism;
  const Node* extent = nullptr;
  for (int axis = 0; axis < 3; ++axis) {
    const Node* node = table.find(std::string(1, "xyz"[axis]));
    if (!node) continue;
    if (extent)
      throw InputError("a polygon extends along one axis",
                       fmt::format("both {} and {}", "xyz"[prism.axis], "xyz"[axis]), example, node->position);
    extent = node;
    prism.axis = axis;
  }
  if (!extent)
    throw InputError(fmt::format("the polygon of {} has its extent along the third axis: x, y or z", name), "none",
                     example, polygon.position);
  const std::string key(1, "xyz"[prism.axis]);
  const auto ends = numbers_in(*extent, key, 2);
  if (!(ends[0] < ends[1]))
    throw InputError(fmt::format("{} goes from a lower to a higher number", key),
                     fmt::format("[{}, {}]", ends[0], ends[1]), fmt::format("write {} = [from, to]", key),
                     extent->position);
  prism.low = ends[0];
  prism.high = ends[1];
  const auto [i, j] = section_axes(prism.axis);
  prism.section = read_polygon(polygon, fmt::format("the polygon of {}", name), {"xyz"[i], "xyz"[j]},
                               [&](const Node& corner) { return section_corner(corner, prism.axis); });
  return prism;
}

Prism read_solid_box(const Node& node) {
  const BoxOf<3> box = read_box(node);
  for (int j = 0; j < 3; ++j) {
    if (box.low[j] < box.high[j]) continue;
    throw InputError(fmt::format("a box of soil has a length along {}", "xyz"[j]),
                     fmt::format("{} = {} at both corners", "xyz"[j], box.low[j]), "give two opposite corners",
                     node.position);
  }
  return make_box(box.low, box.high);
}

}  // namespace

BoxOf<3> read_box(const Node& node) {
  const auto* corners = std::get_if<List>(&node.value);
  if (!corners || corners->size() != 2)
    throw InputError("box is a list of two opposite corners [x, y, z]",
                     corners ? count_of_items(corners->size()) : describe(node),
                     "write box = [[0.0, 0.0, 0.0], [45.0, 20.0, 5.0]], for instance", node.position);
  BoxOf<3> box{vector_in<3>((*corners)[0], "a corner"), vector_in<3>((*corners)[1], "a corner")};
  for (int j = 0; j < 3; ++j) {
    if (box.low[j] > box.high[j]) std::swap(box.low[j], box.high[j]);
  }
  return box;
}

template <>
Place<2> read_place<2>(Table& table, const std::string& name, const std::string&) {
  const char* remedy =
      name == "remove" ? "add the corners of the soil that is taken away" : "add the corners of the region";
  refuse_keys<2>(table, {"box", "stl", "x", "y", "z"}, "give a polygon of corners [x, y]");
  return {read_polygon(table.need("polygon", remedy), fmt::format("the polygon of {}", name), "xy",
                       [](const Node& corner) { return vector_in<2>(corner, "a corner"); })};
}

template <>
Place<3> read_place<3>(Table& table, const std::string& name, const std::string& case_path) {
  const Node *box = table.find("box"), *polygon = table.find("polygon"), *stl = table.find("stl");
  if ((box != nullptr) + (polygon != nullptr) + (stl != nullptr) != 1) {
    throw InputError(
        fmt::format("{} is one of a box, a polygon with its extent, or the inside of an STL surface", name),
        box || polygon || stl ? "more than one of box, polygon and stl" : "neither box, polygon nor stl",
        "write box = [[0.0, 0.0, 0.0], [45.0, 20.0, 5.0]], or polygon = [...] with y = [0.0, 20.0], or "
        "stl = \"hill.stl\"",
        table.position());
  }
  if (box) return {read_solid_box(*box)};
  if (polygon) return {read_prism(table, *polygon, name)};
  return {read_stl(read_file_name(*stl, "stl", "the STL", case_path))};
}

}  // namespace scarp::input
