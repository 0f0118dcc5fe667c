// Where the mesh ends at a side of an element, and the elements that a place on a line belongs to.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "meshes.hpp"
#include "scarp/mesh/locate.hpp"
#include "solids.hpp"

namespace scarp::test {
namespace {

/// The middle of a side of element e, by its corners.
template <class Shape>
Vec<Shape::dim> middle_of(const Mesh<Shape::dim>& mesh, int e, int side) {
  const auto x = node_positions<Shape>(mesh, e);
  Vec<Shape::dim> middle{};
  for (const auto& local : Shape::sides) {
    if (side_of<Shape>(local) != side) continue;
    for (const int i : local) {
      for (int j = 0; j < Shape::dim; ++j) middle[j] += x[i][j] / static_cast<double>(local.size());
    }
  }
  return middle;
}

/// Is x on the surface of the unit square or cube?
template <int Dim>
bool is_at_surface(const Vec<Dim>& x) {
  for (const double coordinate : x) {
    if (coordinate < 1e-9 || coordinate > 1 - 1e-9) return true;
  }
  return false;
}

/// Of a mesh of the unit square or cube: it ends at a side of an element where the middle of the side is on the
/// surface, and nowhere else. Sides as bases count them: the middle of each must be where side_of() has it.
template <int Dim>
void expect_ends_at_the_surface(const Mesh<Dim>& mesh) {
  const Locator<Dim> locator(mesh);
  int ends = 0;
  for (int e = 0; e < mesh.element_count(); ++e) {
    with_shape<Dim>(mesh.type_of(e), [&]<class Shape>(Shape) {
      for (int side = 0; side < static_cast<int>(Shape::sides.size()); ++side) {
        const auto middle = middle_of<Shape>(mesh, e, side);
        EXPECT_EQ(locator.ends_at(e, side), is_at_surface<Dim>(middle)) << "element " << e << ", side " << side;
        ends += locator.ends_at(e, side);
      }
    });
  }
  EXPECT_GT(ends, 0);
}

TEST(EndsAt, TheSurfaceOfPlaneMeshes) {
  expect_ends_at_the_surface<2>(make_grid({0, 0}, {1, 1}, {5, 4}));
  for (const Kind kind : {Kind::quads, Kind::triangles, Kind::mixed})
    expect_ends_at_the_surface<2>(irregular(6, 0.2, kind));
}

TEST(EndsAt, TheSurfaceOfSolidMeshes) {
  expect_ends_at_the_surface<3>(make_grid<3>({0, 0, 0}, {1, 1, 1}, {3, 4, 5}));
  for (const Solid kind : {Solid::hexahedra, Solid::tetrahedra, Solid::mixed}) {
    expect_ends_at_the_surface<3>(irregular(4, 0.1, kind));
    // A hexahedron's face that two tetrahedra share is found whatever the order of elements and nodes.
    expect_ends_at_the_surface<3>(shuffled(irregular(4, 0.1, kind)));
  }
}

TEST(EndsAt, GridsOfOtherFunctionsWhoseNodesAreNoCorners) {
  const auto mesh = make_grid({0, 0}, {1, 1}, {4, 3}, GridFunctions::b_spline);
  const Locator<2> locator(mesh);
  for (int e = 0; e < mesh.element_count(); ++e) {
    const int i = e % 4, j = e / 4;
    const std::array<bool, 4> ends{i == 0, i == 3, j == 0, j == 2};
    for (int side = 0; side < 4; ++side) EXPECT_EQ(locator.ends_at(e, side), ends[side]) << e << ", " << side;
  }
}

TEST(EndsAt, AHoleInTheMesh) {
  // Of 4 x 4 elements one is missing: it is the end of its four neighbours, at the side that faces it.
  const auto mesh =
      irregular(4, 0, Kind::quads, [](double x, double y) { return x > 0.25 && x < 0.5 && y > 0.25 && y < 0.5; });
  ASSERT_EQ(mesh.element_count(), 15);
  const Locator<2> locator(mesh);
  int ends = 0;
  for (int e = 0; e < mesh.element_count(); ++e) {
    for (int side = 0; side < 4; ++side) ends += locator.ends_at(e, side);
  }
  EXPECT_EQ(ends, 16 + 4);
}

TEST(ElementsAt, CornersLinesAndInsideOfAGrid) {
  for (const bool as_grid : {true, false}) {
    const Mesh<2> grid = make_grid({0, 0}, {3, 2}, {3, 2});
    const Mesh<2> mesh = as_grid ? grid : as_lists(grid);
    const Locator<2> locator(mesh);
    EXPECT_EQ(locator.elements_at({0.4, 0.6}, 0), std::vector<int>{0});
    EXPECT_EQ(locator.elements_at({1, 0.6}, 0), (std::vector<int>{0, 1}));
    EXPECT_EQ(locator.elements_at({1, 0.6}, 1), (std::vector<int>{0, 1}));
    EXPECT_EQ(locator.elements_at({2, 1}, 4), (std::vector<int>{1, 2, 4, 5}));
    EXPECT_EQ(locator.elements_at({0, 1}, 0), (std::vector<int>{0, 3}));
    EXPECT_EQ(locator.elements_at({0, 0}, 0), std::vector<int>{0});
  }
}

/// Elements around a place are those that, as each is asked, hold it: of all, by looking at all.
template <int Dim>
void expect_all_that_hold(const Mesh<Dim>& mesh) {
  const Locator<Dim> locator(mesh);
  for (int n = 0; n < mesh.node_count(); ++n) {
    std::vector<int> with_node;
    for (int e = 0; e < mesh.element_count(); ++e) {
      const auto nodes = mesh.element_nodes(e);
      if (std::count(nodes.begin(), nodes.end(), n) > 0) with_node.push_back(e);
    }
    EXPECT_EQ(locator.elements_at(mesh.node(n), with_node.back()), with_node) << "node " << n;
  }
}

TEST(ElementsAt, NodesOfMeshes) {
  // At a node are the elements that have it.
  for (const Kind kind : {Kind::quads, Kind::triangles, Kind::mixed}) expect_all_that_hold<2>(irregular(6, 0.2, kind));
  for (const Solid kind : {Solid::tetrahedra, Solid::mixed}) expect_all_that_hold<3>(irregular(3, 0.1, kind));
  expect_all_that_hold<3>(make_grid<3>({0, 0, 0}, {1, 1, 1}, {3, 3, 3}));
}

TEST(ElementsAt, MiddlesOfTheSidesOfATriangle) {
  // Two triangles of a square share its diagonal.
  const auto mesh = irregular(1, 0, Kind::triangles);
  ASSERT_EQ(mesh.element_count(), 2);
  const Locator<2> locator(mesh);
  const Vec<2> middle{0.5, 0.5};
  EXPECT_EQ(locator.elements_at(middle, 0), (std::vector<int>{0, 1}));
}

}  // namespace
}  // namespace scarp::test
