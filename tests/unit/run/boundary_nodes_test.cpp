// Which nodes a boundary holds, and lines and flat boxes that would hold nothing between theirs.
#include "scarp/run/boundary_nodes.hpp"

#include <gtest/gtest.h>

#include "scarp/base/error.hpp"
#include "scarp/mesh/build.hpp"
#include "scarp/mesh/grid.hpp"

namespace scarp::run {
namespace {

input::BoundaryInput line(const Vec<2>& a, const Vec<2>& b) {
  input::BoundaryInput boundary;
  boundary.line = {a, b};
  boundary.fix_x = true;
  return boundary;
}

input::BoundaryInput box(const Vec<3>& a, const Vec<3>& b) {
  input::BoundaryInput boundary;
  boundary.box = {a, b};
  boundary.fix_z = true;
  return boundary;
}

/// Two triangles in the unit square, cut from (0, 0) to (1, 1), and beside them a square.
Mesh<2> triangles() {
  Mesh<2> mesh;
  mesh.lists.nodes = {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {2, 0}, {2, 1}};
  mesh.lists.types = {ElementType::T3, ElementType::T3, ElementType::Q4};
  mesh.lists.offsets = {0, 3, 6, 10};
  mesh.lists.connectivity = {0, 1, 2, 0, 2, 3, 1, 4, 5, 2};
  complete(mesh);
  return mesh;
}

/// The six tetrahedra of the unit cube along its diagonal from (0, 0, 0) to (1, 1, 1).
Mesh<3> tetrahedra() {
  Mesh<3> mesh;
  mesh.lists.nodes = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};
  mesh.lists.types.assign(6, ElementType::T4);
  mesh.lists.offsets = {0, 4, 8, 12, 16, 20, 24};
  mesh.lists.connectivity = {0, 1, 2, 6, 0, 2, 3, 6, 0, 3, 7, 6, 0, 7, 4, 6, 0, 4, 5, 6, 0, 5, 1, 6};
  complete(mesh);
  return mesh;
}

/// Of a boundary that is good.
template <int Dim>
std::vector<int> held_nodes(const Mesh<Dim>& mesh, const input::BoundaryInput& boundary) {
  check_boundary(mesh, boundary);
  return boundary_nodes(mesh, boundary);
}

template <int Dim>
void expect_cut(const Mesh<Dim>& mesh, const input::BoundaryInput& boundary, const std::string& nodes) {
  try {
    check_boundary(mesh, boundary);
    ADD_FAILURE() << "no error";
  } catch (const InputError& error) {
    EXPECT_NE(error.problem().find("passes through elements"), std::string::npos) << error.what();
    EXPECT_EQ(error.value().find(nodes + " nodes on"), 0u) << error.what();
    EXPECT_NE(error.remedy().find("nodes = "), std::string::npos) << error.what();
  }
}

using Nodes = std::vector<int>;

TEST(BoundaryNodes, OfLinesThatAreALittleOff) {
  // A line holds all nodes or none: there is no tilt at which some are too far to be held and no element is cut.
  const auto mesh = make_grid({0, 0}, {24, 8}, {48, 16});
  for (double tilt = 1e-9; tilt < 1e-3; tilt *= 1.5) {
    try {
      EXPECT_EQ(held_nodes(mesh, line({0, 0}, {24, tilt})).size(), 49u) << tilt;
    } catch (const InputError& error) {
      EXPECT_GT(tilt, 1e-7);
      EXPECT_NE(error.problem().find("passes through elements"), std::string::npos) << error.what();
    }
  }
}

TEST(BoundaryNodes, OfLinesAlongEdges) {
  const auto mesh = triangles();
  EXPECT_EQ(held_nodes(mesh, line({0, 0}, {2, 0})), (Nodes{0, 1, 4}));
  EXPECT_EQ(held_nodes(mesh, line({0, 0}, {1, 1})), (Nodes{0, 2}));    // the edge that the triangles share
  EXPECT_EQ(held_nodes(mesh, line({1, -3}, {1, 4})), (Nodes{1, 2}));   // beyond the mesh on both sides
  EXPECT_EQ(held_nodes(mesh, line({0, 0}, {1.4, 0})), (Nodes{0, 1}));  // ends within an edge
  EXPECT_EQ(held_nodes(mesh, line({-1, 0}, {0, 1})), (Nodes{3}));      // touches a corner
}

TEST(BoundaryNodes, OfLinesThroughElements) {
  const auto mesh = triangles();
  expect_cut(mesh, line({0, 1}, {1, 0}), "2");
  expect_cut(mesh, line({1, 0}, {2, 1}), "2");      // the square's other diagonal
  expect_cut(mesh, line({0, 0}, {2, 1}), "2");      // through triangle and square
  expect_cut(mesh, line({0, 1}, {0.2, 0.9}), "1");  // ends within
  expect_cut(mesh, line({0, 1e-4}, {1, 0}), "1");   // almost along an edge, and no more
  const auto grid = make_grid<2>({0, 0}, {2, 2}, {4, 4});
  expect_cut(grid, line({0, 0}, {2, 2}), "5");
  for (const auto functions : {GridFunctions::linear, GridFunctions::gimp})
    EXPECT_EQ(held_nodes(make_grid<2>({0, 0}, {2, 2}, {4, 4}, functions), line({0, 0.5}, {2, 0.5})).size(), 5u);
}

TEST(BoundaryNodes, OfFlatBoxes) {
  const auto mesh = tetrahedra();
  EXPECT_EQ(held_nodes(mesh, box({0, 0, 0}, {1, 1, 0})), (Nodes{0, 1, 2, 3}));
  EXPECT_EQ(held_nodes(mesh, box({-1, 1, -1}, {2, 1, 2})), (Nodes{2, 3, 6, 7}));
  EXPECT_EQ(held_nodes(mesh, box({0, 0, 0}, {1, 1, 0.3})), (Nodes{0, 1, 2, 3}));  // thick
  EXPECT_EQ(held_nodes(mesh, box({0, 0, 0}, {1, 0, 0})), (Nodes{0, 1}));          // a line
  auto bent = mesh;
  bent.lists.nodes[5][2] = 0.6;  // the plane z = 1 still has three nodes, and is now outside on one side
  EXPECT_EQ(held_nodes(bent, box({0, 0, 1}, {1, 1, 1})), (Nodes{4, 6, 7}));
  bent.lists.nodes[1][2] = -0.5;
  expect_cut(bent, box({0, 0, 0}, {1, 1, 0}), "3");
  EXPECT_EQ(held_nodes(make_grid<3>({0, 0, 0}, {1, 1, 1}, {2, 2, 2}), box({0, 0, 0.5}, {1, 1, 0.5})).size(), 9u);
}

TEST(BoundaryNodes, AreDescribed) {
  const auto mesh = triangles();
  auto wall = line({0, 0}, {2, 0});
  wall.friction = 0.3;
  input::BoundaryInput side;
  side.nodes = "left";
  side.fix_x = side.fix_y = true;
  const auto lines = describe_boundaries(mesh, {wall, side});
  EXPECT_EQ(lines.at(0), "boundary line (0, 0) to (2, 0): 3 nodes, a wall across x, friction 0.3");
  EXPECT_EQ(lines.at(1), "boundary \"left\": 2 nodes, fixes x, y");
}

}  // namespace
}  // namespace scarp::run
