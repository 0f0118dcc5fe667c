// Filling solids: volume and first moments are kept to round-off, points lie inside, and the kinds of solid agree.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "base/surfaces.hpp"
#include "scarp/base/error.hpp"
#include "scarp/points/fill.hpp"
#include "scarp/points/surface_shares.hpp"
#include "totals.hpp"

namespace scarp::test {
namespace {

const Polygon slope{{0, 0}, {9, 0}, {9, 1}, {6, 1}, {3, 3}, {0, 3}};
const Polygon wedge{{0, 0}, {9, 0}, {3, 3}, {0, 3}};

std::vector<Solid> solids() {
  return {make_box({1, 2, 3}, {2, 4.5, 6}),
          Prism{slope, 1, -1, 4},
          Prism{slope, 0, -1, 4},
          Prism{slope, 2, -1, 4},
          Surface(box({1, 2, 3}, {2, 4.5, 6})),
          Surface(tilted(box({1, 2, 3}, {2, 4.5, 6}))),
          Surface(tetrahedron({5, 6, 7}, 2.5)),
          Surface(sphere(3, 1.7, {0.3, 0.2, 0.1})),
          Surface(turned(sphere(2, 1.7, {0.3, 0.2, 0.1}))),
          Surface(together(tilted(box({-2, -2, -2}, {2, 2, 2})), turned(sphere(2, 1.5, {})))),
          Surface(together(sphere(2, 1, {}), tilted(box({2, 0, 0}, {3, 1, 2}))))};
}

// 1e-12 of the volume: a few thousand pieces, each with a few roundings of 1e-16. Points of no more than one sliver may
// miss the solid: none does here.
TEST(FillSolid, KeepsVolumeAndCentroidAndStaysInside) {
  const auto all = solids();
  for (std::size_t s = 0; s < all.size(); ++s) {
    for (const double spacing : {50.0, 0.9, 0.31, 0.11}) {
      SCOPED_TRACE(testing::Message() << "solid " << s << ", spacing " << spacing);
      const auto filling = fill(all[s], spacing);
      ASSERT_GE(filling.volume.size(), 1u);
      const auto m = moments(all[s]);
      const auto sum = totals(filling, m.centroid);
      EXPECT_NEAR(sum.volume / m.volume, 1.0, 1e-12);
      for (int j = 0; j < 3; ++j) EXPECT_NEAR(sum.centroid[j], m.centroid[j], 1e-11);
      EXPECT_GT(*std::min_element(filling.volume.begin(), filling.volume.end()), 0.0);
      std::size_t outside = 0;
      for (const auto& x : filling.position) outside += !contains(all[s], x);
      EXPECT_EQ(outside, 0u);
    }
  }
}

// The filling of an extruded polygon is the plane one in every layer, to the last bit: a slope of finite width is the
// plane slope, repeated.
TEST(FillSolid, ExtrusionRepeatsThePlaneFilling) {
  const auto plane = fill(slope, 0.3);
  const auto solid = fill(Prism{slope, 1, 2, 3.5}, 0.3);
  const std::size_t n = plane.volume.size();
  ASSERT_EQ(solid.volume.size(), 5 * n);
  for (std::size_t i = 0; i < solid.volume.size(); ++i) {
    EXPECT_EQ(solid.position[i][0], plane.position[i % n][0]);
    EXPECT_EQ(solid.position[i][2], plane.position[i % n][1]);
    EXPECT_NEAR(solid.position[i][1], 2.15 + 0.3 * static_cast<double>(i / n), 1e-14);
    EXPECT_NEAR(solid.volume[i], 0.3 * plane.volume[i % n], 1e-15);
  }
}

// Cell by cell, a surface's shares are those of the same solid as an extruded polygon: two ways that have nothing in
// common but the lattice. Slopes and faces run through the cells, along their planes and through their corners.
TEST(FillSolid, SharesOfSurfaceAreThoseOfThePrism) {
  for (const double spacing : {0.25, 0.5, 0.37, 0.11}) {
    Lattice<3> lattice(bounds(Prism{wedge, 1, -1, 4}), spacing);
    find_shares(Surface(extruded(wedge, -1, 4)), lattice);
    Sum volume;
    lattice.for_each([&](const std::array<int, 3>& place, const Share<3>& share) {
      Vec<3> low, high;
      for (int j = 0; j < 3; ++j) {
        low[j] = lattice.edge(place[j], j);
        high[j] = lattice.edge(place[j] + 1, j);
      }
      const auto section = moments(clip_to_box(wedge, {low[0], low[2]}, {high[0], high[2]}));
      const double full = lattice.full_volume(), expected = section.area * (high[1] - low[1]);
      ASSERT_NEAR(share.volume, expected, 2e-13 * full);
      volume.add(share.volume);
      if (expected < 1e-6 * full) return;
      ASSERT_NEAR(share.centroid[0], section.centroid[0], 1e-9);
      ASSERT_NEAR(share.centroid[1], 0.5 * (low[1] + high[1]), 1e-9);
      ASSERT_NEAR(share.centroid[2], section.centroid[1], 1e-9);
    });
    EXPECT_NEAR(volume.value(), moments(wedge).area * 5, 1e-11);
  }
}

// ... and those of single boxes, on a solid that is nowhere along an axis.
TEST(FillSolid, SharesOfTheLatticeAreThoseOfItsBoxes) {
  const Surface surface(together(tilted(box({-2, -2, -2}, {2, 2, 2})), turned(sphere(2, 1.5, {}))));
  Lattice<3> lattice(surface.bounds(), 0.4);
  find_shares(surface, lattice);
  lattice.for_each([&](const std::array<int, 3>& place, const Share<3>& share) {
    Vec<3> low, high;
    for (int j = 0; j < 3; ++j) {
      low[j] = lattice.edge(place[j], j);
      high[j] = lattice.edge(place[j] + 1, j);
    }
    const auto single = surface.share(low, high);
    ASSERT_NEAR(share.volume, single.volume, 1e-12 * lattice.full_volume());
    for (int j = 0; share.volume > 1e-4 * lattice.full_volume() && j < 3; ++j)
      ASSERT_NEAR(share.centroid[j], single.centroid[j], 1e-9);
  });
}

TEST(FillSolid, BoxIsItsLattice) {
  for (const Solid& solid : {Solid(make_box({0, 0, 0}, {2, 1, 1.5})), Solid(Surface(box({0, 0, 0}, {2, 1, 1.5})))}) {
    const auto filling = fill(solid, 0.5);
    ASSERT_EQ(filling.volume.size(), 24u);
    for (std::size_t i = 0; i < 24; ++i) {
      EXPECT_NEAR(filling.position[i][0], 0.25 + 0.5 * static_cast<double>(i % 4), 1e-14);
      EXPECT_NEAR(filling.position[i][1], 0.25 + 0.5 * static_cast<double>(i / 4 % 2), 1e-14);
      EXPECT_NEAR(filling.position[i][2], 0.25 + 0.5 * static_cast<double>(i / 8), 1e-14);
      EXPECT_NEAR(filling.volume[i], 0.125, 1e-15);
    }
  }
}

// No point has less than the least share of a cell but where no neighbour could take it: nowhere on a convex solid as
// large as this.
TEST(FillSolid, SmallSharesAreMerged) {
  const auto filling = fill(Surface(sphere(4, 3, {})), 0.31);
  const double cell = std::pow(6.0 / 19, 3);
  for (const double v : filling.volume) {
    EXPECT_GE(v, least_cell_share * cell);
    EXPECT_LE(v, 2.5 * cell);
  }
}

TEST(FillSolid, FarFromTheOrigin) {
  const Solid solid = Surface(sphere(3, 10, {3e6, 4e6, 500}));
  const auto m = moments(solid);
  const auto sum = totals(fill(solid, 0.7), m.centroid);
  EXPECT_NEAR(sum.volume / m.volume, 1.0, 1e-12);
  for (int j = 0; j < 3; ++j) EXPECT_NEAR(sum.centroid[j], m.centroid[j], 2e-9);  // the spacing of doubles there
}

TEST(FillSolid, OverlapIsFoundAndTouchingIsNot) {
  const Solid left = make_box({0, 0, 0}, {2, 2, 2}), hill = Surface(tetrahedron({2, 0, 0}, 2));
  EXPECT_FALSE(overlap(left, fill(hill, 0.2)));
  EXPECT_FALSE(overlap(hill, fill(left, 0.2)));
  // In contact all over a face in one cell's thickness: points within round-off of it do not count.
  const Solid over = Surface(tetrahedron({1.9, 0, 0}, 2));
  const auto shared = overlap(left, fill(over, 0.1));
  ASSERT_TRUE(shared);
  EXPECT_LT((*shared)[0], 2.0);
  EXPECT_TRUE(overlap(over, fill(left, 0.1)));
}

// surface_fault() would refuse it; a filling that has not asked is told, too.
TEST(FillSolid, SurfaceThroughItselfIsRefused) {
  const Solid solid = Surface(together(box({0, 0, 0}, {2, 2, 2}), box({1, 1, 1}, {3, 3, 3})));
  try {
    fill(solid, 0.25);
    ADD_FAILURE() << "no error";
  } catch (const InputError& error) {
    EXPECT_NE(error.problem().find("passes through itself"), std::string::npos);
    EXPECT_NE(error.value().find("of which 2 is inside"), std::string::npos) << error.value();
  }
}

}  // namespace
}  // namespace scarp::test
