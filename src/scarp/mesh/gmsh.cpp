#include "scarp/mesh/gmsh.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <set>

#include "scarp/base/error.hpp"
#include "scarp/base/text.hpp"
#include "scarp/mesh/gmsh/contents.hpp"

namespace scarp {
namespace {

using gmsh::Contents;
using gmsh::Scanner;
using gmsh::shown;

std::string read_file(const std::string& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error))
    throw InputError("there is no such mesh file", "", "check the path, or make the mesh with Gmsh", {path, 0, 0});
  std::ifstream stream(path, std::ios::binary);
  std::string bytes((std::istreambuf_iterator<char>(stream)), std::istreambuf_iterator<char>());
  if (!stream.eof() && stream.fail())
    throw InputError("the mesh file cannot be read", "", "check its permissions", {path, 0, 0});
  return bytes;
}

/// Reads $MeshFormat and sets the scanner's kind; true for version 4.1.
bool read_format(Scanner& file) {
  const char* remedy = "give a mesh written by Gmsh (gmsh -2 -format msh41)";
  if (!file.skip_space()) file.fail("the mesh file is empty", "", remedy, 1);
  const std::string_view first = file.line("$MeshFormat");
  if (first != "$MeshFormat") file.fail("a Gmsh file begins with $MeshFormat", shown(first), remedy, 1);
  const std::string version(file.word("the version"));
  if (version != "2.2" && version != "4.1")
    file.fail("this version of Gmsh's format is not read", shown(version),
              "write the mesh as version 4.1 or 2.2 (gmsh -2 -format msh41 or msh22)", file.here());
  const std::int64_t kind = file.text_integer("the file type"), data_size = file.text_integer("the data size");
  if (kind != 0 && kind != 1)
    file.fail("the file type must be 0 (ASCII) or 1 (binary)", fmt::format("{}", kind), remedy, file.here());
  if (data_size != 8) file.fail("the data size must be 8", fmt::format("{}", data_size), remedy, file.here());
  file.end_record();
  if (kind == 1) {
    file.set_binary(true);
    const std::int64_t one = file.integer("the number one that shows the order of bytes");
    if (one != 1)
      file.fail("the file was written with another order of bytes", fmt::format("{} in place of 1", one),
                "write it as ASCII", file.last());
  }
  file.end_section("MeshFormat");
  return version == "4.1";
}

/// Names are text in either kind of file: a count, then lines of dimension, number and "name".
void read_names(Scanner& file, Contents& contents) {
  file.skip_space();
  const std::int64_t count = file.text_integer("the number of physical names");
  const std::size_t where = file.here();
  file.line("the end of the line");
  if (count < 0)
    file.fail("the number of physical names must not be negative", fmt::format("{}", count),
              "write the file again with Gmsh", where);
  for (std::int64_t i = 0; i < count; ++i) {
    file.skip_space();
    const std::int64_t dimension = file.text_integer("the dimension of a physical group");
    const std::int64_t number = file.text_integer("the number of a physical group");
    const std::size_t at = file.here();
    const std::string_view text = file.line("the name of a physical group");
    const std::size_t open = text.find('"'), close = text.rfind('"');
    if (open == std::string_view::npos || close == open)
      file.fail("the name of a physical group must stand in quotes", shown(text), "write the file again with Gmsh", at);
    contents.group_names[{static_cast<int>(dimension), static_cast<int>(number)}] =
        text.substr(open + 1, close - open - 1);
  }
}

void read_section(Scanner& file, const std::string& name, bool version4, Contents& contents) {
  if (name == "PhysicalNames") {
    read_names(file, contents);
  } else if (name == "Nodes") {
    version4 ? read_nodes_4(file, contents) : read_nodes_2(file, contents);
  } else if (name == "Elements") {
    version4 ? read_elements_4(file, contents) : read_elements_2(file, contents);
  } else if (name == "Entities" && version4) {
    read_entities_4(file, contents);
  } else {
    file.skip_section(name);
    return;
  }
  file.end_section(name);
}

}  // namespace

template <int Dim>
Mesh<Dim> read_gmsh(const std::string& path) {
  return parse_gmsh<Dim>(path, read_file(path));
}

template <int Dim>
Mesh<Dim> parse_gmsh(const std::string& name, std::string bytes) {
  drop_byte_order_mark(bytes, name);  // a binary file begins with text, too
  Scanner file(name, std::move(bytes));
  const bool version4 = read_format(file);
  Contents contents;
  contents.dimension = Dim;
  std::set<std::string> seen;
  while (file.skip_space()) {
    const std::size_t where = file.here();
    const std::string_view header = file.line("a section");
    if (header.size() < 2 || header[0] != '$')
      file.fail("a section such as $Nodes should begin here", shown(header), "write the file again with Gmsh", where);
    const std::string section(header.substr(1));
    if (section == "PartitionedEntities")
      file.fail("partitioned meshes are not read", shown(header),
                "write the mesh without partitions (Mesh.NbPartitions = 0)", where);
    if (section == "ParametricNodes")
      file.fail("nodes with parameters of version 2.2 are not read", shown(header),
                "write the mesh without them (Mesh.SaveParametric = 0)", where);
    if ((section == "Nodes" || section == "Elements") && !seen.insert(section).second)
      file.fail("this section stands in the file twice", shown(header), "write the file again with Gmsh", where);
    read_section(file, section, version4, contents);
  }
  for (const char* needed : {"Nodes", "Elements"})
    if (!seen.contains(needed))
      file.fail(fmt::format("the file has no section ${}", needed), "",
                "the file is cut short or holds no mesh; write it again with Gmsh", file.here());
  return gmsh::to_mesh<Dim>(file, std::move(contents));
}

template Mesh<2> read_gmsh(const std::string&);
template Mesh<3> read_gmsh(const std::string&);
template Mesh<2> parse_gmsh(const std::string&, std::string);
template Mesh<3> parse_gmsh(const std::string&, std::string);

}  // namespace scarp
