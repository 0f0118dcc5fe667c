// Version 2.2: a line (or record) per node and element; a physical group is an element's first tag.
#include <fmt/format.h>

#include <cstdlib>

#include "scarp/mesh/gmsh/contents.hpp"

namespace scarp::gmsh {
namespace {

constexpr const char* damaged = "the file is damaged; write it again with Gmsh";

// Counts are text in binary files too.
std::uint64_t text_count(Scanner& file, const char* what) {
  file.skip_space();
  const std::int64_t count = file.text_integer(what);
  if (count < 0)
    file.fail(fmt::format("{} must not be negative", what), fmt::format("{}", count), damaged, file.last());
  file.line("the end of the line");
  return static_cast<std::uint64_t>(count);
}

Tag positive(Scanner& file, const char* what) {
  const std::int64_t tag = file.integer(what);
  if (tag <= 0) file.fail(fmt::format("{} must be positive", what), fmt::format("{}", tag), damaged, file.last());
  return static_cast<Tag>(tag);
}

std::int64_t tag_count(Scanner& file) {
  const std::int64_t tags = file.integer("the number of an element's tags");
  if (tags < 0)
    file.fail("the number of an element's tags must not be negative", fmt::format("{}", tags), damaged, file.last());
  return tags;
}

/// Tags and nodes of one element.
void read_rest(Scanner& file, const TypeInfo& type, std::int64_t tags, Element& element, Contents& contents) {
  std::vector<int> groups;
  for (std::int64_t i = 0; i < tags; ++i) {
    const std::int64_t tag = file.integer("an element's tag");
    // Gmsh writes 0 for none, and a minus for a line that runs backwards.
    if (i == 0 && tag != 0) groups.push_back(static_cast<int>(std::abs(tag)));
  }
  for (int i = 0; i < type.nodes; ++i) element.nodes[i] = positive(file, "a node of an element");
  add_element(contents, type, element, groups);
}

}  // namespace

void read_nodes_2(Scanner& file, Contents& contents) {
  const std::size_t count = file.checked_count(text_count(file, "the number of nodes"), 8, 28, "nodes");
  contents.nodes.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    file.begin_record();
    Node node{0, {}, file.here()};
    node.tag = positive(file, "a node's number");
    for (double& x : node.x) x = file.number("a node's coordinate");
    file.end_record();
    contents.nodes.push_back(node);
  }
}

void read_elements_2(Scanner& file, Contents& contents) {
  const std::size_t count = file.checked_count(text_count(file, "the number of elements"), 8, 8, "elements");
  std::size_t done = 0;
  while (done < count) {
    file.begin_record();
    Element element{0, ElementType::T3, {}, file.here()};
    if (!file.binary()) {
      element.tag = positive(file, "an element's number");
      const TypeInfo type = type_info(file, file.integer("an element's type"), contents.dimension);
      read_rest(file, type, tag_count(file), element, contents);
      file.end_record();
      ++done;
      continue;
    }
    const TypeInfo type = type_info(file, file.integer("the type of a block of elements"), contents.dimension);
    const std::int64_t block = file.integer("the number of elements in a block");
    if (block < 1 || static_cast<std::uint64_t>(block) > count - done)
      file.fail("the blocks of elements do not add up to the number of elements",
                fmt::format("a block of {} where {} are left", block, count - done), damaged, file.last());
    const std::int64_t tags = tag_count(file);
    for (std::int64_t i = 0; i < block; ++i) {
      element.where = file.here();
      element.tag = positive(file, "an element's number");
      read_rest(file, type, tags, element, contents);
    }
    done += static_cast<std::size_t>(block);
  }
}

}  // namespace scarp::gmsh
