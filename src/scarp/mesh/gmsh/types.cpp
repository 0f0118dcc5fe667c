// The element types of Gmsh, by its numbers, and what becomes of each.
#include <fmt/format.h>

#include "scarp/mesh/gmsh/contents.hpp"

namespace scarp::gmsh {
namespace {

const std::map<std::int64_t, TypeInfo> readable = {{15, {1, 0, {}}},
                                                   {1, {2, 1, {}}},
                                                   {2, {3, 2, ElementType::T3}},
                                                   {3, {4, 2, ElementType::Q4}},
                                                   {4, {4, 3, ElementType::T4}},
                                                   {5, {8, 3, ElementType::H8}}};

const std::map<std::int64_t, const char*> of_higher_order = {
    {8, "3-node line"},         {9, "6-node triangle"}, {10, "9-node quadrilateral"}, {11, "10-node tetrahedron"},
    {12, "27-node hexahedron"}, {13, "18-node prism"},  {14, "14-node pyramid"},      {16, "8-node quadrilateral"},
    {17, "20-node hexahedron"}, {18, "15-node prism"},  {19, "13-node pyramid"},      {20, "9-node triangle"},
    {21, "10-node triangle"},   {26, "4-node line"},    {27, "5-node line"},          {29, "20-node tetrahedron"}};

const std::map<std::int64_t, const char*> solid = {
    {4, "4-node tetrahedron"},   {5, "8-node hexahedron"},   {6, "6-node prism"},     {7, "5-node pyramid"},
    {11, "10-node tetrahedron"}, {12, "27-node hexahedron"}, {13, "18-node prism"},   {14, "14-node pyramid"},
    {17, "20-node hexahedron"},  {18, "15-node prism"},      {19, "13-node pyramid"}, {29, "20-node tetrahedron"}};

}  // namespace

TypeInfo type_info(const Scanner& file, std::int64_t type, int dimension) {
  const auto named = [type](const char* name) { return fmt::format("a {} (type {})", name, type); };
  if (const auto at = solid.find(type); at != solid.end() && dimension == 2)
    file.fail("a plane mesh is asked for, but the file holds elements of volumes", named(at->second),
              "mesh surfaces only (gmsh -2), or set up the case in three dimensions", file.last());
  if (const auto at = readable.find(type); at != readable.end()) return at->second;
  const char* only = dimension == 2 ? "only 3-node triangles and 4-node quadrilaterals are read"
                                    : "only 4-node tetrahedra and 8-node hexahedra are read";
  if (const auto at = of_higher_order.find(type); at != of_higher_order.end())
    file.fail(only, named(at->second), "mesh with Mesh.ElementOrder = 1 (gmsh -order 1)", file.last());
  if (const auto at = solid.find(type); at != solid.end())
    file.fail(only, named(at->second),
              "mesh volumes with tetrahedra alone, or as transfinite or extruded hexahedra alone", file.last());
  file.fail(only, fmt::format("an element of type {}", type),
            dimension == 2 ? "mesh the surface with triangles or quadrilaterals of first order (gmsh -2 -order 1)"
                           : "mesh the volume with tetrahedra or hexahedra of first order (gmsh -3 -order 1)",
            file.last());
}

void add_element(Contents& contents, const TypeInfo& type, const Element& element, const std::vector<int>& groups) {
  if (type.dimension == contents.dimension) {
    contents.elements.push_back(element);
    contents.elements.back().type = type.type;
    return;
  }
  ++contents.lower_elements;
  for (int group : groups) {
    std::vector<Tag>& nodes = contents.group_nodes[{type.dimension, group}];
    nodes.insert(nodes.end(), element.nodes.begin(), element.nodes.begin() + type.nodes);
  }
}

}  // namespace scarp::gmsh
