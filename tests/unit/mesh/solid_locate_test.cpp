// Finding the elements of points in space. The oracles need no inverse of the map: points are made from local
// coordinates in a known element, and points on boundaries from nodes, so that which elements hold them is a matter of
// their numbers.
#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "scarp/mesh/locate.hpp"
#include "solids.hpp"

namespace scarp {
namespace {

using test::Solid;

/// A random point of element e.
Vec<3> point_in(const Mesh<3>& mesh, int e, std::mt19937& random, double margin = 1e-3) {
  return with_shape<3>(mesh.type_of(e), [&]<class Shape>(Shape) {
    return global_coordinates<Shape>(node_positions<Shape>(mesh, e), test::point_inside<Shape>(random, margin));
  });
}

void expect_at(const Mesh<3>& mesh, const Location<3>& at, const Vec<3>& x) {
  ASSERT_GE(at.element, 0);
  with_shape<3>(mesh.type_of(at.element), [&]<class Shape>(Shape) {
    const Vec<3> back = global_coordinates<Shape>(node_positions<Shape>(mesh, at.element), at.xi);
    for (int k = 0; k < 3; ++k) EXPECT_NEAR(back[k], x[k], 1e-12);
  });
}

int any_element(const Mesh<3>& mesh, std::mt19937& random) {
  return static_cast<int>(random() % mesh.element_count());
}

class AnySolid : public testing::TestWithParam<Solid> {
 protected:
  std::mt19937 random{5};
};
INSTANTIATE_TEST_SUITE_P(Locate, AnySolid, testing::Values(Solid::hexahedra, Solid::tetrahedra, Solid::mixed));

TEST_P(AnySolid, FindsRandomPointsFromAnyHint) {
  const Mesh<3> mesh = test::irregular(10, 0.2, GetParam());
  const Locator<3> locator(mesh);
  SearchCounts counts;
  std::int64_t steps = 0;
  for (int i = 0; i < 4000; ++i) {
    const int expected = any_element(mesh, random);
    const Vec<3> x = point_in(mesh, expected, random);
    const Location<3> at = locator.find(x, i % 7 == 0 ? -1 : any_element(mesh, random), counts);
    ASSERT_EQ(at.element, expected);
    ASSERT_EQ(locator.find_anywhere(x).element, expected);
    expect_at(mesh, at, x);
    steps += at.steps;
  }
  EXPECT_EQ(counts.searches(), 4000);
  EXPECT_EQ(counts.lost, 0);
  EXPECT_EQ(counts.elements_examined, steps);
  EXPECT_GT(counts.walked, 100);
  EXPECT_GT(counts.searched_all, 100);
}

// Oracle: the unit cube, which the mesh fills.
TEST_P(AnySolid, LosesPointsOutsideAndFindsAllInside) {
  const Mesh<3> mesh = test::irregular(6, 0.2, GetParam());
  const Locator<3> locator(mesh);
  std::uniform_real_distribution<double> u(-0.3, 1.3);
  SearchCounts counts;
  int outside = 0;
  for (int i = 0; i < 4000; ++i) {
    const Vec<3> x = {u(random), u(random), u(random)};
    const bool in = *std::min_element(x.begin(), x.end()) > 0 && *std::max_element(x.begin(), x.end()) < 1;
    const Location<3> at = locator.find(x, any_element(mesh, random), counts);
    ASSERT_EQ(at.element >= 0, in);
    if (in) expect_at(mesh, at, x);
    outside += !in;
  }
  EXPECT_EQ(counts.lost, outside);
  EXPECT_GT(4000 - outside, 500);
}

// A point that moves by a small part of an element never needs more than the elements around.
TEST_P(AnySolid, SmallMovesEndInTheOwnOrSurroundingElements) {
  const Mesh<3> mesh = test::irregular(8, 0.2, GetParam());
  const Locator<3> locator(mesh);
  std::uniform_real_distribution<double> u(0.1, 0.9), move(-0.01, 0.01);
  SearchCounts counts;
  for (int point = 0; point < 200; ++point) {
    Vec<3> x = {u(random), u(random), u(random)};
    int element = locator.find_anywhere(x).element;
    for (int step = 0; step < 20; ++step) {
      for (double& coordinate : x) coordinate = std::clamp(coordinate + move(random), 0.05, 0.95);
      const Location<3> at = locator.find(x, element, counts);
      expect_at(mesh, at, x);
      element = at.element;
    }
  }
  EXPECT_EQ(counts.own + counts.surrounding, 4000);
  EXPECT_GT(counts.surrounding, 100);
  EXPECT_GT(counts.own, 1000);
}

// Two and a half elements away the walk must arrive without looking at all.
TEST_P(AnySolid, WalksAcrossSeveralElements) {
  const Mesh<3> mesh = test::irregular(14, 0.2, GetParam());
  const Locator<3> locator(mesh);
  std::uniform_real_distribution<double> u(0.3, 0.7), part(-1, 1);
  SearchCounts counts;
  for (int i = 0; i < 300; ++i) {
    const Vec<3> from = {u(random), u(random), u(random)};
    Vec<3> way = {part(random), part(random), part(random)}, to;
    for (int k = 0; k < 3; ++k) to[k] = from[k] + 0.18 * way[k] / detail::norm(way);
    expect_at(mesh, locator.find(to, locator.find_anywhere(from).element, counts), to);
  }
  EXPECT_EQ(counts.walked + counts.surrounding, 300);
  EXPECT_GT(counts.walked, 250);
  EXPECT_LE(counts.most_examined, Locator<3>::walk_limit + 100);  // and the lower neighbours of the one found
}

// Nodes, middles of edges and of faces belong to the elements that have all nodes of that edge or face: the hint keeps
// them, else the lowest index takes them, whatever way the search goes.
TEST_P(AnySolid, DecidesSharedPointsAlike) {
  const Mesh<3> mesh = test::irregular(5, 0.2, GetParam());
  const Locator<3> locator(mesh);
  const auto has = [&](int e, const std::vector<int>& nodes) {
    const auto of = mesh.element_nodes(e);
    return std::all_of(nodes.begin(), nodes.end(),
                       [&](int n) { return std::find(of.begin(), of.end(), n) != of.end(); });
  };
  const auto check = [&](int e, const std::vector<int>& nodes) {
    Vec<3> x{};
    for (int n : nodes)
      for (int k = 0; k < 3; ++k) x[k] += mesh.node(n)[k] / static_cast<double>(nodes.size());
    std::vector<int> hints = {e, any_element(mesh, random), any_element(mesh, random)};
    for (int near : mesh.elements_around(e)) hints.push_back(near);
    int lowest = 0;
    while (!has(lowest, nodes)) ++lowest;
    ASSERT_EQ(locator.find_anywhere(x).element, lowest);
    SearchCounts counts;
    for (int hint : hints) ASSERT_EQ(locator.find(x, hint, counts).element, has(hint, nodes) ? hint : lowest);
  };
  for (int e = 0; e < mesh.element_count(); e += mesh.element_count() / 60)
    with_shape<3>(mesh.type_of(e), [&]<class Shape>(Shape) {
      const auto nodes = mesh.element_nodes(e);
      for (int n : nodes) check(e, {n});
      for (const auto& side : Shape::sides) {
        std::vector<int> all;
        for (int i : side) all.push_back(nodes[i]);
        check(e, {all[0], all[1]});
        // Across the plane between the halves of a mixed mesh triangles meet quadrilaterals.
        bool between = GetParam() == Solid::mixed;
        for (int n : all) between = between && mesh.node(n)[0] == mesh.node(all[0])[0];
        if (!between) check(e, all);
      }
    });
}

TEST_P(AnySolid, CountsRoundOffOutsideAsInside) {
  const Mesh<3> mesh = test::irregular(6, 0.2, GetParam());
  const Locator<3> locator(mesh);
  const double size = 1.0 / 6;
  EXPECT_GE(locator.find_anywhere({-1e-12 * size, 0.43, 0.37}).element, 0);
  EXPECT_GE(locator.find_anywhere({0.43, 0.37, 1 + 1e-12 * size}).element, 0);
  EXPECT_GE(locator.find_anywhere({1 + 1e-12 * size, 1 + 1e-12 * size, 1 + 1e-12 * size}).element, 0);
  EXPECT_EQ(locator.find_anywhere({-1e-8 * size, 0.43, 0.37}).element, -1);
  EXPECT_EQ(locator.find_anywhere({0.43, 0.37, 1 + 1e-8 * size}).element, -1);
}

TEST_P(AnySolid, TakesPointsThatAreNoNumbersAsLost) {
  const Mesh<3> mesh = test::irregular(4, 0.2, GetParam());
  const Locator<3> locator(mesh);
  const double nan = std::nan(""), inf = std::numeric_limits<double>::infinity();
  SearchCounts counts;
  for (const Vec<3>& x : {Vec<3>{nan, 0.5, 0.5}, Vec<3>{0.5, nan, 0.5}, Vec<3>{0.5, 0.5, nan}, Vec<3>{inf, 0.5, 0.5},
                          Vec<3>{0.5, 0.5, -inf}, Vec<3>{1e300, -1e300, 1e300}})
    for (int hint : {-1, 0, 20}) EXPECT_EQ(locator.find(x, hint, counts).element, -1);
  EXPECT_EQ(counts.lost, 18);
}

// Far from the origin a coordinate's own round-off exceeds 1e-10 of an element; points on edges must still be found.
TEST_P(AnySolid, KeepsPointsOnEdgesFarFromTheOrigin) {
  Mesh<3> mesh = test::irregular(5, 0.2, GetParam());
  for (Vec<3>& x : mesh.lists.nodes)
    for (double& coordinate : x) coordinate += 5e6;
  const Locator<3> locator(mesh);
  EXPECT_GT(locator.tolerance(), 1e-10);
  for (int e = 0; e < mesh.element_count(); ++e) {
    const auto nodes = mesh.element_nodes(e);
    for (double part : {0.0, 0.1, 0.37, 0.5}) {
      Vec<3> x;
      for (int k = 0; k < 3; ++k) x[k] = (1 - part) * mesh.node(nodes[0])[k] + part * mesh.node(nodes[1])[k];
      EXPECT_GE(locator.find_anywhere(x).element, 0);
      SearchCounts counts;
      EXPECT_GE(locator.find(x, e, counts).element, 0);
    }
  }
}

// A grid and the same boxes without the grid descriptor must tell the same element, on faces, lines and outside too.
TEST(LocateSolid, GridAgreesWithTheSameElementsSearched) {
  const Mesh<3> grid = make_grid<3>({-1, 2, 0}, {3, 2, 1.5}, {9, 7, 5});
  const Mesh<3> plain = test::as_lists(grid);
  const Locator<3> direct(grid), searched(plain);
  std::mt19937 random(10);
  std::uniform_real_distribution<double> ux(-1.2, 2.2), uy(1.8, 4.2), uz(-0.1, 1.6);
  SearchCounts a, b;
  int lost = 0;
  for (int i = 0; i < 20000; ++i) {
    Vec<3> x = {ux(random), uy(random), uz(random)};
    const Vec<3>& node = grid.node(static_cast<int>(random() % grid.node_count()));
    for (int k = 0; k < i % 4; ++k) x[(k + i / 4) % 3] = node[(k + i / 4) % 3];
    const int hint = static_cast<int>(random() % (grid.element_count() + 1)) - 1;
    const Location<3> p = direct.find(x, hint, a), q = searched.find(x, hint, b);
    ASSERT_EQ(p.element, q.element);
    lost += p.element < 0;
    for (int k = 0; k < 3 && p.element >= 0; ++k) ASSERT_NEAR(p.xi[k], q.xi[k], 1e-13);
  }
  EXPECT_GT(lost, 500);
  EXPECT_EQ(a.own, b.own);
  EXPECT_EQ(a.lost, b.lost);
  EXPECT_EQ(a.searches(), 20000);
  EXPECT_EQ(a.most_examined, 2);
}

TEST(LocateSolid, GridCountsByHowFarElementsAreApart) {
  const Mesh<3> mesh = make_grid<3>({0, 0, 0}, {4, 4, 4}, {4, 4, 4});
  const Locator<3> locator(mesh);
  SearchCounts counts;
  EXPECT_EQ(locator.find({0.5, 0.5, 0.5}, 0, counts).element, 0);
  EXPECT_EQ(locator.find({1.5, 1.5, 1.5}, 0, counts).element, 1 + 4 + 16);
  EXPECT_EQ(locator.find({0.5, 0.5, 2.5}, 0, counts).element, 32);
  EXPECT_EQ(locator.find({0.5, 2.5, 0.5}, -1, counts).element, 8);
  EXPECT_EQ(locator.find({0.5, 0.5, 4.5}, 0, counts).element, -1);
  EXPECT_EQ(counts.own, 1);
  EXPECT_EQ(counts.surrounding, 1);
  EXPECT_EQ(counts.walked, 1);
  EXPECT_EQ(counts.searched_all, 1);
  EXPECT_EQ(counts.lost, 1);
  EXPECT_EQ(locator.find({4, 4, 4}, -1, counts).element, 63);
}

// A plate so thin that cubes of an element's volume would be far more than its elements: memory stays in bounds.
TEST(LocateSolid, BinsOfAThinPlateStayAsManyAsItsElements) {
  const Mesh<3> plate = test::as_lists(make_grid<3>({0, 0, 0}, {1, 1, 1e-5}, {30, 30, 1}));
  const Locator<3> locator(plate);
  std::mt19937 random(2);
  for (int e = 0; e < plate.element_count(); ++e)
    ASSERT_EQ(locator.find_anywhere(point_in(plate, e, random)).element, e);
}

}  // namespace
}  // namespace scarp
