#include "scarp/run/build.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <cmath>
#include <memory>

#include "scarp/base/error.hpp"
#include "scarp/mesh/gmsh.hpp"
#include "scarp/mesh/grid.hpp"
#include "scarp/points/fill.hpp"
#include "scarp/points/overburden.hpp"
#include "scarp/run/initial.hpp"

namespace scarp::run {
namespace {

std::unique_ptr<const Mesh<2>> make_mesh(const input::MeshInput& input) {
  if (input.file) return std::make_unique<const Mesh<2>>(read_gmsh(*input.file));
  try {
    return std::make_unique<const Mesh<2>>(make_grid(input.grid->origin, input.grid->size, input.grid->elements));
  } catch (const InputError& error) {
    throw InputError(error.problem(), error.value(), error.remedy(), input.position);
  }
}

/// Nodes within round-off of the segment.
std::vector<int> nodes_on(const Mesh<2>& mesh, const std::array<Vec<2>, 2>& line) {
  const double dx = line[1][0] - line[0][0], dy = line[1][1] - line[0][1], length2 = dx * dx + dy * dy;
  const double tolerance = 1e-9 * std::sqrt(length2);
  std::vector<int> nodes;
  for (int n = 0; n < mesh.node_count(); ++n) {
    const double rx = mesh.nodes[n][0] - line[0][0], ry = mesh.nodes[n][1] - line[0][1];
    const double t = std::clamp((rx * dx + ry * dy) / length2, 0.0, 1.0);
    if (std::hypot(rx - t * dx, ry - t * dy) <= tolerance) nodes.push_back(n);
  }
  return nodes;
}

std::vector<int> nodes_of(const Mesh<2>& mesh, const input::BoundaryInput& input) {
  if (input.line) {
    auto nodes = nodes_on(mesh, *input.line);
    if (!nodes.empty()) return nodes;
    throw InputError("no node of the mesh lies on the line of this boundary",
                     fmt::format("({}) to ({})", fmt::join((*input.line)[0], ", "), fmt::join((*input.line)[1], ", ")),
                     "give a line along edges of elements, or name a node set with nodes = \"...\"", input.position);
  }
  const auto found = mesh.node_sets.find(*input.nodes);
  if (found != mesh.node_sets.end()) return found->second;
  std::vector<std::string> names;
  for (const auto& [name, nodes] : mesh.node_sets) names.push_back('"' + name + '"');
  throw InputError("the mesh has no such node set", '"' + *input.nodes + '"',
                   fmt::format("choose one of {}", fmt::join(names, ", ")), input.position);
}

void set_conditions(Body<2>& body, const input::Case& input) {
  for (const auto& boundary : input.boundaries) {
    const auto nodes = nodes_of(*body.mesh, boundary);
    const bool fixed[2] = {boundary.fix_x, boundary.fix_y};
    for (int j = 0; j < 2; ++j) {
      if (!fixed[j]) continue;
      if (!boundary.friction) {
        fix(body.conditions, nodes, j);
        continue;
      }
      try {
        wall(body.conditions, *body.mesh, nodes, j, *boundary.friction);
      } catch (const InputError& error) {
        throw InputError(error.problem(), error.value(), error.remedy(), boundary.position);
      }
    }
  }
}

/// The points of a region where they start, without their state.
Block<2> make_block(const input::RegionInput& region, const input::MaterialInput& material, const Filling& filling,
                    int first_id) {
  Block<2> block(region.name, material.model);
  resize(block, static_cast<int>(filling.position.size()));
  auto& points = block.points;
  for (int i = 0; i < block.size(); ++i) {
    points.volume[i] = points.initial_volume[i] = filling.volume[i];
    points.mass[i] = material.density * filling.volume[i];
    points.id[i] = first_id + i;
    for (int j = 0; j < 2; ++j) {
      points.x[j][i] = filling.position[i][j];
      points.v[j][i] = region.velocity[j];
    }
  }
  return block;
}

void check_overlap(const std::vector<input::RegionInput>& regions, const std::vector<Filling>& fillings) {
  for (std::size_t a = 0; a < regions.size(); ++a) {
    for (std::size_t b = 0; b < regions.size(); ++b) {
      if (a == b) continue;
      if (const auto shared = overlap(regions[a].polygon, fillings[b])) {
        throw InputError(fmt::format("the regions \"{}\" and \"{}\" overlap", regions[b].name, regions[a].name),
                         fmt::format("({:.6g}, {:.6g}) in both", (*shared)[0], (*shared)[1]),
                         "let regions share no more than their edges", regions[b].position);
      }
    }
  }
}

}  // namespace

Body<2> build_body(const input::Case& input) {
  Body<2> body(make_mesh(input.mesh), input.gravity);
  std::vector<Filling> fillings;
  std::vector<Overburden::Layer> layers;
  for (const auto& region : input.regions) {
    const double count = moments(region.polygon).area / (region.spacing * region.spacing);
    if (!(count < 2e8)) {
      throw InputError(fmt::format("region \"{}\" has too many points", region.name),
                       fmt::format("about {:.3g}", count), "enlarge its spacing", region.position);
    }
    fillings.push_back(fill(region.polygon, region.spacing));
    layers.push_back({region.polygon, input.materials[region.material].density});
  }
  check_overlap(input.regions, fillings);
  int first_id = 0;
  for (std::size_t r = 0; r < input.regions.size(); ++r) {
    const auto& region = input.regions[r];
    body.blocks.push_back(make_block(region, input.materials[region.material], fillings[r], first_id));
    first_id += body.blocks.back().size();
  }
  set_conditions(body, input);
  const Overburden overburden(layers, std::hypot(input.gravity[0], input.gravity[1]));
  for (std::size_t r = 0; r < input.regions.size(); ++r) {
    set_initial_state(body.blocks[r], input.regions[r], overburden);
  }
  try {
    locate_points(body);
  } catch (const InputError& error) {
    for (const auto& region : input.regions) {
      if (error.problem().find('"' + region.name + '"') == std::string::npos) continue;
      throw InputError(error.problem(), error.value(), error.remedy(), region.position);
    }
    throw;
  }
  return body;
}

}  // namespace scarp::run
