// Polygons and the mesh of a case.
#include <fmt/format.h>

#include <cmath>
#include <filesystem>

#include "scarp/input/readers.hpp"

namespace scarp::input {
namespace {

Vec<2> pair_in(const Node& node, const std::string& name) {
  const auto numbers = numbers_in(node, name, 2);
  return {numbers[0], numbers[1]};
}

/// Number of elements along one direction of a grid, from their length.
int count_along(double size, double element, const std::string& axis, const Position& at) {
  const double count = std::round(size / element);
  if (std::abs(count * element - size) > 1e-9 * size || count < 1) {
    const double fitting = size / std::max(1.0, count);
    throw InputError(
        fmt::format("the grid's size along {} is a whole multiple of the element", axis),
        fmt::format("{} / {} = {:.6g}", size, element, size / element),
        fmt::format("take element = {:.6g}, or size = {:.6g} along {}", fitting, std::max(1.0, count) * element, axis),
        at);
  }
  if (count > 1e8)
    throw InputError("the grid has too many elements", fmt::format("{:.3g} along {}", count, axis),
                     "take larger elements", at);
  return static_cast<int>(count);
}

MeshInput::GridInput read_grid(const Node& node) {
  Table table(node, "grid");
  MeshInput::GridInput grid;
  grid.origin = table.vector("origin").value_or(Vec<2>{0, 0});
  const Node& size = table.need("size", "give its width and height, size = [45.0, 20.0]");
  grid.size = pair_in(size, "size");
  for (const double length : grid.size) number_in({size.position, length}, "size", positive);
  const Node* counts = table.find("elements");
  const Node* element = table.find("element");
  if ((counts != nullptr) == (element != nullptr)) {
    throw InputError("a grid has either element, the size of an element, or elements, their numbers",
                     counts ? "both" : "neither", "write element = 0.5, for instance", node.position);
  }
  if (counts) {
    const auto numbers = numbers_in(*counts, "elements", 2);
    for (int j = 0; j < 2; ++j) {
      if (numbers[j] < 1 || numbers[j] != std::floor(numbers[j]) || numbers[j] > 1e8) {
        throw InputError("elements are two whole numbers of at least 1", fmt::format("{}", numbers[j]),
                         "write elements = [90, 40], for instance", counts->position);
      }
      grid.elements[j] = static_cast<int>(numbers[j]);
    }
  } else {
    const Vec<2> lengths =
        element->is_list() ? pair_in(*element, "element")
                           : Vec<2>{number_in(*element, "element", positive), number_in(*element, "element", positive)};
    const char* axes[] = {"x", "y"};
    for (int j = 0; j < 2; ++j) {
      number_in({element->position, lengths[j]}, "element", positive);
      grid.elements[j] = count_along(grid.size[j], lengths[j], axes[j], element->position);
    }
  }
  table.finish();
  return grid;
}

}  // namespace

Polygon read_polygon(const Node& node, const std::string& name) {
  const auto* corners = std::get_if<List>(&node.value);
  if (!corners || corners->size() < 3) {
    throw InputError(fmt::format("{} is a list of at least 3 corners [x, y]", name),
                     corners ? fmt::format("{} corners", corners->size()) : describe(node),
                     "write polygon = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0]], for instance", node.position);
  }
  Polygon polygon;
  for (const auto& corner : *corners) polygon.push_back(pair_in(corner, "a corner"));
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

MeshInput read_mesh(const Node& node, const std::string& case_path) {
  Table table(node, "[mesh]");
  MeshInput mesh;
  mesh.position = node.position;
  const Node* grid = table.find("grid");
  const Node* file = table.find("file");
  if ((grid != nullptr) == (file != nullptr)) {
    throw InputError("[mesh] has either a file made by Gmsh or a grid", grid ? "both" : "neither",
                     "write file = \"slope.msh\" or grid = { size = [45.0, 20.0], element = 0.5 }", node.position);
  }
  if (grid) {
    mesh.grid = read_grid(*grid);
  } else {
    const std::filesystem::path name = text_in(*file, "file");
    mesh.file = (name.is_absolute() ? name : std::filesystem::path(case_path).parent_path() / name).string();
    std::error_code none;  // a name that no file can have is a file that is not there
    if (!std::filesystem::exists(*mesh.file, none)) {
      throw InputError("the mesh file is not there", *mesh.file, "names are relative to the case file's folder",
                       file->position);
    }
  }
  table.finish();
  return mesh;
}

}  // namespace scarp::input
