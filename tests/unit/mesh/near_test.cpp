// Nodes and elements of a part of a mesh. Oracle: all nodes and elements, looked at one by one.
#include "scarp/mesh/near.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <vector>

#include "meshes.hpp"
#include "scarp/mesh/grid.hpp"

namespace scarp {
namespace {

template <int Dim>
bool holds(const BoxOf<Dim>& box, const Vec<Dim>& x) {
  bool yes = true;
  for (int k = 0; k < Dim; ++k) yes = yes && x[k] >= box.low[k] && x[k] <= box.high[k];
  return yes;
}

template <int Dim>
void expect_nodes_and_elements(const Mesh<Dim>& mesh, const BoxOf<Dim>& box) {
  std::vector<int> nodes, expected;
  for_nodes_in(mesh, box, [&](int n, const Vec<Dim>& x) {
    EXPECT_EQ(x, mesh.node(n));
    nodes.push_back(n);
  });
  for (int n = 0; n < mesh.node_count(); ++n)
    if (holds<Dim>(box, mesh.node(n))) expected.push_back(n);
  ASSERT_EQ(nodes, expected);
  std::vector<int> elements;
  for_elements_near(mesh, box, [&](int e) { elements.push_back(e); });
  ASSERT_TRUE(std::is_sorted(elements.begin(), elements.end()));
  for (int e = 0; e < mesh.element_count(); ++e) {
    bool touches = false;
    for (const int n : mesh.element_nodes(e)) touches = touches || holds<Dim>(box, mesh.node(n));
    if (touches) {
      ASSERT_TRUE(std::binary_search(elements.begin(), elements.end(), e)) << "element " << e;
    }
  }
}

TEST(Near, FindsTheNodesInABoxAndTheElementsThatHaveThem) {
  std::mt19937 random(4);
  std::uniform_real_distribution<double> u(-0.3, 1.3);
  for (const auto functions : {GridFunctions::linear, GridFunctions::gimp, GridFunctions::b_spline}) {
    const Mesh<2> plane = make_grid({0, 0}, {1, 1}, {9, 5}, functions);
    const Mesh<3> space = make_grid<3>({0, 0, 0}, {1, 1, 1}, {4, 5, 2}, functions);
    for (int i = 0; i < 300; ++i) {
      const auto [a, b] = std::minmax({u(random), u(random)});
      const auto [c, d] = std::minmax({u(random), u(random)});
      expect_nodes_and_elements<2>(plane, {{a, c}, {b, d}});
      expect_nodes_and_elements<3>(space, {{a, c, a}, {b, d, d}});
    }
    // Flat boxes on lines, all of the mesh, none of it.
    for (int n = 0; n < plane.node_count(); ++n) expect_nodes_and_elements<2>(plane, {plane.node(n), plane.node(n)});
    expect_nodes_and_elements<2>(plane, {{-1e300, -1e300}, {1e300, 1e300}});
    expect_nodes_and_elements<2>(plane, box_around<2>(plane, {}));
    expect_nodes_and_elements<2>(plane, {{2, 2}, {3, 3}});
  }
  expect_nodes_and_elements<2>(test::irregular(6, 0.2, test::Kind::mixed), {{0.1, 0.2}, {0.7, 0.6}});
}

TEST(Near, LooksAtFewElementsOfALargeGrid) {
  const Mesh<2> mesh = make_grid({0, 0}, {10000, 10000}, {10000, 10000});
  int seen = 0;
  for_elements_near(mesh, Box{{5000, 5000}, {5001, 5001}}, [&](int) { ++seen; });
  EXPECT_LT(seen, 100);
}

TEST(Near, BoxAroundNodes) {
  const Mesh<2> mesh = make_grid({0, 0}, {3, 2}, {3, 2});
  const std::vector<int> nodes{1, 7, 4};
  const auto box = box_around<2>(mesh, nodes);
  EXPECT_EQ(box.low, (Vec<2>{0, 0}));
  EXPECT_EQ(box.high, (Vec<2>{3, 1}));
}

}  // namespace
}  // namespace scarp
