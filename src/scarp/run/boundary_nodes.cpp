#include "scarp/run/boundary_nodes.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "scarp/mesh/build.hpp"
#include "scarp/mesh/near.hpp"
#include "scarp/run/cut_elements.hpp"

namespace scarp::run {

namespace {

/// Nodes on the segment.
std::vector<int> nodes_on(const Mesh<2>& mesh, const std::array<Vec<2>, 2>& line) {
  const double dx = line[1][0] - line[0][0], dy = line[1][1] - line[0][1], length2 = dx * dx + dy * dy;
  const double tolerance = nearness(mesh, line);
  Box box;
  for (int k = 0; k < 2; ++k) {  // with room for what its own corners round off
    const auto [low, high] = std::minmax(line[0][k], line[1][k]);
    box.low[k] = low - 2 * tolerance;
    box.high[k] = high + 2 * tolerance;
  }
  std::vector<int> nodes;
  for_nodes_in(mesh, box, [&](int n, const Vec<2>& x) {
    const double rx = x[0] - line[0][0], ry = x[1] - line[0][1];
    const double t = std::clamp((rx * dx + ry * dy) / length2, 0.0, 1.0);
    if (std::hypot(rx - t * dx, ry - t * dy) <= tolerance) nodes.push_back(n);
  });
  return nodes;
}

/// Nodes in the box, within round-off of the mesh's size.
std::vector<int> nodes_in(const Mesh<3>& mesh, const BoxOf<3>& box) {
  const double tolerance = round_off * largest_coordinate(mesh);
  BoxOf<3> wider = box;
  for (int j = 0; j < 3; ++j) {
    wider.low[j] -= tolerance;
    wider.high[j] += tolerance;
  }
  std::vector<int> nodes;
  for_nodes_in(mesh, wider, [&](int n, const Vec<3>&) { nodes.push_back(n); });
  return nodes;
}

/// A side of the grid is held by its own control points; a line or plane between the sides by none.
template <int Dim>
void check_on_side(const Mesh<Dim>& mesh, const Vec<Dim>& low, const Vec<Dim>& high, const Position& position) {
  if (!mesh.grid || mesh.grid->functions != GridFunctions::b_spline) return;
  const auto& grid = *mesh.grid;
  bool flat = false, between = false;
  for (int j = 0; j < Dim; ++j) {
    const double size = grid.spacing[j] * grid.elements[j], tolerance = 1e-9 * size;
    if (std::abs(high[j] - low[j]) > tolerance) continue;
    flat = true;
    const double from_origin = low[j] - grid.origin[j];
    between = between || std::min(std::abs(from_origin), std::abs(from_origin - size)) > tolerance;
  }
  if (!between && (flat || Dim == 3)) return;
  throw InputError(Dim == 2 ? "with B-splines the line of a boundary lies on a side of the grid"
                            : "with B-splines the box of a flat boundary lies on a side of the grid",
                   fmt::format("({}) to ({})", fmt::join(low, ", "), fmt::join(high, ", ")),
                   fmt::format("move the side of the grid there, or use shape = \"linear\" or \"gimp\"{}",
                               Dim == 2 ? "" : ", or give a thick box, whose control points are then held"),
                   position);
}

/// Where a boundary is, from one end or corner to the other.
template <int Dim>
std::array<Vec<Dim>, 2> ends_of(const input::BoundaryInput& input) {
  if constexpr (Dim == 2) {
    return *input.line;
  } else {
    return {input.box->low, input.box->high};
  }
}

template <int Dim>
std::string place_of(const input::BoundaryInput& input) {
  const auto ends = ends_of<Dim>(input);
  return fmt::format("({}) to ({})", fmt::join(ends[0], ", "), fmt::join(ends[1], ", "));
}

template <int Dim>
std::vector<int> nodes_in_place(const Mesh<Dim>& mesh, const input::BoundaryInput& input) {
  constexpr const char* kind = Dim == 2 ? "line" : "box";
  const auto ends = ends_of<Dim>(input);
  check_on_side<Dim>(mesh, ends[0], ends[1], input.position);
  std::vector<int> nodes;
  if constexpr (Dim == 2) {
    nodes = nodes_on(mesh, *input.line);
  } else {
    nodes = nodes_in(mesh, *input.box);
  }
  if (nodes.empty())
    throw InputError(fmt::format("no node of the mesh lies {} the {} of this boundary", Dim == 2 ? "on" : "in", kind),
                     place_of<Dim>(input),
                     Dim == 2 ? "give a line along edges of elements, or name a node set with nodes = \"...\""
                              : "give a box that holds nodes, or name a node set with nodes = \"...\"",
                     input.position);
  return nodes;
}

}  // namespace

template <int Dim>
std::vector<int> boundary_nodes(const Mesh<Dim>& mesh, const input::BoundaryInput& input) {
  if (!input.nodes) return nodes_in_place(mesh, input);
  const auto found = mesh.node_sets.find(*input.nodes);
  if (found != mesh.node_sets.end()) return found->second;
  std::vector<std::string> names;
  for (const auto& [name, nodes] : mesh.node_sets) names.push_back('"' + name + '"');
  throw InputError("the mesh has no such node set", '"' + *input.nodes + '"',
                   fmt::format("choose one of {}", fmt::join(names, ", ")), input.position);
}

template <int Dim>
void check_boundary(const Mesh<Dim>& mesh, const input::BoundaryInput& input) {
  const auto nodes = boundary_nodes(mesh, input);
  if (input.nodes) return;
  constexpr const char* kind = Dim == 2 ? "line" : "box";
  const auto cut = cut_element(mesh, ends_of<Dim>(input));
  if (!cut) return;
  throw InputError(
      fmt::format("the {} of this boundary passes through elements, and holds nothing between its nodes there", kind),
      fmt::format("{} nodes on {}, an element cut at ({:.6g})", nodes.size(), place_of<Dim>(input),
                  fmt::join(*cut, ", ")),
      fmt::format("give a {} along {} of elements, or draw it in the geometry before meshing, as a Physical {}, and "
                  "name that with nodes = \"...\"",
                  kind, Dim == 2 ? "edges" : "faces", Dim == 2 ? "Curve" : "Surface"),
      input.position);
}

template <int Dim>
std::vector<std::string> describe_boundaries(const Mesh<Dim>& mesh,
                                             const std::vector<input::BoundaryInput>& boundaries) {
  std::vector<std::string> lines;
  for (const auto& its : boundaries) {
    const auto where = its.nodes ? '"' + *its.nodes + '"' : (Dim == 2 ? "line " : "box ") + place_of<Dim>(its);
    std::vector<char> fixed;
    for (int j = 0; j < Dim; ++j) {
      if (its.fixed()[j]) fixed.push_back("xyz"[j]);
    }
    std::string does = fmt::format("fixes {}", fmt::join(fixed, ", "));
    if (its.friction) does = fmt::format("a wall across {}, friction {:g}", fixed.front(), *its.friction);
    if (its.absorbing) does += fmt::format(", absorbs from stage \"{}\" on", its.absorbing->from);
    const auto count = boundary_nodes(mesh, its).size();
    lines.push_back(fmt::format("boundary {}: {} node{}, {}", where, count, count == 1 ? "" : "s", does));
  }
  return lines;
}

template std::vector<int> boundary_nodes(const Mesh<2>&, const input::BoundaryInput&);
template std::vector<int> boundary_nodes(const Mesh<3>&, const input::BoundaryInput&);
template void check_boundary(const Mesh<2>&, const input::BoundaryInput&);
template void check_boundary(const Mesh<3>&, const input::BoundaryInput&);
template std::vector<std::string> describe_boundaries(const Mesh<2>&, const std::vector<input::BoundaryInput>&);
template std::vector<std::string> describe_boundaries(const Mesh<3>&, const std::vector<input::BoundaryInput>&);

}  // namespace scarp::run
