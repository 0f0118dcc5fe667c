// Mesh files that are wrong: each must give one InputError that tells place, value and remedy, never anything else.
#include <gtest/gtest.h>

#include <cstring>
#include <fstream>
#include <iterator>
#include <random>

#include "scarp/base/error.hpp"
#include "scarp/mesh/build.hpp"
#include "scarp/mesh/gmsh.hpp"

namespace scarp {
namespace {

std::string bytes_of(const std::string& name) {
  std::ifstream file(std::string(SCARP_TEST_DATA) + "/data/" + name + ".msh", std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

struct Bad {
  std::string bytes;
  int line;             ///< 0 where the file is binary
  std::string problem;  ///< a part of the message
  std::string value = {};
};

void expect_error(const Bad& bad) {
  SCOPED_TRACE(bad.problem);
  try {
    parse_gmsh("bad.msh", bad.bytes);
    ADD_FAILURE() << "no error";
  } catch (const InputError& error) {
    EXPECT_EQ(error.position().file, "bad.msh");
    EXPECT_EQ(error.position().line, bad.line) << error.what();
    EXPECT_NE(error.problem().find(bad.problem), std::string::npos) << error.what();
    EXPECT_NE(error.value().find(bad.value), std::string::npos) << error.what();
    EXPECT_FALSE(error.remedy().empty());
  }
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

// Lines: 1-3 format, 4 $Nodes, 5 count, 6-9 nodes, 10 end, 11 $Elements, 12 count, 13-14 elements, 15 end.
const std::string v2 =
    "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n$EndNodes\n"
    "$Elements\n2\n1 2 2 0 1 1 2 3\n2 2 2 0 1 1 3 4\n$EndElements\n";
// 1-3 format, 4-6 $Entities with 4 points, 1 surface (7-12), 13 $Nodes, 14 header, 15 block, 16-19 tags, 20-23
// coordinates, 24 end, 25 $Elements, 26 header, 27 block, 28-29 elements, 30 end.
const std::string v4 =
    "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Entities\n1 0 1 0\n1 0 0 0 1 5 \n1 0 0 0 1 1 0 0 0\n$EndEntities\n"
    "$Nodes\n1 4 1 4\n2 1 0 4\n1\n2\n3\n4\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n$EndNodes\n"
    "$Elements\n1 2 1 2\n2 1 2 2\n1 1 2 3\n2 1 3 4\n$EndElements\n";

TEST(GmshErrors, TheSmallFilesAreRightBeforeTheyAreSpoilt) {
  EXPECT_DOUBLE_EQ(mesh_area(parse_gmsh("2", v2)), 1);
  EXPECT_DOUBLE_EQ(mesh_area(parse_gmsh("4", v4)), 1);
}

TEST(GmshErrors, OfTheFormat) {
  expect_error({"", 1, "empty"});
  expect_error({"solid cube\n", 1, "begins with $MeshFormat", "solid cube"});
  expect_error({replaced(v2, "2.2", "4"), 2, "version", "\"4\""});
  expect_error({replaced(v2, "2.2", "4.0"), 2, "version", "4.0"});
  expect_error({replaced(v2, "2.2 0", "2.2 7"), 2, "file type", "7"});
  expect_error({replaced(v2, "0 8", "0 4"), 2, "data size", "4"});
  expect_error({replaced(v2, "$EndMeshFormat", "$Nodes"), 3, "$EndMeshFormat", "$Nodes"});
  EXPECT_THROW(read_gmsh("no/such/file.msh"), InputError);
  EXPECT_THROW(read_gmsh("/"), InputError);
}

TEST(GmshErrors, OfSections) {
  expect_error({v2.substr(0, v2.find("$Elements")), 11, "no section $Elements"});
  expect_error({replaced(v2, v2.substr(v2.find("$Nodes"), v2.find("$Elements") - v2.find("$Nodes")), ""), 9,
                "no section $Nodes"});
  expect_error({v2 + v2.substr(v2.find("$Nodes")), 16, "twice", "$Nodes"});
  expect_error({v2 + "rubbish\n", 16, "a section", "rubbish"});
  expect_error({v2 + "$Periodic\n0\n", 17, "\"$Periodic\" has no end"});
  expect_error({v4 + "$PartitionedEntities\n0\n$EndPartitionedEntities\n", 27, "partitioned"});
  expect_error({replaced(v2, "$Nodes", "$ParametricNodes"), 4, "parameters"});
}

TEST(GmshErrors, OfCounts) {
  expect_error({replaced(v2, "$Nodes\n4", "$Nodes\n3"), 9, "should end here with $EndNodes", "4"});
  expect_error({replaced(v2, "$Nodes\n4", "$Nodes\n5"), 10, "node's number", "$EndNodes"});
  expect_error({replaced(v2, "$Nodes\n4", "$Nodes\n-4"), 5, "negative", "-4"});
  expect_error({replaced(v2, "$Nodes\n4", "$Nodes\n99999999999"), 6, "cannot hold", "99999999999"});
  expect_error({replaced(v2, "$Nodes\n4", "$Nodes\nfour"), 5, "whole number", "four"});
  expect_error({replaced(v2, "$Elements\n2", "$Elements\n1"), 14, "$EndElements", "2"});
  expect_error({replaced(v2, "$Elements\n2", "$Elements\n3"), 15, "element's number", "$EndElements"});
  expect_error({replaced(v2, "1 2 2 0", "1 2 99 0"), 13, "ends where"});
  expect_error({replaced(v2, "1 2 2 0", "1 2 -1 0"), 13, "tags must not be negative", "-1"});
  expect_error({replaced(v4, "1 4 1 4", "1 5 1 4"), 20, "less than", "1 nodes missing"});
  expect_error({replaced(v4, "1 4 1 4", "1 3 1 4"), 11, "more than", "4 where 3"});
  expect_error({replaced(v4, "1 4 1 4", "18446744073709551615 4 1 4"), 10, "cannot hold"});
  expect_error({replaced(v4, "2 1 0 4", "2 1 0 3"), 15, "line ends where"});
  expect_error({replaced(v4, "1 2 1 2", "2 2 1 2"), 26, "dimension", "$EndElements"});
  expect_error({replaced(v4, "1 0 1 0", "1 0 1 9"), 8, "tag of an entity", "$EndEntities"});
}

TEST(GmshErrors, OfNumbers) {
  expect_error({replaced(v2, "3 1 1 0", "3 1 x 0"), 8, "coordinate", "x"});
  expect_error({replaced(v2, "3 1 1 0", "3 1 nan 0"), 8, "finite", "nan"});
  expect_error({replaced(v2, "3 1 1 0", "3 1 1e999 0"), 8, "coordinate", "1e999"});
  expect_error({replaced(v2, "3 1 1 0", "3 1 1"), 8, "line ends where"});
  expect_error({replaced(v2, "3 1 1 0", "3 1 1 0 7"), 8, "more than it should", "7"});
  expect_error({replaced(v2, "3 1 1 0", "3.5 1 1 0"), 8, "node's number", "3.5"});
  expect_error({replaced(v2, "3 1 1 0", "0 1 1 0"), 8, "positive", "0"});
  expect_error({replaced(v2, "3 1 1 0", "2 1 1 0"), 8, "same number", "2"});
  expect_error({replaced(v2, "1 1 3 4", "1 1 3 9"), 14, "does not have", "node 9"});
  expect_error({replaced(v4, "2 1 3 4", "2 1 3 9"), 25, "does not have", "node 9"});
  expect_error({replaced(v4, "1 1 0\n0 1", "1 1\n0 1"), 18, "line ends where"});
}

TEST(GmshErrors, OfElements) {
  expect_error(
      {replaced(v2, "1 2 2 0 1 1 2 3", "1 9 2 0 1 1 2 3 4 5 6"), 13, "only 3-node", "6-node triangle (type 9)"});
  expect_error({replaced(v2, "1 2 2 0 1 1 2 3", "1 16 2 0 1 1 2 3"), 13, "only 3-node", "8-node quadrilateral"});
  expect_error({replaced(v2, "1 2 2 0 1 1 2 3", "1 4 2 0 1 1 2 3 4"), 13, "plane", "tetrahedron"});
  expect_error({replaced(v2, "1 2 2 0 1 1 2 3", "1 77 2 0 1 1 2 3 4"), 13, "only 3-node", "type 77"});
  expect_error({replaced(v4, "2 1 2 2", "2 1 9 2"), 23, "only 3-node", "6-node triangle"});
  expect_error({replaced(v4, "2 1 2 2", "1 1 2 2"), 23, "do not fit", "dimension 2 in an entity of dimension 1"});
  expect_error({replaced(v2, "3 1 1 0", "3 2 0 0"), 13, "element 1, a triangle, has no area"});
  expect_error({replaced(v2, "3 1 1 0", "3 2 1e-7 0"), 13, "element 1, a triangle, has no area"});
  expect_error({replaced(v2, "2 2 2 0 1 1 3 4", "2 2 2 0 1 1 3 3"), 14, "element 2, a triangle, has no area"});
  expect_error({replaced(v2, "1 2 2 0 1 1 2 3\n2 2 2 0 1 1 3 4", "1 3 2 0 1 1 2 4 3\n2 2 2 0 1 1 3 4"), 13,
                "element 1, a quadrilateral, is not convex"});
  expect_error({replaced(v2, "1 1 3 4", "1 1 2 4"), 14, "elements 1 and 2 overlap"});
  expect_error({replaced(v2, "3 1 1 0", "3 1 1 0.1"), 8, "z = 0", "0.1"});
  expect_error({replaced(v2, "1 2 2 0 1 1 2 3\n2 2 2 0 1 1 3 4", "1 1 2 0 1 1 2\n2 1 2 0 1 3 4"), 16, "no triangles"});
}

TEST(GmshErrors, OfBinaryFilesTellTheByte) {
  std::string other_order = bytes_of("quads_41_binary");
  std::reverse(other_order.begin() + 20, other_order.begin() + 24);  // behind "$MeshFormat\n4.1 1 8\n"
  expect_error({other_order, 0, "another order of bytes (at byte 20)", "16777216"});
  std::string cut = bytes_of("quads_22_binary");
  cut.resize(cut.size() / 2);
  expect_error({cut, 0, "(at byte "});
}

/// Parses; true when that gives a mesh, false when it gives an InputError that is complete. All else fails the test.
bool parses(const std::string& bytes) {
  try {
    const Mesh<2> mesh = parse_gmsh("fuzz.msh", bytes);
    EXPECT_GT(mesh_area(mesh), 0);
    return true;
  } catch (const InputError& error) {
    EXPECT_FALSE(error.remedy().empty()) << error.what();
    return false;
  }
}

class Fuzz : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Gmsh, Fuzz,
                         testing::Values("quads_22_ascii", "quads_22_binary", "mixed_41_ascii", "mixed_41_binary"));

TEST_P(Fuzz, FilesCutAnywhereAreErrors) {
  const std::string whole = bytes_of(GetParam());
  const std::size_t end = whole.rfind("$EndElements") + std::strlen("$EndElements");
  ASSERT_TRUE(parses(whole.substr(0, end)));
  for (std::size_t size = 0; size < end; ++size) ASSERT_FALSE(parses(whole.substr(0, size))) << size;
}

// A changed byte may leave a good mesh (a digit of a coordinate); then it is one, else an error.
TEST_P(Fuzz, ChangedBytesGiveAMeshOrAnError) {
  const std::string whole = bytes_of(GetParam());
  std::mt19937 random(11);
  int errors = 0;
  for (int i = 0; i < 4000; ++i) {
    std::string bytes = whole;
    for (auto changes = 1 + random() % 3; changes > 0; --changes)
      bytes[random() % bytes.size()] = static_cast<char>(random() % 4 == 0 ? "-9 \n"[random() % 4] : random());
    errors += !parses(bytes);
  }
  EXPECT_GT(errors, 500);
}

}  // namespace
}  // namespace scarp
