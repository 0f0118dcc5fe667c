// Gmsh files of tetrahedra and hexahedra, and what is wrong with some.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <numbers>

#include "scarp/base/error.hpp"
#include "scarp/mesh/gmsh.hpp"
#include "scarp/mesh/locate.hpp"
#include "scarp/mesh/shapes/valid.hpp"
#include "solids.hpp"

namespace scarp {
namespace {

const std::string data = std::string(SCARP_TEST_DATA) + "/data/";

Mesh<3> read(const std::string& name) {
  return read_gmsh<3>(data + name + ".msh");
}

std::string bytes_of(const std::string& name) {
  std::ifstream file(data + name + ".msh", std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

class SolidFormats : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Gmsh, SolidFormats, testing::Values("tetrahedra", "hexahedra", "mixed_solids"));

// The four files of a geometry come from the same mesh, written by Gmsh itself; its ASCII numbers have 16 digits.
TEST_P(SolidFormats, GiveTheSameMesh) {
  const std::string name = GetParam();
  const Mesh<3> first = read(name + "_41_ascii");
  ASSERT_GE(first.element_count(), 30);
  for (int e = 0; e < first.element_count(); ++e) EXPECT_GT(element_volume(first, e), 0);
  for (const char* format : {"_41_binary", "_22_ascii", "_22_binary"}) {
    SCOPED_TRACE(format);
    const Mesh<3> other = read(name + format);
    ASSERT_EQ(other.node_count(), first.node_count());
    for (int n = 0; n < first.node_count(); ++n)
      for (int k = 0; k < 3; ++k) ASSERT_NEAR(other.node(n)[k], first.node(n)[k], 1e-14);
    EXPECT_EQ(other.lists.types, first.lists.types);
    EXPECT_EQ(other.lists.connectivity, first.lists.connectivity);
    EXPECT_EQ(other.lists.around, first.lists.around);
    EXPECT_EQ(other.node_sets, first.node_sets);
  }
}

// Oracle: the solids of the .geo files; the ring has 5 chords to a quarter circle.
TEST(SolidGmsh, FillsTheGeometry) {
  EXPECT_NEAR(mesh_volume(read("tetrahedra_41_binary")), 0.5 * (3 + 1) * 2 * 2, 1e-9);
  EXPECT_NEAR(mesh_volume(read("hexahedra_41_binary")), 5 * 0.5 * std::sin(std::numbers::pi / 10) * (9 - 1), 1e-9);
  EXPECT_NEAR(mesh_volume(read("mixed_solids_22_binary")), 2, 1e-9);
}

// Oracle: the coordinates that the .geo files give the groups.
TEST(SolidGmsh, TurnsPointsCurvesAndSurfacesInGroupsIntoNodeSets) {
  const Mesh<3> mesh = read("tetrahedra_22_ascii");
  const auto where = [&mesh](auto&& condition) {
    std::vector<int> set;
    for (int n = 0; n < mesh.node_count(); ++n)
      if (condition(mesh.node(n))) set.push_back(n);
    return set;
  };
  const auto slope = [](const Vec<3>& x) { return std::abs(x[0] + x[2] - 3) < 1e-9; };
  EXPECT_EQ(mesh.node_sets.at("base"), where([](const Vec<3>& x) { return std::abs(x[2]) < 1e-9; }));
  EXPECT_EQ(mesh.node_sets.at("bottom"), mesh.node_sets.at("base"));
  EXPECT_EQ(mesh.node_sets.at("7"), where(slope));
  EXPECT_EQ(mesh.node_sets.at("crest"), where([&](const Vec<3>& x) { return slope(x) && std::abs(x[1]) < 1e-9; }));
  EXPECT_EQ(mesh.node_sets.at("toe"), where([](const Vec<3>& x) { return x == Vec<3>{3, 0, 0}; }));
  EXPECT_EQ(mesh.node_sets.at("front"), where([](const Vec<3>& x) { return std::abs(x[1]) < 1e-9; }));
  EXPECT_FALSE(mesh.node_sets.contains("soil"));
  EXPECT_EQ(read("hexahedra_41_ascii").node_sets.at("left").size(), 24u);  // the user's own, at z = 0
}

// 1-3 format, 4 $Nodes, 5 count, 6-14 nodes, 15 end, 16 $Elements, 17 count, 18 the element.
const std::string cube =
    "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n9\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n5 0 0 1\n6 1 0 1\n7 1 1 1\n"
    "8 0 1 1\n9 2 0 0\n$EndNodes\n$Elements\n1\n1 5 2 0 1 1 2 3 4 5 6 7 8\n$EndElements\n";

std::string with_elements(int count, const std::string& lines) {
  return cube.substr(0, cube.find("$Elements")) + "$Elements\n" + std::to_string(count) + "\n" + lines +
         "$EndElements\n";
}

TEST(SolidGmsh, TurnsElementsRound) {
  EXPECT_DOUBLE_EQ(mesh_volume(parse_gmsh<3>("a", cube)), 1);
  EXPECT_DOUBLE_EQ(mesh_volume(parse_gmsh<3>("a", with_elements(1, "1 5 2 0 1 5 6 7 8 1 2 3 4\n"))), 1);
  EXPECT_DOUBLE_EQ(mesh_volume(parse_gmsh<3>("a", with_elements(1, "1 4 2 0 1 1 3 2 5\n"))), 1.0 / 6);
}

template <int Dim>
void expect_error(const std::string& bytes, int line, const std::string& problem) {
  SCOPED_TRACE(problem);
  try {
    parse_gmsh<Dim>("bad.msh", bytes);
    ADD_FAILURE() << "no error";
  } catch (const InputError& error) {
    EXPECT_EQ(error.position().line, line) << error.what();
    EXPECT_NE(error.problem().find(problem), std::string::npos) << error.what();
    EXPECT_FALSE(error.remedy().empty());
  }
}

TEST(SolidGmshErrors, OfElements) {
  expect_error<2>(cube, 18, "a plane mesh is asked for");
  expect_error<3>(with_elements(1, "1 2 2 0 1 1 2 3\n"), 20, "a mesh of space is asked for");
  expect_error<3>(with_elements(1, "1 6 2 0 1 1 2 3 5 6 7\n"), 18, "only 4-node");
  expect_error<3>(with_elements(1, "1 11 2 0 1 1 2 3 5 6 7 8 4 1 2\n"), 18, "only 4-node");
  expect_error<3>(with_elements(1, "1 5 2 0 1 1 2 4 3 5 6 8 7\n"), 18, "element 1, a hexahedron, is twisted");
  expect_error<3>(with_elements(1, "1 5 2 0 1 1 2 3 4 7 8 5 6\n"), 18, "element 1, a hexahedron, is twisted");
  expect_error<3>(with_elements(1, "1 4 2 0 1 1 2 3 4\n"), 18, "element 1, a tetrahedron, has no volume");
  expect_error<3>(with_elements(2, "1 4 2 0 1 1 2 4 5\n2 4 2 0 1 1 2 4 8\n"), 19, "elements 1 and 2 overlap");
  expect_error<3>(with_elements(2, "1 5 2 0 1 1 2 3 4 5 6 7 8\n2 4 2 0 1 2 9 3 6\n"), 19,
                  "hexahedron 1 and tetrahedron 2 meet across a face");
  expect_error<3>(with_elements(1, "1 4 2 0 1 1 2 3 99\n"), 18, "does not have");
}

TEST(SolidGmshErrors, FilesCutAnywhereAreErrors) {
  for (const char* name :
       {"hexahedra_22_ascii", "hexahedra_22_binary", "mixed_solids_41_ascii", "mixed_solids_41_binary"}) {
    const std::string whole = bytes_of(name);
    const std::size_t end = whole.rfind("$EndElements") + 12;
    for (std::size_t size = 0; size < end; size += 3)
      ASSERT_THROW(parse_gmsh<3>("cut.msh", whole.substr(0, size)), InputError) << name << ' ' << size;
  }
}

}  // namespace
}  // namespace scarp
