// Bodies for tests of the step: soil in part of the unit square or cube, thrown so that points change elements.
#pragma once

#include <cmath>
#include <map>
#include <memory>
#include <random>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "../unit/mesh/meshes.hpp"
#include "../unit/mesh/solids.hpp"
#include "scarp/material/models.hpp"
#include "scarp/step/step.hpp"

namespace scarp::test {

enum class Background { grid, gimp, b_spline, quads, triangles, mixed };

inline bool is_grid(Background kind) {
  return kind <= Background::b_spline;
}
inline GridFunctions functions_of(Background kind) {
  return kind == Background::gimp       ? GridFunctions::gimp
         : kind == Background::b_spline ? GridFunctions::b_spline
                                        : GridFunctions::linear;
}

inline Mesh<2> plane_mesh(Background kind, int n) {
  if (is_grid(kind)) return make_grid({0, 0}, {1, 1}, {n, n}, functions_of(kind));
  return irregular(n, 0.2,
                   kind == Background::quads       ? Kind::quads
                   : kind == Background::triangles ? Kind::triangles
                                                   : Kind::mixed);
}
inline Mesh<3> solid_mesh(Background kind, int n) {
  if (is_grid(kind)) return make_grid<3>({0, 0, 0}, {1, 1, 1}, {n, n, n}, functions_of(kind));
  return irregular(n, 0.1,
                   kind == Background::quads       ? Solid::hexahedra
                   : kind == Background::triangles ? Solid::tetrahedra
                                                   : Solid::mixed);
}

/// The same mesh as the meridian plane of a body of revolution.
inline Mesh<2> revolved(Mesh<2> mesh) {
  mesh.axisymmetric = true;
  return mesh;
}

inline AnyModel elastic() {
  return LinearElastic({1000.0, 0.3});
}
/// Constants that the subloading model and its viscoplastic form share.
inline std::map<std::string, double> subloading_constants() {
  return {{"kappa", .02}, {"lambda", .12}, {"nu", .3},   {"p_e", 5},  {"M", 1.0},
          {"M_c", 1.3},   {"k", .78},      {"alpha", 1}, {"xi", .01}, {"c_R", 60},
          {"c_beta", 5},  {"c_b", 20},     {"R_bf", 1},  {"c_a", 3},  {"p_atm", 101.325}};
}
inline AnyModel subloading() {
  return *make_model("subloading", subloading_constants()).model;
}

/// Without cohesion or dilation: opens, and closes.
inline AnyModel sand() {
  return *make_model("mohr-coulomb", {{"E", 1000}, {"nu", .3}, {"c", 0}, {"phi", 31}, {"psi", 0}}).model;
}

/// One of each law but umat, whose law is in a library of the user's, weak enough to yield in these tests.
inline std::vector<AnyModel> every_model() {
  const std::map<std::string, double> clay{
      {"E", 1000}, {"nu", .3}, {"s_u", 3}, {"s_u_residual", 1}, {"epsp_residual", .1}};
  const std::map<std::string, double> sand{{"E", 1000},          {"nu", .3},           {"c", .5},
                                           {"phi", 30},          {"psi", 5},           {"c_residual", .2},
                                           {"phi_residual", 25}, {"epsp_residual", .1}};
  auto viscoplastic = subloading_constants();
  viscoplastic.insert({{"mu", 1}, {"n", 2}, {"R_m", 1.6}});
  std::vector<AnyModel> all{elastic(), subloading()};
  for (const auto& [name, constants] : std::vector<std::pair<std::string, std::map<std::string, double>>>{
           {"viscoplastic-subloading", viscoplastic},
           {"neo-hookean", {{"E", 1000}, {"nu", .3}}},
           {"modified-cam-clay",
            {{"kappa", .02}, {"lambda", .12}, {"nu", .3}, {"p_e", 5}, {"M", 1}, {"p_atm", 101.325}}},
           {"von-mises", clay},
           {"tresca", clay},
           {"mohr-coulomb", sand},
           {"drucker-prager", sand}}) {
    all.push_back(make_model(name, constants).model.value());
  }
  return all;
}

/// Sets what the model's state needs to hold the pressure of soil().
template <int Dim>
void set_state(Block<Dim>& block, int i) {
  std::size_t column = 0;
  for (const auto& info : description_of(block.model).state) {
    if (info.key == "p_c") block.state[column][i] = 30;
    if (info.key == "R_b") block.state[column][i] = 2;
    for (std::size_t j = 0; j < 3 && info.key == "b"; ++j) block.state[column + j][i] = 1;  // not stretched
    column += info.kind == FieldKind::tensor ? static_cast<std::size_t>(sym_size<Dim>) : 1;
  }
}

/// Soil on a mesh of the unit square or cube: points in random places of a lattice of `along` cells on each axis over
/// 0.2 to 0.8, under an isotropic pressure, moving and turning. Held at the bottom by friction, at the other sides by
/// their normals. It softens over `length`.
template <int Dim>
Body<Dim> soil(Mesh<Dim> mesh, const AnyModel& model, int along, double speed, double length = 0) {
  Vec<Dim> g{};
  g[Dim - 1] = -9.81;
  Body<Dim> body(std::make_unique<const Mesh<Dim>>(std::move(mesh)), g);
  Block<Dim> block("soil", model, length);
  const int count = static_cast<int>(std::lround(std::pow(along, Dim)));
  resize(block, count);
  std::mt19937 random(11);
  std::uniform_real_distribution<double> shake(-0.3, 0.3);
  auto& points = block.points;
  const double step = 0.6 / along;
  for (int i = 0; i < count; ++i) {
    int rest = i;
    Vec<Dim> x;
    for (int j = 0; j < Dim; ++j) {
      x[j] = 0.2 + step * (rest % along + 0.5 + shake(random));
      rest /= along;
    }
    const double depth = body.mesh->axisymmetric ? x[0] : 1;
    points.volume[i] = points.initial_volume[i] = std::pow(step, Dim) * (1 + 0.1 * shake(random)) * depth;
    points.mass[i] = 1.8 * points.volume[i];
    points.id[i] = i;
    for (int j = 0; j < Dim; ++j) {
      points.x[j][i] = x[j];
      points.v[j][i] = speed * (0.5 + 0.5 * std::sin(2 * x[(j + 1) % Dim] + j));
      points.sigma[j][i] = -2;
    }
    if constexpr (Dim == 2) points.sigma[2][i] = -2;
    set_state(block, i);
  }
  body.fields[0].blocks.push_back(std::move(block));
  locate_points(body);
  const auto& sets = body.mesh->node_sets;
  for (const char* side : {"left", "right"}) fix(body.conditions, sets.at(side), 0);
  if constexpr (Dim == 3)
    for (const char* side : {"front", "back"}) fix(body.conditions, sets.at(side), 1);
  wall(body.conditions, *body.mesh, sets.at("bottom"), Dim - 1, 0.4);
  return body;
}

}  // namespace scarp::test
