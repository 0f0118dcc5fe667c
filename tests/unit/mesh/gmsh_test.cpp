#include "scarp/mesh/gmsh.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <set>

#include "meshes.hpp"
#include "scarp/base/error.hpp"
#include "scarp/mesh/build.hpp"
#include "scarp/mesh/locate.hpp"

namespace scarp {
namespace {

const std::string data = std::string(SCARP_TEST_DATA) + "/data/";

Mesh<2> read(const std::string& name) {
  return read_gmsh(data + name + ".msh");
}

class Formats : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Gmsh, Formats, testing::Values("triangles", "quads", "mixed"));

// The four files of a geometry come from the same mesh, written by Gmsh itself; its ASCII numbers have 16 digits.
TEST_P(Formats, GiveTheSameMesh) {
  const std::string name = GetParam();
  const Mesh<2> first = read(name + "_41_ascii");
  ASSERT_GT(first.element_count(), 30);
  for (const char* format : {"_41_binary", "_22_ascii", "_22_binary"}) {
    SCOPED_TRACE(format);
    const Mesh<2> other = read(name + format);
    ASSERT_EQ(other.node_count(), first.node_count());
    for (int n = 0; n < first.node_count(); ++n)
      for (int k = 0; k < 2; ++k) ASSERT_NEAR(other.node(n)[k], first.node(n)[k], 1e-14);
    EXPECT_EQ(other.lists.types, first.lists.types);
    EXPECT_EQ(other.lists.offsets, first.lists.offsets);
    EXPECT_EQ(other.lists.connectivity, first.lists.connectivity);
    EXPECT_EQ(other.lists.around, first.lists.around);
    EXPECT_EQ(other.node_sets, first.node_sets);
  }
}

TEST_P(Formats, GiveElementsThatRunAnticlockwiseAndFillTheirShape) {
  const Mesh<2> mesh = read(std::string(GetParam()) + "_22_binary");
  double area = 0;
  for (int e = 0; e < mesh.element_count(); ++e) {
    EXPECT_GT(element_area(mesh, e), 0);
    EXPECT_GT(mesh.size_of(e), 0);
    area += element_area(mesh, e);
  }
  EXPECT_DOUBLE_EQ(area, mesh_area(mesh));
  const std::set<int> used(mesh.lists.connectivity.begin(), mesh.lists.connectivity.end());
  EXPECT_EQ(static_cast<int>(used.size()), mesh.node_count());
  EXPECT_FALSE(mesh.grid);
}

// Oracle: the order along the curve. Two elements that follow on one another touch, nearly always.
TEST(Gmsh, NumbersWhatIsNearAlike) {
  const Mesh<2> mesh = read("triangles_41_ascii");
  int touching = 0;
  for (int e = 1; e < mesh.element_count(); ++e) {
    const auto around = mesh.elements_around(e);
    touching += std::binary_search(around.begin(), around.end(), e - 1);
  }
  EXPECT_GT(touching, 0.9 * mesh.element_count());
}

// Oracle: the polygons of the .geo files; Gmsh's own nodes on the sides are exact to 1e-11.
TEST(Gmsh, FillsTheGeometry) {
  EXPECT_NEAR(mesh_area(read("triangles_41_binary")), 10 * 2 + 0.5 * 3 * (2 + 5), 1e-9);
  EXPECT_NEAR(mesh_area(read("mixed_41_binary")), 4 * 1 + 0.5 * (4 + 3) * 2, 1e-9);
  // 8 chords to each quarter circle: a polygon of 32 sides between the radii 1 and 3.
  EXPECT_NEAR(mesh_area(read("quads_41_binary")), 8 * 0.5 * std::sin(std::numbers::pi / 16) * (9 - 1), 1e-9);
}

TEST(Gmsh, ReadsBothElementTypes) {
  const auto count = [](const Mesh<2>& mesh, ElementType type) {
    return std::count(mesh.lists.types.begin(), mesh.lists.types.end(), type);
  };
  const Mesh<2> triangles = read("triangles_22_ascii"), quads = read("quads_22_ascii"), mixed = read("mixed_22_ascii");
  EXPECT_EQ(count(triangles, ElementType::T3), triangles.element_count());
  EXPECT_EQ(count(quads, ElementType::Q4), 6 * 8);
  EXPECT_EQ(quads.element_count(), 6 * 8);
  EXPECT_EQ(count(mixed, ElementType::Q4), 6 * 3);
  EXPECT_GT(count(mixed, ElementType::T3), 20);
}

// Oracle: the coordinates that the .geo files give the groups.
TEST(Gmsh, TurnsPointsAndLinesInGroupsIntoNodeSets) {
  const Mesh<2> mesh = read("triangles_41_ascii");
  const auto where = [&mesh](auto&& condition) {
    std::vector<int> set;
    for (int n = 0; n < mesh.node_count(); ++n)
      if (condition(mesh.node(n))) set.push_back(n);
    return set;
  };
  EXPECT_EQ(mesh.node_sets.at("base"), where([](const Vec<2>& x) { return std::abs(x[1]) < 1e-9; }));
  EXPECT_EQ(mesh.node_sets.at("toe"), where([](const Vec<2>& x) { return x == Vec<2>{5, 2}; }));
  EXPECT_EQ(mesh.node_sets.at("slope"),
            where([](const Vec<2>& x) { return std::abs(x[0] + x[1] - 7) < 1e-9 && x[0] < 5 + 1e-9; }));
  EXPECT_EQ(mesh.node_sets.at("7"), where([](const Vec<2>& x) { return std::abs(x[1] - 5) < 1e-9; }));
  EXPECT_EQ(mesh.node_sets.at("bottom"), mesh.node_sets.at("base"));
  EXPECT_EQ(mesh.node_sets.at("left"), where([](const Vec<2>& x) { return std::abs(x[0]) < 1e-9; }));
  EXPECT_EQ(mesh.node_sets.at("right"), where([](const Vec<2>& x) { return std::abs(x[0] - 10) < 1e-9; }));
  EXPECT_FALSE(mesh.node_sets.contains("soil"));
}

// In quads.geo the outer arc is the user's own group "left", which the side of the box must not replace.
TEST(Gmsh, LeavesGroupsNamedLikeASideAlone) {
  const Mesh<2> mesh = read("quads_22_binary");
  EXPECT_EQ(mesh.node_sets.at("left").size(), 9u);
  for (int n : mesh.node_sets.at("left")) EXPECT_NEAR(std::hypot(mesh.node(n)[0], mesh.node(n)[1]), 3, 1e-9);
  EXPECT_EQ(mesh.node_sets.at("bottom").size(), 7u);
  EXPECT_EQ(mesh.node_sets.at("hole").size(), 9u);
}

const std::string head = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n";

TEST(Gmsh, DropsNodesThatNoElementUsesAndTurnsElementsRound) {
  const Mesh<2> mesh = parse_gmsh("a.msh", head +
                                               "$Nodes\n5\n9 9 9 9\n20 0 0 0\n40 1 1 0\n30 1 0 0\n35 0 1 0\n$EndNodes\n"
                                               "$Elements\n2\n1 2 2 1 1 20 40 30\n2 2 2 1 1 20 40 35\n$EndElements\n");
  ASSERT_EQ(mesh.node_count(), 4);
  EXPECT_EQ(std::count(mesh.lists.nodes.begin(), mesh.lists.nodes.end(), Vec<2>{9, 9}), 0);
  for (int e : {0, 1}) EXPECT_DOUBLE_EQ(element_area(mesh, e), 0.5);
  EXPECT_DOUBLE_EQ(mesh_area(mesh), 1);
}

TEST(Gmsh, ReadsFilesWithOtherLineEndsSpacesAndSections) {
  const std::string text =
      "$MeshFormat\r\n2.2 0 8\r\n$EndMeshFormat\r\n$Comments\r\nanything 1 2 3\r\n$EndComments\r\n$Nodes\r\n3\r\n"
      "1  +0 0\t0 \r\n\r\n2 1e0 0 0\r\n3 0 1 0\r\n$EndNodes\r\n$Elements\r\n1\r\n1 2 0 1 2 3\r\n$EndElements";
  EXPECT_DOUBLE_EQ(mesh_area(parse_gmsh("a.msh", text)), 0.5);
}

// Every point of the mesh that Gmsh made is found from any other.
TEST(Gmsh, MeshesCanBeSearched) {
  const Mesh<2> mesh = read("mixed_41_ascii");
  const Locator<2> locator(mesh);
  SearchCounts counts;
  int hint = 0;
  for (int e = 0; e < mesh.element_count(); e += 7) {
    Vec<2> centre{};
    const auto nodes = mesh.element_nodes(e);
    for (int n : nodes)
      for (int k = 0; k < 2; ++k) centre[k] += mesh.node(n)[k] / static_cast<double>(nodes.size());
    hint = locator.find(centre, hint, counts).element;
    EXPECT_EQ(hint, e);
  }
  EXPECT_EQ(counts.lost, 0);
}

}  // namespace
}  // namespace scarp
