#include "scarp/mesh/locate.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "meshes.hpp"

namespace scarp {
namespace {

using test::Kind;

std::int64_t found(const SearchCounts& c) {
  return c.own + c.surrounding + c.walked + c.searched_all;
}

void expect_at(const Mesh<2>& mesh, const Location<2>& at, const Vec<2>& x) {
  ASSERT_GE(at.element, 0);
  with_shape<2>(mesh.type_of(at.element), [&]<class Shape>(Shape) {
    const Vec<2> back = global_coordinates<Shape>(node_positions<Shape>(mesh, at.element), at.xi);
    EXPECT_NEAR(back[0], x[0], 1e-12);
    EXPECT_NEAR(back[1], x[1], 1e-12);
  });
}

class AnyMesh : public testing::TestWithParam<Kind> {};
INSTANTIATE_TEST_SUITE_P(Locate, AnyMesh, testing::Values(Kind::quads, Kind::triangles, Kind::mixed));

// Oracle: the signs of cross products in every element. Random points lie on no edge.
TEST_P(AnyMesh, FindsRandomPointsFromAnyHint) {
  const Mesh<2> mesh = test::irregular(24, 0.3, GetParam());
  const Locator<2> locator(mesh);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> u(-0.1, 1.1);
  SearchCounts counts;
  std::int64_t outside = 0, steps = 0, most = 0;
  for (int i = 0; i < 4000; ++i) {
    const Vec<2> x = {u(random), u(random)};
    const int hint = static_cast<int>(random() % mesh.element_count()) - (i % 7 == 0 ? mesh.element_count() : 0);
    const Location<2> at = locator.find(x, std::max(hint, -1), counts);
    const int expected = test::first_that_contains(mesh, x);
    ASSERT_EQ(at.element, expected);
    ASSERT_EQ(locator.find_anywhere(x).element, expected);
    if (expected >= 0) expect_at(mesh, at, x);
    outside += expected < 0;
    steps += at.steps;
    most = std::max<std::int64_t>(most, at.steps);
  }
  EXPECT_EQ(counts.searches(), 4000);
  EXPECT_EQ(counts.lost, outside);
  EXPECT_EQ(found(counts), 4000 - outside);
  EXPECT_EQ(counts.elements_examined, steps);
  EXPECT_EQ(counts.most_examined, most);
  EXPECT_GT(counts.walked, 100);
  EXPECT_GT(counts.searched_all, 100);
}

// A point that moves by a small part of an element never needs more than the elements around.
TEST_P(AnyMesh, SmallMovesEndInTheOwnOrSurroundingElements) {
  const Mesh<2> mesh = test::irregular(24, 0.3, GetParam());
  const Locator<2> locator(mesh);
  std::mt19937 random(6);
  std::uniform_real_distribution<double> u(0.1, 0.9), move(-0.005, 0.005);
  SearchCounts counts;
  for (int point = 0; point < 200; ++point) {
    Vec<2> x = {u(random), u(random)};
    int element = locator.find_anywhere(x).element;
    for (int step = 0; step < 20; ++step) {
      for (double& coordinate : x) coordinate = std::clamp(coordinate + move(random), 0.05, 0.95);
      const Location<2> at = locator.find(x, element, counts);
      ASSERT_EQ(at.element, test::first_that_contains(mesh, x));
      element = at.element;
    }
  }
  EXPECT_EQ(counts.own + counts.surrounding, 4000);
  EXPECT_GT(counts.surrounding, 100);
  EXPECT_GT(counts.own, 2000);
}

// Oracle: the distance in elements. Four elements away the walk must arrive, and it need not look at more than the
// elements around its way.
TEST_P(AnyMesh, WalksAcrossSeveralElements) {
  const Mesh<2> mesh = test::irregular(40, 0.3, GetParam());
  const Locator<2> locator(mesh);
  std::mt19937 random(8);
  std::uniform_real_distribution<double> u(0.2, 0.8), angle(0, 6.28);
  SearchCounts counts;
  for (int i = 0; i < 500; ++i) {
    const Vec<2> from = {u(random), u(random)};
    const double a = angle(random);
    const Vec<2> to = {from[0] + 0.12 * std::cos(a), from[1] + 0.12 * std::sin(a)};
    const Location<2> at = locator.find(to, locator.find_anywhere(from).element, counts);
    ASSERT_EQ(at.element, test::first_that_contains(mesh, to));
  }
  EXPECT_EQ(counts.walked, 500);
  EXPECT_LE(counts.most_examined, Locator<2>::walk_limit);
  EXPECT_LT(counts.elements_examined / 500, 60);
}

// A wide slot between the old and the new place: the walk does not get round it, all elements are searched, and the
// number examined stays within the walk's limit and a few of a bin.
TEST_P(AnyMesh, SearchesAllBeyondAHole) {
  const Mesh<2> mesh =
      test::irregular(40, 0.2, GetParam(), [](double x, double y) { return x > 0.45 && x < 0.55 && y < 0.9; });
  const Locator<2> locator(mesh);
  SearchCounts counts;
  const Vec<2> left = {0.25, 0.1}, right = {0.45, 0.1};  // grading halves x about the middle
  const int from = locator.find_anywhere(left).element, expected = test::first_that_contains(mesh, right);
  ASSERT_GE(from, 0);
  ASSERT_GE(expected, 0);
  EXPECT_EQ(locator.find(right, from, counts).element, expected);
  EXPECT_EQ(counts.searched_all, 1);
  EXPECT_LE(counts.most_examined, Locator<2>::walk_limit + 40);
  // In the hole there is no element.
  const Vec<2> in_hole = {0.375, 0.1};
  ASSERT_EQ(test::first_that_contains(mesh, in_hole), -1);
  EXPECT_EQ(locator.find(in_hole, from, counts).element, -1);
  EXPECT_EQ(counts.lost, 1);
}

// Nodes and edge midpoints belong to several elements: the hint keeps them, else the lowest index takes them, whatever
// way the search goes. Midpoints are inside by round-off only.
TEST_P(AnyMesh, DecidesSharedPointsAlike) {
  const Mesh<2> mesh = test::irregular(12, 0.3, GetParam());
  const Locator<2> locator(mesh);
  std::mt19937 random(9);
  const auto check = [&](const Vec<2>& x) {
    const int lowest = test::first_that_contains(mesh, x, 1e-14);
    ASSERT_EQ(locator.find_anywhere(x).element, lowest);
    SearchCounts counts;
    for (int i = 0; i < 10; ++i) {
      const int hint = static_cast<int>(random() % mesh.element_count());
      const bool own = test::contains(mesh, hint, x, 1e-14);
      ASSERT_EQ(locator.find(x, hint, counts).element, own ? hint : lowest);
    }
    for (int hint = 0; hint < mesh.element_count(); ++hint)
      if (test::contains(mesh, hint, x, 1e-14)) {
        ASSERT_EQ(locator.find(x, hint, counts).element, hint);
        for (int near : mesh.elements_around(hint))
          if (!test::contains(mesh, near, x, 1e-14)) {
            ASSERT_EQ(locator.find(x, near, counts).element, lowest);
          }
      }
  };
  for (const Vec<2>& x : mesh.lists.nodes) check(x);
  for (int e = 0; e < mesh.element_count(); ++e) {
    const auto nodes = mesh.element_nodes(e);
    const Vec<2>&a = mesh.node(nodes[0]), &b = mesh.node(nodes[1]);
    check({0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])});
  }
}

TEST_P(AnyMesh, CountsRoundOffOutsideAsInside) {
  const Mesh<2> mesh = test::irregular(12, 0.3, GetParam());
  const Locator<2> locator(mesh);
  const double size = 1.0 / 12;
  EXPECT_GE(locator.find_anywhere({-1e-11 * size, 0.43}).element, 0);
  EXPECT_GE(locator.find_anywhere({0.43, 1 + 1e-11 * size}).element, 0);
  EXPECT_GE(locator.find_anywhere({1 + 1e-11 * size, 1 + 1e-11 * size}).element, 0);
  EXPECT_EQ(locator.find_anywhere({-1e-8 * size, 0.43}).element, -1);
  EXPECT_EQ(locator.find_anywhere({0.43, 1 + 1e-8 * size}).element, -1);
}

TEST_P(AnyMesh, TakesPointsThatAreNoNumbersAsLost) {
  const Mesh<2> mesh = test::irregular(6, 0.2, GetParam());
  const Locator<2> locator(mesh);
  const double nan = std::nan(""), inf = std::numeric_limits<double>::infinity();
  SearchCounts counts;
  for (const Vec<2>& x :
       {Vec<2>{nan, 0.5}, Vec<2>{0.5, nan}, Vec<2>{inf, 0.5}, Vec<2>{0.5, -inf}, Vec<2>{1e300, -1e300}})
    for (int hint : {-1, 0, 20}) EXPECT_EQ(locator.find(x, hint, counts).element, -1);
  EXPECT_EQ(counts.lost, 15);
}

// Far from the origin a coordinate's own round-off exceeds 1e-10 of an element; points on edges must still be found.
TEST(Locate, KeepsPointsOnEdgesFarFromTheOrigin) {
  Mesh<2> mesh = test::irregular(10, 0.3, Kind::mixed);
  for (Vec<2>& x : mesh.lists.nodes)
    for (double& coordinate : x) coordinate += 5e6;
  const Locator<2> locator(mesh);
  EXPECT_GT(locator.tolerance(), 1e-10);
  for (int e = 0; e < mesh.element_count(); ++e) {
    const auto nodes = mesh.element_nodes(e);
    for (double part : {0.0, 0.1, 0.37, 0.5}) {
      Vec<2> x;
      for (int k = 0; k < 2; ++k) x[k] = (1 - part) * mesh.node(nodes[0])[k] + part * mesh.node(nodes[1])[k];
      EXPECT_GE(locator.find_anywhere(x).element, 0);
      SearchCounts counts;
      EXPECT_GE(locator.find(x, e, counts).element, 0);
    }
  }
}

// A grid and the same rectangles without the grid descriptor must tell the same element, on lines and outside too.
TEST(Locate, GridAgreesWithTheSameElementsSearched) {
  const Mesh<2> grid = make_grid({-1, 2}, {3, 2}, {12, 10});
  const Mesh<2> plain = test::as_lists(grid);
  const Locator<2> direct(grid), searched(plain);
  std::mt19937 random(10);
  std::uniform_real_distribution<double> ux(-1.2, 2.2), uy(1.8, 4.2);
  SearchCounts a, b;
  int lost = 0;
  for (int i = 0; i < 20000; ++i) {
    Vec<2> x = {ux(random), uy(random)};
    if (i % 3 == 1) x[0] = grid.node(static_cast<int>(random() % grid.node_count()))[0];
    if (i % 3 == 2) x = grid.node(static_cast<int>(random() % grid.node_count()));
    const int hint = static_cast<int>(random() % (grid.element_count() + 1)) - 1;
    const Location<2> p = direct.find(x, hint, a), q = searched.find(x, hint, b);
    ASSERT_EQ(p.element, q.element);
    lost += p.element < 0;
    for (int k = 0; k < 2 && p.element >= 0; ++k) ASSERT_NEAR(p.xi[k], q.xi[k], 1e-13);
  }
  EXPECT_GT(lost, 500);
  EXPECT_EQ(a.own, b.own);
  EXPECT_EQ(a.lost, b.lost);
  EXPECT_EQ(a.searches(), 20000);
  EXPECT_EQ(a.most_examined, 2);
}

TEST(Locate, GridCountsByHowFarElementsAreApart) {
  const Mesh<2> mesh = make_grid({0, 0}, {4, 4}, {4, 4});
  const Locator<2> locator(mesh);
  SearchCounts counts;
  EXPECT_EQ(locator.find({0.5, 0.5}, 0, counts).element, 0);
  EXPECT_EQ(locator.find({1.5, 1.5}, 0, counts).element, 5);
  EXPECT_EQ(locator.find({2.5, 0.5}, 0, counts).element, 2);
  EXPECT_EQ(locator.find({2.5, 0.5}, -1, counts).element, 2);
  EXPECT_EQ(locator.find({4.5, 0.5}, 0, counts).element, -1);
  EXPECT_EQ(counts.own, 1);
  EXPECT_EQ(counts.surrounding, 1);
  EXPECT_EQ(counts.walked, 1);
  EXPECT_EQ(counts.searched_all, 1);
  EXPECT_EQ(counts.lost, 1);
  EXPECT_EQ(locator.find({4, 4}, -1, counts).element, 15);
  EXPECT_EQ(locator.find({std::nan(""), 0.5}, 3, counts).element, -1);
  EXPECT_EQ(locator.find({0.5, 1e300}, 3, counts).element, -1);
}

TEST(SearchCounts, AddUpOverThreads) {
  SearchCounts a, b;
  a.add(&SearchCounts::own, 1);
  b.add(&SearchCounts::walked, 17);
  b.add(&SearchCounts::lost, 5);
  a += b;
  EXPECT_EQ(a.searches(), 3);
  EXPECT_EQ(a.walked, 1);
  EXPECT_EQ(a.elements_examined, 23);
  EXPECT_EQ(a.most_examined, 17);
}

}  // namespace
}  // namespace scarp
