// Conditions from sets of nodes. Oracle: each node of a mesh, looked at one by one.
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

#include "scarp/base/error.hpp"
#include "scarp/boundary/conditions.hpp"
#include "scarp/mesh/build.hpp"
#include "scarp/mesh/grid.hpp"

namespace scarp {
namespace {

template <int Dim>
bool is_on(const Mesh<Dim>& mesh, const char* side, int n) {
  const auto& set = mesh.node_sets.at(side);
  return std::binary_search(set.begin(), set.end(), n);
}

TEST(Fix, HoldsItsComponentsAndNoOthers) {
  const auto mesh = make_grid<3>({0, 0, 0}, {2, 3, 4}, {2, 3, 4});
  Conditions<3> conditions(mesh.node_count());
  for (int n = 0; n < mesh.node_count(); ++n) EXPECT_TRUE(is_free(conditions, n));
  fix<3>(conditions, mesh.node_sets.at("left"), 0);
  fix<3>(conditions, mesh.node_sets.at("bottom"), 2);
  fix<3>(conditions, mesh.node_sets.at("bottom"), 2);  // twice is once
  for (int n = 0; n < mesh.node_count(); ++n) {
    const bool left = is_on(mesh, "left", n), bottom = is_on(mesh, "bottom", n);
    EXPECT_EQ(conditions.fixed[n], (left ? 1 : 0) | (bottom ? 4 : 0));
    EXPECT_EQ(conditions.normal[n], -1);
    EXPECT_EQ(is_free(conditions, n), !left && !bottom);
    Vec<3> a{1, 2, 3}, v{4, 5, 6};
    const auto reaction = constrain_acceleration<3>(conditions, WallRule::by_motion, n, 2.0, v, 0.1, a);
    EXPECT_EQ(a, (Vec<3>{left ? 0.0 : 1.0, 2, bottom ? 0.0 : 3.0}));
    constrain_velocity<3>(conditions, WallRule::by_motion, n, reaction.held, v);
    EXPECT_EQ(v, (Vec<3>{left ? 0.0 : 4.0, 5, bottom ? 0.0 : 6.0}));
  }
}

/// The nodes of a side are walls that look into the mesh, whatever the functions of the grid.
template <int Dim>
void expect_walls(const Mesh<Dim>& mesh, const char* side, int normal, double inward) {
  Conditions<Dim> conditions(mesh.node_count());
  wall<Dim>(conditions, mesh, mesh.node_sets.at(side), normal, 0.4);
  for (int n = 0; n < mesh.node_count(); ++n) {
    const bool on = is_on(mesh, side, n);
    EXPECT_EQ(conditions.normal[n], on ? normal : -1);
    EXPECT_EQ(conditions.inward[n], on ? inward : 0);
    EXPECT_EQ(conditions.friction[n], on ? 0.4 : 0);
    EXPECT_EQ(conditions.fixed[n], 0);
  }
}

TEST(Wall, LooksIntoTheMesh) {
  for (const auto functions : {GridFunctions::linear, GridFunctions::gimp, GridFunctions::b_spline}) {
    const auto plane = make_grid({1, 2}, {3, 2}, {6, 4}, functions);
    expect_walls(plane, "left", 0, 1);
    expect_walls(plane, "right", 0, -1);
    expect_walls(plane, "bottom", 1, 1);
    expect_walls(plane, "top", 1, -1);
    const auto space = make_grid<3>({1, 2, 3}, {3, 2, 1}, {3, 4, 5}, functions);
    expect_walls(space, "front", 1, 1);
    expect_walls(space, "back", 1, -1);
    expect_walls(space, "top", 2, -1);
  }
  Mesh<2> triangles;
  triangles.lists.nodes = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  triangles.lists.types.assign(2, ElementType::T3);
  triangles.lists.offsets = {0, 3, 6};
  triangles.lists.connectivity = {0, 1, 2, 0, 2, 3};
  complete(triangles);
  expect_walls(triangles, "bottom", 1, 1);
  expect_walls(triangles, "right", 0, -1);
}

TEST(Wall, HasTheMeshOnOneSide) {
  const auto mesh = make_grid({0, 0}, {3, 2}, {3, 2});
  Conditions<2> conditions(mesh.node_count());
  const std::vector<int> middle{4, 5, 6, 7};  // the line y = 1
  try {
    wall<2>(conditions, mesh, middle, 1, 0.4);
    FAIL() << "no error";
  } catch (const InputError& error) {
    EXPECT_NE(error.value().find("the node at (0, 1)"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace scarp
