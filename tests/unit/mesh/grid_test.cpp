#include "scarp/mesh/grid.hpp"

#include <gtest/gtest.h>

#include <limits>

#include "meshes.hpp"
#include "scarp/base/error.hpp"
#include "scarp/mesh/build.hpp"
#include "scarp/mesh/order.hpp"

namespace scarp {
namespace {

TEST(Grid, NumbersNodesAndElementsXFastest) {
  const Mesh<2> mesh = make_grid({1, -2}, {6, 2}, {3, 2});
  ASSERT_EQ(mesh.node_count(), 12);
  ASSERT_EQ(mesh.element_count(), 6);
  EXPECT_EQ(mesh.node(0), (Vec<2>{1, -2}));
  EXPECT_EQ(mesh.node(3), (Vec<2>{7, -2}));
  EXPECT_EQ(mesh.node(11), (Vec<2>{7, 0}));
  const auto nodes = mesh.element_nodes(4);
  EXPECT_EQ(std::vector<int>(nodes.begin(), nodes.end()), (std::vector<int>{5, 6, 10, 9}));
  ASSERT_TRUE(mesh.grid);
  EXPECT_EQ(mesh.grid->spacing, (Vec<2>{2, 1}));
  EXPECT_DOUBLE_EQ(mesh_area(mesh), 12);
  for (int e = 0; e < 6; ++e) EXPECT_DOUBLE_EQ(mesh.size_of(e), 1);  // the shorter side
}

TEST(Grid, HasItsSidesAndNeighbours) {
  const Mesh<2> mesh = make_grid({0, 0}, {3, 2}, {3, 2});
  EXPECT_EQ(mesh.node_sets.at("left"), (std::vector<int>{0, 4, 8}));
  EXPECT_EQ(mesh.node_sets.at("right"), (std::vector<int>{3, 7, 11}));
  EXPECT_EQ(mesh.node_sets.at("bottom"), (std::vector<int>{0, 1, 2, 3}));
  EXPECT_EQ(mesh.node_sets.at("top"), (std::vector<int>{8, 9, 10, 11}));
  const auto around = mesh.elements_around(1), corner = mesh.elements_around(5);
  EXPECT_EQ(std::vector<int>(around.begin(), around.end()), (std::vector<int>{0, 2, 3, 4, 5}));
  EXPECT_EQ(std::vector<int>(corner.begin(), corner.end()), (std::vector<int>{1, 2, 4}));
}

// The last line lies on the side to the last bit, also where size / elements is not a short binary number.
TEST(Grid, EndsExactlyOnItsSides) {
  const Mesh<2> mesh = make_grid({0, 0}, {0.7, 0.3}, {49, 7});
  EXPECT_EQ(mesh.node(mesh.node_count() - 1), (Vec<2>{0.7, 0.3}));
  EXPECT_EQ(mesh.node_sets.at("right").size(), 8u);
}

TEST(Grid, RefusesWhatIsNoGrid) {
  const double inf = std::numeric_limits<double>::infinity();
  EXPECT_THROW(make_grid({0, 0}, {0, 1}, {1, 1}), InputError);
  EXPECT_THROW(make_grid({0, 0}, {1, -1}, {1, 1}), InputError);
  EXPECT_THROW(make_grid({0, 0}, {1, inf}, {1, 1}), InputError);
  EXPECT_THROW(make_grid({std::nan(""), 0}, {1, 1}, {1, 1}), InputError);
  EXPECT_THROW(make_grid({0, 0}, {1, 1}, {0, 1}), InputError);
  EXPECT_THROW(make_grid({0, 0}, {1, 1}, {1 << 20, 1 << 20}), InputError);
  EXPECT_THROW(make_grid({1e18, 0}, {1, 1}, {10, 10}), InputError);
}

Mesh<2> single(std::vector<Vec<2>> nodes) {
  Mesh<2> mesh;
  mesh.lists.types.push_back(nodes.size() == 3 ? ElementType::T3 : ElementType::Q4);
  mesh.lists.offsets = {0, static_cast<int>(nodes.size())};
  for (int i = 0; i < static_cast<int>(nodes.size()); ++i) mesh.lists.connectivity.push_back(i);
  mesh.lists.nodes = std::move(nodes);
  return mesh;
}

// Oracles: plane geometry.
TEST(ElementSize, IsTheLeastHeight) {
  EXPECT_NEAR(element_size(single({{0, 0}, {3, 0}, {0, 4}}), 0), 12.0 / 5, 1e-14);   // 2A / hypotenuse
  EXPECT_NEAR(element_size(single({{0, 0}, {5, 0}, {5, 2}, {0, 2}}), 0), 2, 1e-14);  // rectangle
  EXPECT_NEAR(element_size(single({{0, 0}, {2, 0}, {3, 1}, {1, 1}}), 0), 1, 1e-14);  // parallelogram on long sides
  EXPECT_NEAR(element_size(single({{0, 0}, {4, 0}, {4, 1}, {0, 3}}), 0), 2 / std::sqrt(5.0),
              1e-14);  // (4, 0) under the upper side
  EXPECT_NEAR(element_size(single({{1, 1}, {-1, 1}, {-1, -1}, {1, -1}}), 0), 2, 1e-14);
}

// Oracle: all pairs of elements, compared node by node.
TEST(Around, HoldsAllThatShareANode) {
  const Mesh<2> mesh = test::irregular(6, 0.2, test::Kind::mixed);
  for (int a = 0; a < mesh.element_count(); ++a) {
    std::vector<int> expected;
    for (int b = 0; b < mesh.element_count(); ++b) {
      bool shares = false;
      for (int i : mesh.element_nodes(a))
        for (int j : mesh.element_nodes(b)) shares = shares || i == j;
      if (shares && a != b) expected.push_back(b);
    }
    const auto around = mesh.elements_around(a);
    EXPECT_EQ(std::vector<int>(around.begin(), around.end()), expected);
  }
}

TEST(MeshArea, IsThatOfTheSquareHoweverItIsCut) {
  for (test::Kind kind : {test::Kind::quads, test::Kind::triangles, test::Kind::mixed})
    EXPECT_NEAR(mesh_area(test::irregular(20, 0.3, kind)), 1, 1e-13);
}

// Oracle: on a square of 32 x 32 cells a Hilbert curve goes from each cell to one that shares an edge with it, so the
// mean step is 1; without the turns of its quadrants it is 1.23.
TEST(Order, GoesFromEachElementToItsNeighbour) {
  Mesh<2> mesh = make_grid({0, 0}, {32, 32}, {32, 32});
  Mesh<2> shuffled;
  for (int n = 0; n < mesh.node_count(); ++n) shuffled.lists.nodes.push_back(mesh.node(n));
  shuffled.lists.offsets.push_back(0);
  for (int i = 0; i < mesh.element_count(); ++i) {
    const auto nodes = mesh.element_nodes((i * 389) % mesh.element_count());
    shuffled.lists.types.push_back(ElementType::Q4);
    shuffled.lists.connectivity.insert(shuffled.lists.connectivity.end(), nodes.begin(), nodes.end());
    shuffled.lists.offsets.push_back(static_cast<int>(shuffled.lists.connectivity.size()));
  }
  shuffled.node_sets["corner"] = {mesh.node_count() - 1};
  order_along_curve(shuffled);
  ASSERT_EQ(shuffled.node_count(), mesh.node_count());
  ASSERT_EQ(shuffled.element_count(), mesh.element_count());
  EXPECT_DOUBLE_EQ(mesh_area(shuffled), 1024);
  EXPECT_EQ(shuffled.node(shuffled.node_sets.at("corner")[0]), (Vec<2>{32, 32}));
  double way = 0;
  for (int e = 1; e < shuffled.element_count(); ++e) {
    const Vec<2>&a = shuffled.node(shuffled.element_nodes(e - 1)[0]), &b = shuffled.node(shuffled.element_nodes(e)[0]);
    way += std::hypot(a[0] - b[0], a[1] - b[1]);
  }
  EXPECT_NEAR(way / 1023, 1, 1e-12);
}

}  // namespace
}  // namespace scarp
