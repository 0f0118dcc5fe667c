// Elastic ground in geostatic balance, to which nothing happens: what a scheme makes of it in many steps.
#pragma once

#include <numeric>

#include "method.hpp"
#include "scarp/mesh/build.hpp"

namespace scarp::verification {

/// The elements of a mesh: those of a grid, or the same squares as quadrilaterals, halved into triangles, or of both
/// kinds by turns. Lines between the squares stay where they are.
enum class Cells { grid, quads, triangles, mixed };

inline std::string name_of(Cells cells) {
  return std::array{"grid", "quads", "triangles", "mixed"}[static_cast<int>(cells)];
}

inline Mesh<2> cut_up(const Mesh<2>& regular, Cells cells) {
  if (cells == Cells::grid) return regular;
  Mesh<2> mesh;
  for (int n = 0; n < regular.node_count(); ++n) mesh.lists.nodes.push_back(regular.node(n));
  mesh.lists.offsets.push_back(0);
  const auto add = [&](std::initializer_list<int> nodes) {
    mesh.lists.types.push_back(nodes.size() == 3 ? ElementType::T3 : ElementType::Q4);
    mesh.lists.connectivity.insert(mesh.lists.connectivity.end(), nodes.begin(), nodes.end());
    mesh.lists.offsets.push_back(static_cast<int>(mesh.lists.connectivity.size()));
  };
  for (int e = 0; e < regular.element_count(); ++e) {
    const auto c = regular.element_nodes(e);
    const auto at = regular.grid->cell(e);
    if (cells == Cells::quads || (cells == Cells::mixed && (at[0] + at[1]) % 2 == 0)) {
      add({c[0], c[1], c[2], c[3]});
    } else if (at[0] % 2 == 0) {
      add({c[0], c[1], c[2]});
      add({c[0], c[2], c[3]});
    } else {
      add({c[0], c[1], c[3]});
      add({c[1], c[2], c[3]});
    }
  }
  complete(mesh);
  return mesh;
}

/// Ground of E = 10 MPa, ρ = 2 t/m3 on the floor of a mesh, as wide as that and `height` high. Points are `spacing`
/// apart, or as much more or less as makes a whole number of them.
struct Soil {
  double spacing, height, nu = 0.3;
  static constexpr double E = 1e4, rho = 2, g = 9.81;
};

template <int Dim>
Body<Dim> ground(Mesh<Dim> mesh, const Soil& soil) {
  constexpr int up = Dim - 1;
  Vec<Dim> gravity{}, size = mesh.node(0);
  gravity[up] = -Soil::g;
  for (int n = 0; n < mesh.node_count(); ++n) {
    for (int j = 0; j < Dim; ++j) size[j] = std::max(size[j], mesh.node(n)[j]);
  }
  size[up] = soil.height;
  std::array<int, Dim> counts;
  double volume = 1;
  for (int j = 0; j < Dim; ++j) {
    counts[j] = static_cast<int>(std::lround(size[j] / soil.spacing));
    volume *= size[j] / counts[j];
  }
  Body<Dim> body(std::make_unique<const Mesh<Dim>>(std::move(mesh)), gravity);
  Block<Dim> block("ground", linear_elastic(Soil::E, soil.nu));
  resize(block, std::accumulate(counts.begin(), counts.end(), 1, std::multiplies<>()));
  auto& points = block.points;
  const double K0 = soil.nu / (1 - soil.nu);
  for (int p = 0; p < block.size(); ++p) {
    int rest = p;
    for (int j = 0; j < Dim; ++j) {
      points.x[j][p] = size[j] / counts[j] * (rest % counts[j] + 0.5);
      rest /= counts[j];
    }
    points.volume[p] = points.initial_volume[p] = volume;
    points.mass[p] = Soil::rho * volume;
    points.id[p] = p;
    for (int j = 0; j < 3; ++j)
      points.sigma[j][p] = -Soil::rho * Soil::g * (soil.height - points.x[up][p]) * (j == up ? 1 : K0);
  }
  body.fields[0].blocks.push_back(std::move(block));
  locate_points(body, true);
  const auto& sets = body.mesh->node_sets;
  for (int j = 0; j < Dim; ++j) fix(body.conditions, sets.at("bottom"), j);
  for (const char* side : {"left", "right"}) fix(body.conditions, sets.at(side), 0);
  if constexpr (Dim == 3) {
    for (const char* side : {"front", "back"}) fix(body.conditions, sets.at(side), 1);
  }
  return body;
}

/// Kinetic energy over some steps that each are `safety` critical ones: means of the first and of the last tenth.
struct Rest {
  double first = 0, last = 0;
  std::int64_t crossings = 0;
  double growth() const { return last / first; }
};

template <int Dim>
Rest keep_at_rest(Body<Dim>& body, const Scheme& scheme, int steps, double safety) {
  StepSettings settings;
  settings.scheme = scheme;
  const double dt = safety * critical_time_step(body, scheme);
  Rest rest;
  for (int s = 0; s < steps; ++s) {
    const auto totals = advance(body, dt, settings);
    rest.crossings += totals.changed_element;
    if (s < steps / 10) rest.first += totals.kinetic_energy / (steps / 10);
    if (s >= steps - steps / 10) rest.last += totals.kinetic_energy / (steps / 10);
  }
  return rest;
}

}  // namespace scarp::verification
