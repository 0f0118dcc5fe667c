// What the readers of both versions take from a Gmsh file, before it becomes a mesh.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "scarp/mesh/gmsh/scanner.hpp"
#include "scarp/mesh/mesh.hpp"

namespace scarp::gmsh {

using Tag = std::uint64_t;
using Group = std::pair<int, int>;  ///< dimension and number of a physical group

struct Node {
  Tag tag;
  std::array<double, 3> x;
  std::size_t where;  ///< line or byte
};

struct Element {
  Tag tag;
  ElementType type;
  std::array<Tag, 8> nodes;
  std::size_t where;
};

struct Contents {
  int dimension;  ///< of the mesh that is asked for
  std::vector<Node> nodes;
  std::vector<Element> elements;                  ///< those of that dimension
  std::size_t lower_elements = 0;                 ///< number of the others
  std::map<Group, std::vector<Tag>> group_nodes;  ///< nodes of the others in physical groups
  std::map<Group, std::string> group_names;
  std::map<Group, std::vector<int>> entity_groups;  ///< version 4: physical groups of (dimension, entity)
};

/// An element type that is read, by Gmsh's number. Throws for all others, and for those of volumes when the mesh that
/// is asked for is plane.
struct TypeInfo {
  int nodes, dimension;
  ElementType type;  ///< of those that are surfaces or volumes
};
TypeInfo type_info(const Scanner& file, std::int64_t type, int dimension);

/// Adds one element that was read: those of the mesh's dimension to `elements`, others to each of their groups.
void add_element(Contents& contents, const TypeInfo& type, const Element& element, const std::vector<int>& groups);

// Sections $Nodes and $Elements of version 2.2, and $Entities, $Nodes and $Elements of version 4.1; the cursor stands
// behind the section's name, and ends before $End...
void read_nodes_2(Scanner& file, Contents& contents);
void read_elements_2(Scanner& file, Contents& contents);
void read_entities_4(Scanner& file, Contents& contents);
void read_nodes_4(Scanner& file, Contents& contents);
void read_elements_4(Scanner& file, Contents& contents);

/// Checks all and makes the mesh.
template <int Dim>
Mesh<Dim> to_mesh(const Scanner& file, Contents contents);

}  // namespace scarp::gmsh
