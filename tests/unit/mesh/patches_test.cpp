// Patches of triangles and tetrahedra.
#include "scarp/mesh/patches.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "meshes.hpp"
#include "solids.hpp"

namespace scarp::test {
namespace {

/// Every simplex is in one patch, and no other element in any.
template <int Dim>
void expect_partition(const Mesh<Dim>& mesh, const Patches& patches) {
  std::vector<int> count(mesh.element_count(), 0);
  for (int k = 0; k < patches.size(); ++k) {
    EXPECT_TRUE(std::is_sorted(patches.elements(k).begin(), patches.elements(k).end()));
    for (const int e : patches.elements(k)) {
      ++count[e];
      EXPECT_EQ(patches.around(e).data(), patches.elements(k).data());
    }
  }
  for (int e = 0; e < mesh.element_count(); ++e)
    EXPECT_EQ(count[e], mesh.element_nodes(e).size() == Dim + 1 ? 1 : 0) << "element " << e;
}

/// Does every element of a patch of several share a side with another of it?
template <int Dim>
void expect_connected(const Mesh<Dim>& mesh, const Patches& patches) {
  for (int k = 0; k < patches.size(); ++k) {
    const auto elements = patches.elements(k);
    if (elements.size() == 1) continue;
    for (const int e : elements) {
      const auto n = mesh.element_nodes(e);
      const std::set<int> own(n.begin(), n.end());
      const bool beside = std::any_of(elements.begin(), elements.end(), [&](int other) {
        const auto m = mesh.element_nodes(other);
        return other != e && std::count_if(m.begin(), m.end(), [&](int i) { return own.count(i) > 0; }) == Dim;
      });
      EXPECT_TRUE(beside) << "element " << e << " of patch " << k;
    }
  }
}

TEST(Patches, NoneWithoutSimplices) {
  EXPECT_TRUE(Patches().empty());
  EXPECT_TRUE(Patches(make_grid({0, 0}, {1, 1}, {4, 4})).empty());
  EXPECT_TRUE(Patches(irregular(4, 0.2, Kind::quads)).empty());
}

TEST(Patches, AreTheSquaresThatTrianglesWereCutFrom) {
  // irregular() writes both triangles of a square one after the other, cut this way or that at random.
  const auto mesh = irregular(8, 0, Kind::triangles);
  const Patches patches(mesh);
  expect_partition(mesh, patches);
  // Graded squares are rectangles: the diagonal is their longest edge all the same.
  ASSERT_EQ(patches.size(), 64);
  for (int e = 0; e < mesh.element_count(); ++e) {
    ASSERT_EQ(patches.around(e).size(), 2u);
    EXPECT_EQ(patches.around(e)[0], e / 2 * 2);
    EXPECT_EQ(patches.around(e)[1], e / 2 * 2 + 1);
  }
}

TEST(Patches, AreTheCubesThatTetrahedraWereCutFrom) {
  const auto mesh = irregular(4, 0, Solid::tetrahedra);
  const Patches patches(mesh);
  expect_partition(mesh, patches);
  ASSERT_EQ(patches.size(), 64);
  for (int e = 0; e < mesh.element_count(); ++e) {
    ASSERT_EQ(patches.around(e).size(), 6u);
    EXPECT_EQ(patches.around(e)[0], e / 6 * 6);
  }
}

TEST(Patches, HoldAllSimplicesOfAnyMeshAndAreInOnePiece) {
  for (const auto kind : {Kind::triangles, Kind::mixed}) {
    const auto mesh = irregular(12, 0.4, kind);
    const Patches patches(mesh);
    expect_partition(mesh, patches);
    expect_connected(mesh, patches);
  }
  for (const auto kind : {Solid::tetrahedra, Solid::mixed}) {
    const auto mesh = irregular(6, 0.3, kind);
    const Patches patches(mesh);
    expect_partition(mesh, patches);
    expect_connected(mesh, patches);
  }
}

TEST(Patches, OneLeftOverJoinsItsNeighbours) {
  // A strip of three triangles whose long edge is between the first two.
  Mesh<2> mesh;
  mesh.lists.nodes = {{0, 0}, {2, 0}, {2, 1}, {0, 1}, {2.5, 0.5}};
  mesh.lists.offsets = {0, 3, 6, 9};
  mesh.lists.types.assign(3, ElementType::T3);
  mesh.lists.connectivity = {0, 1, 2, 0, 2, 3, 1, 4, 2};
  complete(mesh);
  const Patches patches(mesh);
  ASSERT_EQ(patches.size(), 1);
  EXPECT_EQ(patches.elements(0).size(), 3u);
}

TEST(Patches, OneByItselfIsAPatch) {
  Mesh<2> mesh;
  mesh.lists.nodes = {{0, 0}, {1, 0}, {0, 1}};
  mesh.lists.offsets = {0, 3};
  mesh.lists.types.assign(1, ElementType::T3);
  mesh.lists.connectivity = {0, 1, 2};
  complete(mesh);
  const Patches patches(mesh);
  ASSERT_EQ(patches.size(), 1);
  EXPECT_EQ(patches.around(0).size(), 1u);
}

}  // namespace
}  // namespace scarp::test
