// Grids, whose nodes and elements follow from numbers, against the same written down one by one.
#include "scarp/mesh/lattice.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <vector>

#include "listed.hpp"
#include "scarp/base/error.hpp"
#include "scarp/mesh/shapes.hpp"

namespace scarp {
namespace {

constexpr std::array all_functions{GridFunctions::linear, GridFunctions::gimp, GridFunctions::b_spline};

/// To the last bit.
template <int Dim>
void expect_what_is_written_down(const Vec<Dim>& origin, const Vec<Dim>& size, const std::array<int, Dim>& elements) {
  for (const auto functions : all_functions) {
    SCOPED_TRACE(static_cast<int>(functions));
    const Mesh<Dim> mesh = make_grid<Dim>(origin, size, elements, functions);
    const MeshLists<Dim> lists = test::written_down<Dim>(origin, size, elements, functions);
    ASSERT_EQ(mesh.node_count(), static_cast<int>(lists.nodes.size()));
    ASSERT_EQ(mesh.element_count(), static_cast<int>(lists.types.size()));
    for (int n = 0; n < mesh.node_count(); ++n) ASSERT_EQ(mesh.node(n), lists.nodes[n]) << "node " << n;
    for (int e = 0; e < mesh.element_count(); ++e) {
      ASSERT_EQ(mesh.type_of(e), lists.types[e]);
      const std::vector<int> expected(lists.connectivity.begin() + lists.offsets[e],
                                      lists.connectivity.begin() + lists.offsets[e + 1]);
      const auto nodes = mesh.element_nodes(e);
      ASSERT_EQ(std::vector<int>(nodes.begin(), nodes.end()), expected) << "element " << e;
      std::vector<Vec<Dim>> places, expected_places;
      mesh.for_local_positions(e, [&](const Vec<Dim>& x) { places.push_back(x); });
      for (const int n : expected) expected_places.push_back(lists.nodes[n]);
      ASSERT_EQ(places, expected_places) << "element " << e;
      ASSERT_EQ(mesh.grid->element_at(mesh.grid->cell(e)), e);
    }
  }
}

TEST(Lattice, HasTheNodesAndElementsOfAGridThatIsWrittenDown) {
  expect_what_is_written_down<2>({0.1, -2.3}, {0.7, 0.3}, {49, 7});
  expect_what_is_written_down<2>({-5, 3}, {1.1, 2.2}, {1, 13});
  expect_what_is_written_down<2>({0, 0}, {1, 1}, {1, 1});
  expect_what_is_written_down<3>({0.1, -2.3, 7.7}, {0.7, 0.3, 1.3}, {7, 5, 3});
  expect_what_is_written_down<3>({0, 0, 0}, {1, 2, 3}, {1, 1, 4});
  expect_what_is_written_down<3>({0, 0, 0}, {1, 2, 3}, {3, 1, 1});
}

// Oracles: the general formula of a quadrilateral's or hexahedron's least height (element_size), to the last bit, of
// each element and of all; the sides, found among all nodes.
template <int Dim>
void expect_sizes_and_sides_of_lists(const Vec<Dim>& origin, const Vec<Dim>& size,
                                     const std::array<int, Dim>& elements) {
  const Mesh<Dim> mesh = make_grid<Dim>(origin, size, elements);
  Mesh<Dim> plain;
  plain.lists = test::written_down<Dim>(origin, size, elements, GridFunctions::linear);
  complete(plain);
  for (int e = 0; e < mesh.element_count(); ++e) ASSERT_EQ(mesh.size_of(e), plain.size_of(e)) << "element " << e;
  EXPECT_EQ(least_size(mesh), *std::min_element(plain.lists.size.begin(), plain.lists.size.end()));
  EXPECT_EQ(bounds(mesh).low, bounds(plain).low);
  EXPECT_EQ(bounds(mesh).high, bounds(plain).high);
  EXPECT_EQ(largest_coordinate(mesh), largest_coordinate(plain));
  EXPECT_EQ(mesh.node_sets, plain.node_sets);
}

TEST(Lattice, HasTheSizesAndSidesOfItsElements) {
  expect_sizes_and_sides_of_lists<2>({0.1, -2.3}, {0.7, 0.3}, {49, 7});
  expect_sizes_and_sides_of_lists<2>({1234.5, 0}, {10, 0.1}, {70, 33});
  expect_sizes_and_sides_of_lists<2>({-0.3, 0.9}, {1, 1}, {30, 30});
  expect_sizes_and_sides_of_lists<3>({0.1, -2.3, 17.7}, {0.7, 0.3, 1.3}, {7, 5, 6});
  expect_sizes_and_sides_of_lists<3>({0.1, 0.2, 0.3}, {0.9, 1.1, 1.0}, {10, 11, 12});
}

// Oracle: √(4/5.4) of the cell at the sides of a grid of B-splines, where functions are narrower (docs/theory.md).
TEST(Lattice, HasShorterElementsAtTheSidesOfSplines) {
  const Mesh<3> mesh = make_grid<3>({0, 0, 0}, {8, 5, 6}, {4, 5, 3}, GridFunctions::b_spline);
  int inside = 0;
  for (int e = 0; e < mesh.element_count(); ++e) {
    const auto [x, y, z] = mesh.grid->cell(e);
    const bool at_side = x % 3 == 0 || y % 4 == 0 || z % 2 == 0;
    EXPECT_DOUBLE_EQ(mesh.size_of(e), at_side ? std::sqrt(4 / 5.4) : 1.0);
    inside += !at_side;
  }
  EXPECT_EQ(inside, 2 * 3 * 1);
  EXPECT_DOUBLE_EQ(least_size(mesh), std::sqrt(4 / 5.4));
  EXPECT_DOUBLE_EQ(least_size(make_grid<3>({0, 0, 0}, {8, 5, 6}, {4, 5, 3}, GridFunctions::gimp)), 1);
}

// A thousand million elements take no memory but for their lines and sides; numbers go up to the limit.
TEST(Lattice, TakesNoMemoryForItsElements) {
  const Mesh<2> mesh = make_grid({0, 0}, {40000, 30000}, {40000, 30000});
  ASSERT_EQ(mesh.element_count(), 1'200'000'000);
  const int e = mesh.element_count() - 1;
  EXPECT_EQ(mesh.grid->cell(e), (std::array{39999, 29999}));
  const auto nodes = mesh.element_nodes(e);
  EXPECT_EQ(nodes[2], mesh.node_count() - 1);
  EXPECT_EQ(mesh.node(nodes[2]), (Vec<2>{40000, 30000}));
  EXPECT_EQ(mesh.node(nodes[0]), (Vec<2>{39999, 29999}));
  EXPECT_EQ(mesh.node_sets.at("right").back(), mesh.node_count() - 1);
}

void expect_too_many(const std::array<int, 2>& elements) {
  try {
    make_grid({0, 0}, {elements[0] * 1.0, elements[1] * 1.0}, elements);
    FAIL() << "made";
  } catch (const InputError& error) {
    EXPECT_NE(error.problem().find("2000000000 elements"), std::string::npos) << error.what();
    EXPECT_NE(error.problem().find("32 bits"), std::string::npos) << error.what();
    EXPECT_EQ(error.value(), std::to_string(elements[0]) + " x " + std::to_string(elements[1]) + " elements");
  }
}

TEST(Lattice, RefusesMoreElementsOrNodesThanNumbers) {
  expect_too_many({2'000'000, 2'000'000});
  expect_too_many({50'000, 40'001});    // just more elements
  expect_too_many({1'000'000'000, 1});  // 2·10⁹ + 2 nodes
  expect_too_many({2'000'000'001, 1});
}

}  // namespace
}  // namespace scarp
