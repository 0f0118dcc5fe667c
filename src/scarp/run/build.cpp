#include "scarp/run/build.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "scarp/base/error.hpp"
#include "scarp/base/overlap.hpp"
#include "scarp/mesh/build.hpp"
#include "scarp/mesh/gmsh.hpp"
#include "scarp/mesh/grid.hpp"
#include "scarp/mesh/near.hpp"
#include "scarp/points/fill.hpp"
#include "scarp/points/overburden.hpp"
#include "scarp/run/boundary_nodes.hpp"
#include "scarp/run/initial.hpp"
#include "scarp/run/lengths.hpp"
#include "scarp/run/memory_need.hpp"

namespace scarp::run {
namespace {

template <int Dim>
Mesh<Dim> read_mesh(const input::MeshInputOf<Dim>& input, GridFunctions shape) {
  if (input.file) return read_gmsh<Dim>(*input.file);
  try {
    return make_grid<Dim>(input.grid->origin, input.grid->size, input.grid->elements, shape);
  } catch (const InputError& error) {
    throw InputError(error.problem(), error.value(), error.remedy(), input.position);
  }
}

template <int Dim>
std::unique_ptr<const Mesh<Dim>> make_mesh(const input::CaseOf<Dim>& input) {
  auto mesh = std::make_unique<Mesh<Dim>>(read_mesh(input.mesh, input.method.shape));
  mesh->axisymmetric = input.axisymmetric;
  if (!input.axisymmetric) return mesh;
  const double least = bounds(*mesh).low[0];
  if (least < -round_off * largest_coordinate(*mesh)) {
    throw InputError("in a body of revolution x is the distance from the axis, and the mesh lies on its positive side",
                     fmt::format("a node at x = {:g}", least), "move the mesh, or leave out axisymmetric",
                     input.mesh.position);
  }
  return mesh;
}

/// On the axis of a body of revolution nothing moves off it.
template <int Dim>
void hold_axis(const Mesh<Dim>& mesh, Conditions<Dim>& conditions) {
  if (!mesh.axisymmetric) return;
  auto box = bounds(mesh);
  box.high[0] = round_off * largest_coordinate(mesh);
  std::vector<int> axis;
  for_nodes_in(mesh, box, [&](int n, const auto&) { axis.push_back(n); });
  fix(conditions, axis, 0);
}

/// What is imposed at nodes, by the boundaries that `counts`.
template <int Dim, class Counts>
Conditions<Dim> make_conditions(const Mesh<Dim>& mesh, const input::CaseOf<Dim>& input, Counts&& counts) {
  Conditions<Dim> conditions(mesh.node_count());
  hold_axis(mesh, conditions);
  for (const auto& boundary : input.boundaries) {
    if (!counts(boundary)) continue;
    const auto nodes = boundary_nodes(mesh, boundary);
    const auto fixed = boundary.fixed();
    for (int j = 0; j < Dim; ++j) {
      if (!fixed[j]) continue;
      if (!boundary.friction) {
        fix(conditions, nodes, j);
        continue;
      }
      try {
        wall(conditions, mesh, nodes, j, *boundary.friction);
      } catch (const InputError& error) {
        throw InputError(error.problem(), error.value(), error.remedy(), boundary.position);
      }
    }
  }
  return conditions;
}

/// f(side, boundary) for the boundaries that absorb; an error of it is that of the boundary.
template <int Dim, class F>
void for_each_absorbing(const Mesh<Dim>& mesh, const input::CaseOf<Dim>& input, F&& f) {
  for (const auto& boundary : input.boundaries) {
    if (!boundary.absorbing) continue;
    try {
      f(AbsorbingSide{boundary_nodes(mesh, boundary), boundary.absorbing->thickness, boundary.absorbing->impedance},
        boundary);
    } catch (const InputError& error) {
      throw InputError(error.problem(), error.value(), error.remedy(), boundary.position);
    }
  }
}

/// Puts the points of a region into its block where they start, without their state.
template <int Dim>
void put_points(Block<Dim>& block, const input::RegionInputOf<Dim>& region, double density,
                const FillingOf<Dim>& filling, bool axisymmetric, int first_id) {
  resize(block, static_cast<int>(filling.position.size()));
  auto& points = block.points;
  for (int i = 0; i < block.size(); ++i) {
    // An area times its centroid's distance from the axis is its volume per radian exactly (Pappus).
    const double volume = filling.volume[i] * (axisymmetric ? filling.position[i][0] : 1.0);
    points.volume[i] = points.initial_volume[i] = volume;
    points.mass[i] = density * volume;
    points.id[i] = first_id + i;
    for (int j = 0; j < Dim; ++j) {
      points.x[j][i] = filling.position[i][j];
      points.v[j][i] = region.velocity[j];
    }
  }
}

/// Regions that reach into each other by less than this share of the finer spacing are taken for drawn by hand.
constexpr double drawn = 0.01;

template <int Dim>
[[noreturn]] void refuse_overlap(const input::RegionInputOf<Dim>& a, const input::RegionInputOf<Dim>& b,
                                 const std::string& where) {
  throw InputError(
      fmt::format("the regions \"{}\" and \"{}\" overlap", a.name, b.name), where,
      Dim == 2 ? "let regions share no more than their edges" : "let regions share no more than their faces",
      a.position);
}

/// Points of one region in another, and then what their shapes share: less than the spacing may hold no point.
template <int Dim>
void check_overlap(const std::vector<input::RegionInputOf<Dim>>& regions, const std::vector<FillingOf<Dim>>& fillings) {
  for (std::size_t a = 0; a < regions.size(); ++a) {
    for (std::size_t b = 0; b < regions.size(); ++b) {
      if (a == b) continue;
      if (const auto shared = overlap<Dim>(regions[a].shape(), fillings[b]))
        refuse_overlap(regions[b], regions[a], fmt::format("({:.6g}) in both", fmt::join(*shared, ", ")));
    }
  }
  for (std::size_t b = 0; b < regions.size(); ++b) {
    for (std::size_t a = 0; a < b; ++a) {
      const auto shared = shared_by(regions[a].shape(), regions[b].shape());
      if (!shared || shared->depth <= drawn * std::min(regions[a].spacing, regions[b].spacing)) continue;
      refuse_overlap(regions[b], regions[a],
                     fmt::format("({:.6g}) in both, {} of {:.3g} in all", fmt::join(shared->at, ", "),
                                 Dim == 2 ? "an area" : "a volume", shared->volume));
    }
  }
}

}  // namespace

template <int Dim>
Body<Dim> build_ground(const input::CaseOf<Dim>& input) {
  check_memory(input);
  Body<Dim> body(make_mesh(input), input.gravity);
  for (const auto& region : input.regions) {
    const auto& material = input.materials[region.material];
    body.fields[0].blocks.emplace_back(region.name, material.model, material.length);
  }
  for (const auto& boundary : input.boundaries) check_boundary(*body.mesh, boundary);
  body.conditions = make_conditions(*body.mesh, input, [](const auto&) { return true; });
  return body;
}

template <int Dim>
void check_soil(const input::CaseOf<Dim>& input, const Body<Dim>& body) {
  refuse_short_lengths(input, body);
  // What is wrong with a side that will absorb is said now.
  for_each_absorbing(*body.mesh, input, [&](const auto& side, const auto&) {
    for (const auto& field : body.fields) soil_beyond(body, field, side);
  });
}

namespace {

/// Where the points of all regions are.
template <int Dim>
std::vector<FillingOf<Dim>> fill_regions(const input::CaseOf<Dim>& input) {
  std::vector<FillingOf<Dim>> fillings;
  for (const auto& region : input.regions) {
    const double count = expected_points(region);
    if (!(count < 2e8)) {
      throw InputError(fmt::format("region \"{}\" has too many points", region.name),
                       fmt::format("about {:.3g}", count), "enlarge its spacing", region.position);
    }
    fillings.push_back(fill(region.shape(), region.spacing));
  }
  check_overlap<Dim>(input.regions, fillings);
  return fillings;
}

}  // namespace

template <int Dim>
Body<Dim> build_body(const input::CaseOf<Dim>& input) {
  Body<Dim> body = build_ground(input);
  const auto fillings = fill_regions(input);
  std::vector<typename OverburdenOf<Dim>::Layer> layers;
  for (const auto& region : input.regions) layers.push_back({region.shape(), input.materials[region.material].density});
  const OverburdenOf<Dim> overburden(layers, std::abs(input.gravity[Dim - 1]));
  int first_id = 0;
  for (std::size_t r = 0; r < input.regions.size(); ++r) {
    const auto& region = input.regions[r];
    auto& block = body.blocks()[r];
    put_points(block, region, input.materials[region.material].density, fillings[r], input.axisymmetric, first_id);
    first_id += block.size();
    set_initial_state(block, region, overburden);
  }
  try {
    locate_points(body, input.method.scheme != input::SchemeName::report);
  } catch (const InputError& error) {
    for (const auto& region : input.regions) {
      if (error.problem().find('"' + region.name + '"') == std::string::npos) continue;
      throw InputError(error.problem(), error.value(), error.remedy(), region.position);
    }
    throw;
  }
  check_soil(input, body);
  return body;
}

template <int Dim>
void open_sides(Body<Dim>& body, const input::CaseOf<Dim>& input, const StepSettings& settings, int stage) {
  const auto index_of = [&](const std::string& name) {
    const auto found =
        std::find_if(input.stages.begin(), input.stages.end(), [&](const auto& its) { return its.name == name; });
    return static_cast<int>(found - input.stages.begin());
  };
  const auto open = [&](const input::BoundaryInput& its) {
    return its.absorbing && index_of(its.absorbing->from) <= stage;
  };
  for_each_absorbing(*body.mesh, input, [&](const auto& side, const auto& boundary) {
    if (index_of(boundary.absorbing->from) != stage) return;
    const auto others = make_conditions(*body.mesh, input, [&](const auto& other) { return !open(other); });
    open_side(body, settings, side, others);
  });
}

template Body<2> build_ground<2>(const input::CaseOf<2>&);
template Body<3> build_ground<3>(const input::CaseOf<3>&);
template void check_soil<2>(const input::CaseOf<2>&, const Body<2>&);
template void check_soil<3>(const input::CaseOf<3>&, const Body<3>&);
template Body<2> build_body<2>(const input::CaseOf<2>&);
template Body<3> build_body<3>(const input::CaseOf<3>&);
template void open_sides<2>(Body<2>&, const input::CaseOf<2>&, const StepSettings&, int);
template void open_sides<3>(Body<3>&, const input::CaseOf<3>&, const StepSettings&, int);

}  // namespace scarp::run
