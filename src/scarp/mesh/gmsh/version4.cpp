// Version 4.1: nodes and elements in blocks, one per geometric entity; physical groups belong to the entities.
#include <fmt/format.h>

#include <cstdlib>
#include <limits>

#include "scarp/mesh/gmsh/contents.hpp"

namespace scarp::gmsh {
namespace {

constexpr const char* damaged = "the file is damaged; write it again with Gmsh";

struct Header {
  std::size_t blocks, total;
};

/// The first record of $Nodes and $Elements: blocks, things, least and greatest tag.
Header read_header(Scanner& file, const char* things, std::size_t ascii_bytes, std::size_t binary_bytes) {
  file.begin_record();
  Header header{};
  header.blocks = file.checked_count(file.size("the number of blocks"), 8, 20, "blocks");
  header.total = file.checked_count(file.size("the number in all blocks"), ascii_bytes, binary_bytes, things);
  file.size("the least tag");
  file.size("the greatest tag");
  file.end_record();
  return header;
}

int dimension(Scanner& file) {
  const std::int64_t value = file.integer("the dimension of an entity");
  if (value < 0 || value > 3)
    file.fail("the dimension of an entity must be 0 to 3", fmt::format("{}", value), damaged, file.last());
  return static_cast<int>(value);
}

int entity_tag(Scanner& file) {
  const std::int64_t tag = file.integer("the tag of an entity");
  if (tag < std::numeric_limits<int>::min() || tag > std::numeric_limits<int>::max())
    file.fail("the tag of an entity is too large", fmt::format("{}", tag), damaged, file.last());
  return static_cast<int>(tag);
}

/// The number of things in a block, which must not exceed what the header leaves.
std::size_t block_size(Scanner& file, std::size_t left) {
  const std::uint64_t size = file.size("the number in a block");
  if (size > left)
    file.fail("the blocks hold more than the section's first line says",
              fmt::format("a block of {} where {} are left", size, left), damaged, file.last());
  return size;
}

void check_none_left(const Scanner& file, std::size_t left, const char* things) {
  if (left > 0)
    file.fail("the blocks hold less than the section's first line says", fmt::format("{} {} missing", left, things),
              damaged, file.here());
}

Tag tag(Scanner& file, const char* what) {
  const Tag value = file.size(what);
  if (value == 0) file.fail(fmt::format("{} must be positive", what), "0", damaged, file.last());
  return value;
}

void read_entity(Scanner& file, int dim, Contents& contents) {
  file.begin_record();
  const int entity = entity_tag(file);
  const int coordinates = dim == 0 ? 3 : 6;  // a point, or the corners of a box
  for (int i = 0; i < coordinates; ++i) file.number("a coordinate of an entity");
  const std::size_t groups =
      file.checked_count(file.size("the number of physical groups of an entity"), 2, 4, "physical groups");
  std::vector<int>& of = contents.entity_groups[{dim, entity}];
  for (std::size_t i = 0; i < groups; ++i)
    of.push_back(static_cast<int>(std::abs(file.integer("the number of a physical group"))));
  if (dim > 0) {
    const std::size_t parts =
        file.checked_count(file.size("the number of bounding entities"), 2, 4, "bounding entities");
    for (std::size_t i = 0; i < parts; ++i) file.integer("the tag of a bounding entity");
  }
  file.end_record();
}

}  // namespace

void read_entities_4(Scanner& file, Contents& contents) {
  file.begin_record();
  std::array<std::size_t, 4> counts;
  for (std::size_t& count : counts) count = file.checked_count(file.size("the number of entities"), 8, 36, "entities");
  file.end_record();
  for (int dim = 0; dim < 4; ++dim)
    for (std::size_t i = 0; i < counts[dim]; ++i) read_entity(file, dim, contents);
}

void read_nodes_4(Scanner& file, Contents& contents) {
  const Header header = read_header(file, "nodes", 8, 32);
  contents.nodes.reserve(header.total);
  std::size_t left = header.total;
  for (std::size_t block = 0; block < header.blocks; ++block) {
    file.begin_record();
    const int dim = dimension(file);
    entity_tag(file);
    const bool parametric = file.integer("whether nodes have parameters") != 0;
    const std::size_t first = contents.nodes.size(), size = block_size(file, left);
    file.end_record();
    left -= size;
    for (std::size_t i = 0; i < size; ++i) {
      file.begin_record();
      Node node{0, {}, file.here()};
      node.tag = tag(file, "a node's tag");
      file.end_record();
      contents.nodes.push_back(node);
    }
    for (std::size_t i = first; i < contents.nodes.size(); ++i) {
      file.begin_record();
      contents.nodes[i].where = file.here();
      for (double& x : contents.nodes[i].x) x = file.number("a node's coordinate");
      for (int k = 0; parametric && k < dim; ++k) file.number("a node's parameter");
      file.end_record();
    }
  }
  check_none_left(file, left, "nodes");
}

void read_elements_4(Scanner& file, Contents& contents) {
  const Header header = read_header(file, "elements", 4, 16);
  std::size_t left = header.total;
  for (std::size_t block = 0; block < header.blocks; ++block) {
    file.begin_record();
    const int dim = dimension(file);
    const int entity = entity_tag(file);
    const TypeInfo type = type_info(file, file.integer("the type of a block of elements"), contents.dimension);
    if (type.dimension != dim)
      file.fail("elements of this type do not fit the entity",
                fmt::format("dimension {} in an entity of dimension {}", type.dimension, dim), damaged, file.last());
    const std::size_t size = block_size(file, left);
    file.end_record();
    left -= size;
    const auto groups = contents.entity_groups.find({dim, entity});
    for (std::size_t i = 0; i < size; ++i) {
      file.begin_record();
      Element element{0, ElementType::T3, {}, file.here()};
      element.tag = tag(file, "an element's tag");
      for (int k = 0; k < type.nodes; ++k) element.nodes[k] = tag(file, "a node of an element");
      file.end_record();
      add_element(contents, type, element,
                  groups == contents.entity_groups.end() ? std::vector<int>{} : groups->second);
    }
  }
  check_none_left(file, left, "elements");
}

}  // namespace scarp::gmsh
