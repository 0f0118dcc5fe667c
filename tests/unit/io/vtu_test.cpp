// Points and meshes as VTU. Oracle: a small reader of raw appended data, written here from VTK's description of it.
#include "scarp/io/vtu.hpp"

#include <array>
#include <cstdint>
#include <cstring>
#include <numeric>
#include <vector>

#include "files.hpp"
#include "scarp/mesh/build.hpp"
#include "scarp/mesh/grid.hpp"

namespace scarp::io::test {
namespace {

/// One DataArray: what its tag says, and its bytes.
template <class Value>
struct Array {
  std::string type;
  int components = 0;
  std::vector<Value> values;
};

std::string attribute(const std::string& tag, const std::string& name) {
  const auto from = tag.find(' ' + name + "=\"") + name.size() + 3;
  return tag.substr(from, tag.find('"', from) - from);
}

template <class Value>
Array<Value> array_of(const std::string& file, const std::string& name) {
  const auto at = file.find("Name=\"" + name + '"');
  EXPECT_NE(at, std::string::npos) << name;
  const auto begin = file.rfind('<', at);
  const std::string tag = file.substr(begin, file.find('>', begin) - begin);
  const std::string mark = "<AppendedData encoding=\"raw\">\n_";
  const auto data = file.find(mark) + mark.size() + std::stoul(attribute(tag, "offset"));
  std::uint64_t bytes = 0;
  std::memcpy(&bytes, file.data() + data, sizeof bytes);
  Array<Value> array{attribute(tag, "type"), std::stoi(attribute(tag, "NumberOfComponents")), {}};
  array.values.resize(bytes / sizeof(Value));
  std::memcpy(array.values.data(), file.data() + data + sizeof bytes, bytes);
  return array;
}

using Vtu = Files;

template <class Value, class F>
Field field(const std::string& name, int components, F&& value) {
  return {name, components, Copy<Value>([=](std::size_t first, std::size_t last, Value* values) {
            for (std::size_t i = first; i < last; ++i)
              for (int c = 0; c < components; ++c) *values++ = static_cast<Value>(value(i, c));
          })};
}

TEST_F(Vtu, PointsWithFieldsOfEachType) {
  constexpr std::size_t count = 10000;  // more than are asked for at once
  const auto position = [](std::size_t i, int c) { return 0.1 * static_cast<double>(i) + c; };
  const auto number = [](std::size_t i, int) { return i * 7 % 256; };
  const std::vector<Field> fields{field<double>("velocity", 2, position), field<std::int32_t>("id", 1, number),
                                  field<std::uint8_t>("flags", 1, number)};
  write_points_vtu(path("p.vtu"), count, field<double>("Points", 3, position), fields);
  const std::string file = content("p.vtu");
  EXPECT_NE(file.find("NumberOfPoints=\"10000\" NumberOfCells=\"10000\""), std::string::npos);
  EXPECT_EQ(file.substr(file.size() - 11), "</VTKFile>\n");
  const auto points = array_of<double>(file, "Points"), velocity = array_of<double>(file, "velocity");
  const auto id = array_of<std::int32_t>(file, "id");
  const auto flags = array_of<std::uint8_t>(file, "flags"), types = array_of<std::uint8_t>(file, "types");
  const auto connectivity = array_of<std::int64_t>(file, "connectivity"),
             offsets = array_of<std::int64_t>(file, "offsets");
  EXPECT_EQ(points.type, "Float64");
  EXPECT_EQ(id.type, "Int32");
  EXPECT_EQ(flags.type, "UInt8");
  EXPECT_EQ(connectivity.type, "Int64");
  EXPECT_EQ(velocity.components, 2);
  ASSERT_EQ(points.values.size(), 3 * count);
  ASSERT_EQ(velocity.values.size(), 2 * count);
  ASSERT_EQ(id.values.size(), count);
  ASSERT_EQ(flags.values.size(), count);
  for (std::size_t i = 0; i < count; ++i) {
    for (int c = 0; c < 3; ++c) ASSERT_EQ(points.values[3 * i + c], position(i, c));
    for (int c = 0; c < 2; ++c) ASSERT_EQ(velocity.values[2 * i + c], position(i, c));
    ASSERT_EQ(id.values[i], static_cast<std::int32_t>(number(i, 0)));
    ASSERT_EQ(flags.values[i], number(i, 0));
    ASSERT_EQ(connectivity.values.at(i), static_cast<std::int64_t>(i));
    ASSERT_EQ(offsets.values.at(i), static_cast<std::int64_t>(i + 1));
    ASSERT_EQ(types.values.at(i), 1);  // VTK_VERTEX
  }
}

/// The written mesh has the elements of `mesh`: its nodes, and local nodes one element after the other.
template <int Dim>
void expect_elements(const std::string& file, const Mesh<Dim>& mesh) {
  const auto points = array_of<double>(file, "Points");
  const auto connectivity = array_of<std::int64_t>(file, "connectivity"),
             offsets = array_of<std::int64_t>(file, "offsets");
  const auto types = array_of<std::uint8_t>(file, "types");
  EXPECT_EQ(connectivity.components, 1);
  ASSERT_EQ(points.values.size(), 3 * static_cast<std::size_t>(mesh.node_count()));
  for (int n = 0; n < mesh.node_count(); ++n)
    for (int k = 0; k < 3; ++k) ASSERT_EQ(points.values[3 * n + k], k < Dim ? mesh.node(n)[k] : 0);
  std::size_t at = 0;
  ASSERT_EQ(types.values.size(), static_cast<std::size_t>(mesh.element_count()));
  for (int e = 0; e < mesh.element_count(); ++e) {
    for (const int n : mesh.element_nodes(e)) ASSERT_EQ(connectivity.values.at(at++), n) << "element " << e;
    ASSERT_EQ(offsets.values.at(e), static_cast<std::int64_t>(at));
    constexpr std::array<int, 4> vtk_types{5, 9, 10, 12};  // triangle, quad, tetra, hexahedron
    ASSERT_EQ(types.values[e], vtk_types[static_cast<int>(mesh.type_of(e))]);
  }
  EXPECT_EQ(connectivity.values.size(), at);
}

TEST_F(Vtu, MeshesOfListsAndGrids) {
  Mesh<2> mixed;
  mixed.lists.nodes = {{0, 0}, {1, 0}, {1, 1}, {0, 1}, {2, 0.5}};
  mixed.lists.types = {ElementType::T3, ElementType::Q4};
  mixed.lists.offsets = {0, 3, 7};
  mixed.lists.connectivity = {1, 4, 2, 0, 1, 2, 3};
  complete(mixed);
  write_mesh_vtu(path("m.vtu"), mixed);
  expect_elements(content("m.vtu"), mixed);
  // Of a grid the corners of its cells, whatever its functions; more values than are asked for at once.
  for (const auto functions : {GridFunctions::linear, GridFunctions::gimp, GridFunctions::b_spline}) {
    write_mesh_vtu(path("g.vtu"), make_grid({1, 2}, {71, 37}, {71, 37}, functions));
    expect_elements(content("g.vtu"), make_grid({1, 2}, {71, 37}, {71, 37}));
    write_mesh_vtu(path("h.vtu"), make_grid<3>({1, 2, 3}, {11, 12, 13}, {11, 12, 13}, functions));
    expect_elements(content("h.vtu"), make_grid<3>({1, 2, 3}, {11, 12, 13}, {11, 12, 13}));
  }
}

TEST_F(Vtu, ALargeGridIsItsFrame) {
  write_mesh_vtu(path("m.vtu"), make_grid({1, 2}, {20000, 10000}, {20000, 10000}));
  expect_elements(content("m.vtu"), make_grid({1, 2}, {20000, 10000}, {1, 1}));
}

TEST(Field, GivesAllItsValues) {
  const auto twice = field<double>("x", 1, [](std::size_t i, int) { return 2.0 * static_cast<double>(i); });
  EXPECT_EQ(values_of<double>(twice, 4), (std::vector<double>{0, 2, 4, 6}));
  EXPECT_THROW(values_of<std::int32_t>(twice, 4), std::bad_variant_access);
}

}  // namespace
}  // namespace scarp::io::test
