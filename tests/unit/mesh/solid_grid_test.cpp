// Grids of space, sizes and volumes of solid elements, neighbours and the order along the curve.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "scarp/base/error.hpp"
#include "scarp/mesh/grid.hpp"
#include "scarp/mesh/order.hpp"
#include "scarp/mesh/shapes.hpp"
#include "solids.hpp"

namespace scarp {
namespace {

std::vector<int> listed(const ElementsAround<3>& around) {
  return {around.begin(), around.end()};
}

TEST(SolidGrid, NumbersNodesAndElementsXFastestThenY) {
  const Mesh<3> mesh = make_grid<3>({1, -2, 3}, {6, 2, 4}, {3, 2, 2});
  ASSERT_EQ(mesh.node_count(), 4 * 3 * 3);
  ASSERT_EQ(mesh.element_count(), 12);
  EXPECT_EQ(mesh.node(0), (Vec<3>{1, -2, 3}));
  EXPECT_EQ(mesh.node(3), (Vec<3>{7, -2, 3}));
  EXPECT_EQ(mesh.node(4), (Vec<3>{1, -1, 3}));
  EXPECT_EQ(mesh.node(12), (Vec<3>{1, -2, 5}));
  EXPECT_EQ(mesh.node(35), (Vec<3>{7, 0, 7}));
  const auto nodes = mesh.element_nodes(10);  // the second in x and y, upper layer
  EXPECT_EQ(std::vector<int>(nodes.begin(), nodes.end()), (std::vector<int>{17, 18, 22, 21, 29, 30, 34, 33}));
  ASSERT_TRUE(mesh.grid);
  EXPECT_EQ(mesh.grid->spacing, (Vec<3>{2, 1, 2}));
  EXPECT_EQ(mesh.grid->cell(10), (std::array<int, 3>{1, 1, 1}));
  EXPECT_DOUBLE_EQ(mesh_volume(mesh), 48);
  for (int e = 0; e < 12; ++e) EXPECT_DOUBLE_EQ(mesh.size_of(e), 1);  // the shortest side
}

TEST(SolidGrid, HasItsSides) {
  const Mesh<3> mesh = make_grid<3>({0, 0, 0}, {0.7, 0.3, 0.9}, {49, 7, 3});
  ASSERT_EQ(mesh.node_sets.size(), 6u);
  const auto expect = [&](const char* name, int axis, double at, std::size_t count) {
    const std::vector<int>& set = mesh.node_sets.at(name);
    EXPECT_EQ(set.size(), count) << name;
    EXPECT_TRUE(std::is_sorted(set.begin(), set.end()));
    for (int n : set) EXPECT_EQ(mesh.node(n)[axis], at) << name;  // to the last bit
  };
  expect("left", 0, 0, 8 * 4);
  expect("right", 0, 0.7, 8 * 4);
  expect("front", 1, 0, 50 * 4);
  expect("back", 1, 0.3, 50 * 4);
  expect("bottom", 2, 0, 50 * 8);
  expect("top", 2, 0.9, 50 * 8);
}

// Oracle: the same elements without the grid, whose neighbours are found by nodes.
TEST(SolidGrid, NeighboursFollowFromTheIndex) {
  for (const std::array<int, 3>& counts : {std::array<int, 3>{4, 3, 5}, {1, 4, 2}, {3, 1, 1}, {1, 1, 1}, {2, 2, 2}}) {
    const Mesh<3> mesh = make_grid<3>({0, 0, 0}, {1, 1, 1}, counts);
    const Mesh<3> plain = test::as_lists(mesh);
    for (int e = 0; e < mesh.element_count(); ++e)
      EXPECT_EQ(listed(mesh.elements_around(e)), listed(plain.elements_around(e)));
  }
}

TEST(SolidGrid, RefusesWhatIsNoGrid) {
  const double inf = std::numeric_limits<double>::infinity();
  EXPECT_THROW(make_grid<3>({0, 0, 0}, {1, 1, 0}, {1, 1, 1}), InputError);
  EXPECT_THROW(make_grid<3>({0, 0, 0}, {1, 1, inf}, {1, 1, 1}), InputError);
  EXPECT_THROW(make_grid<3>({0, 0, std::nan("")}, {1, 1, 1}, {1, 1, 1}), InputError);
  EXPECT_THROW(make_grid<3>({0, 0, 0}, {1, 1, 1}, {1, 1, 0}), InputError);
  EXPECT_THROW(make_grid<3>({0, 0, 0}, {1, 1, 1}, {1300, 1300, 1300}), InputError);
  EXPECT_THROW(make_grid<3>({0, 0, 0}, {1, 1, 1}, {1 << 30, 1 << 30, 1 << 30}), InputError);
  EXPECT_THROW(make_grid<3>({0, 0, 1e18}, {1, 1, 1}, {10, 10, 10}), InputError);
}

Mesh<3> single(const std::vector<Vec<3>>& nodes) {
  Mesh<3> mesh;
  mesh.lists.nodes = nodes;
  mesh.lists.offsets.push_back(0);
  std::vector<int> numbers;
  for (int i = 0; i < static_cast<int>(nodes.size()); ++i) numbers.push_back(i);
  test::add_element(mesh, nodes.size() == 4 ? ElementType::T4 : ElementType::H8, numbers);
  return mesh;
}

// Oracles: solid geometry.
TEST(SolidElementSize, IsTheLeastHeight) {
  // A corner of a cube of side 1: volume 1/6 over the face opposite, of area sqrt(3)/2.
  EXPECT_NEAR(element_size(single({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}), 0), 1 / std::sqrt(3.0), 1e-14);
  // Flat: height 0.1 over a base of area 6.
  EXPECT_NEAR(element_size(single({{0, 0, 0}, {3, 0, 0}, {0, 4, 0}, {1, 1, 0.1}}), 0), 0.1, 1e-14);
  // Every way that the nodes of a tetrahedron may run.
  std::vector<Vec<3>> nodes = {{0, 0, 0}, {1, 0.2, 0}, {0.1, 2, 0.3}, {0.4, 0.1, 0.7}};
  const double size = element_size(single(nodes), 0);
  std::sort(nodes.begin(), nodes.end());
  do EXPECT_NEAR(element_size(single(nodes), 0), size, 1e-14);
  while (std::next_permutation(nodes.begin(), nodes.end()));
  const auto box = [](const Vec<3>& a, const Vec<3>& b, const Vec<3>& c) {
    std::vector<Vec<3>> corners;
    for (int i = 0; i < 8; ++i) {
      Vec<3> x;
      for (int k = 0; k < 3; ++k) x[k] = (i % 4 == 1 || i % 4 == 2) * a[k] + (i % 4 >= 2) * b[k] + (i >= 4) * c[k];
      corners.push_back(x);
    }
    return single(corners);
  };
  EXPECT_NEAR(element_size(box({5, 0, 0}, {0, 2, 0}, {0, 0, 3}), 0), 2, 1e-14);
  EXPECT_NEAR(element_size(box({4, 0, 0}, {0, 4, 0}, {3, 0, 1}), 0), 1, 1e-14);  // leans; 1 high on its base
}

// Oracle: the exact volume of a frustum of a pyramid, h/3 (A + B + sqrt(AB)), and of a tetrahedron.
TEST(SolidElementVolume, IsExact) {
  EXPECT_NEAR(
      element_volume(
          single({{-2, -2, 0}, {2, -2, 0}, {2, 2, 0}, {-2, 2, 0}, {-1, -1, 3}, {1, -1, 3}, {1, 1, 3}, {-1, 1, 3}}), 0),
      (16 + 4 + 8) * 3 / 3.0, 1e-13);
  EXPECT_NEAR(element_volume(single({{0, 0, 0}, {3, 0, 0}, {0, 4, 0}, {1, 1, 5}}), 0), 10, 1e-14);
  EXPECT_NEAR(element_volume(single({{0, 0, 0}, {0, 4, 0}, {3, 0, 0}, {1, 1, 5}}), 0), -10, 1e-14);
}

TEST(SolidElementVolume, AddsUpToTheCubeHoweverItIsCut) {
  for (test::Solid kind : {test::Solid::hexahedra, test::Solid::tetrahedra, test::Solid::mixed})
    EXPECT_NEAR(mesh_volume(test::irregular(8, 0.2, kind)), 1, 1e-13);
}

// Oracle: all pairs of elements, compared node by node.
TEST(SolidAround, HoldsAllThatShareANode) {
  const Mesh<3> mesh = test::irregular(4, 0.2, test::Solid::mixed);
  for (int a = 0; a < mesh.element_count(); ++a) {
    std::vector<int> expected;
    for (int b = 0; b < mesh.element_count(); ++b) {
      bool shares = false;
      for (int i : mesh.element_nodes(a))
        for (int j : mesh.element_nodes(b)) shares = shares || i == j;
      if (shares && a != b) expected.push_back(b);
    }
    EXPECT_EQ(listed(mesh.elements_around(a)), expected);
  }
}

// Oracle: in a cube of 16 x 16 x 16 cells a Hilbert curve goes from each cell to one that shares a face with it.
TEST(SolidOrder, GoesFromEachElementToItsNeighbour) {
  const Mesh<3> grid = make_grid<3>({0, 0, 0}, {16, 16, 16}, {16, 16, 16});
  Mesh<3> mesh = test::shuffled(grid);
  for (int n = 0; n < mesh.node_count(); ++n)
    if (mesh.node(n) == Vec<3>{16, 16, 16}) mesh.node_sets["corner"].push_back(n);
  order_along_curve(mesh);
  ASSERT_EQ(mesh.node_count(), grid.node_count());
  ASSERT_EQ(mesh.element_count(), grid.element_count());
  EXPECT_DOUBLE_EQ(mesh_volume(mesh), 4096);
  EXPECT_EQ(mesh.node(mesh.node_sets.at("corner")[0]), (Vec<3>{16, 16, 16}));
  for (int e = 1; e < mesh.element_count(); ++e) {
    const Vec<3> way = detail::minus(mesh.node(mesh.element_nodes(e)[0]), mesh.node(mesh.element_nodes(e - 1)[0]));
    ASSERT_EQ(std::abs(way[0]) + std::abs(way[1]) + std::abs(way[2]), 1) << e;
  }
  int used = 0;
  for (int node : mesh.lists.connectivity) {
    ASSERT_LE(node, used);  // nodes are numbered by their first use
    used = std::max(used, node + 1);
  }
}

}  // namespace
}  // namespace scarp
