// From what a Gmsh file holds to a checked mesh.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "scarp/mesh/build.hpp"
#include "scarp/mesh/gmsh/contents.hpp"
#include "scarp/mesh/order.hpp"
#include "scarp/mesh/shapes.hpp"

namespace scarp::gmsh {
namespace {

constexpr const char* damaged = "the file is damaged; write it again with Gmsh";

/// Heights below this part of an element's longest edge are errors: its shape functions lose all their digits.
constexpr double thinnest = 1e-6;
/// More elements around one node than any usable mesh has; neighbours would take memory with the square of it.
constexpr int most_at_node = 1000;

bool lower_tag(const Node& a, const Node& b) {
  return a.tag < b.tag;
}

const Node* find_node(const std::vector<Node>& sorted, Tag tag) {
  const auto at = std::lower_bound(sorted.begin(), sorted.end(), Node{tag, {}, 0}, lower_tag);
  return at != sorted.end() && at->tag == tag ? &*at : nullptr;
}

void sort_nodes(const Scanner& file, std::vector<Node>& nodes) {
  std::stable_sort(nodes.begin(), nodes.end(), lower_tag);
  for (std::size_t i = 1; i < nodes.size(); ++i)
    if (nodes[i].tag == nodes[i - 1].tag)
      file.fail("two nodes have the same number", fmt::format("{}", nodes[i].tag), damaged, nodes[i].where);
}

/// An element in two physical surfaces stands twice in files of version 2.2; the first stays.
void drop_repeated(std::vector<Element>& elements) {
  const auto key = [&](std::size_t e) {
    std::array<Tag, 4> nodes = elements[e].nodes;
    std::sort(nodes.begin(), nodes.end());
    return nodes;
  };
  std::vector<std::size_t> order(elements.size());
  for (std::size_t e = 0; e < order.size(); ++e) order[e] = e;
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return key(a) < key(b); });
  std::vector<bool> repeated(elements.size(), false);
  for (std::size_t i = 1; i < order.size(); ++i) repeated[order[i]] = key(order[i]) == key(order[i - 1]);
  std::size_t kept = 0;
  for (std::size_t e = 0; e < elements.size(); ++e)
    if (!repeated[e]) elements[kept++] = elements[e];
  elements.resize(kept);
}

/// Numbers the nodes that elements use, in the order of `sorted`: -1 for the others.
std::vector<int> number_nodes(const Scanner& file, const std::vector<Node>& sorted,
                              const std::vector<Element>& elements) {
  std::vector<int> uses(sorted.size(), 0);
  for (const Element& element : elements)
    for (int i = 0; i < nodes_of(element.type); ++i) {
      const Node* node = find_node(sorted, element.nodes[i]);
      if (!node)
        file.fail(fmt::format("element {} uses a node that the file does not have", element.tag),
                  fmt::format("node {}", element.nodes[i]), damaged, element.where);
      if (++uses[node - sorted.data()] > most_at_node)
        file.fail(fmt::format("more than {} elements meet at one node", most_at_node),
                  fmt::format("node {}", node->tag), "make the mesh again", element.where);
    }
  int next = 0;
  for (int& number : uses) number = number > 0 ? next++ : -1;
  return uses;
}

void add_nodes(const Scanner& file, const std::vector<Node>& sorted, const std::vector<int>& number, Mesh<2>& mesh) {
  double extent = 0;
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    if (number[i] < 0) continue;
    mesh.nodes.push_back({sorted[i].x[0], sorted[i].x[1]});
    for (int k = 0; k < 2; ++k) extent = std::max(extent, std::abs(mesh.nodes.back()[k] - mesh.nodes.front()[k]));
  }
  // Squares of lengths must stay within the range of numbers.
  if (!(extent < 1e100)) file.fail("the mesh is too large", fmt::format("{} m", extent), damaged, file.here());
  for (std::size_t i = 0; i < sorted.size(); ++i)
    if (number[i] >= 0 && std::abs(sorted[i].x[2]) > 1e-9 * extent)
      file.fail(fmt::format("a plane mesh must lie at z = 0, but node {} does not", sorted[i].tag),
                fmt::format("z = {}", sorted[i].x[2]), "draw the geometry in the plane of x and y, at z = 0",
                sorted[i].where);
}

/// The least and greatest height over the corners, per longest edge: negative when a corner turns the other way.
struct Shape2D {
  double least, greatest;
};

Shape2D corner_heights(const Mesh<2>& mesh, const std::vector<int>& nodes) {
  double longest = 0;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const Vec<2> edge = detail::minus(mesh.nodes[nodes[(i + 1) % nodes.size()]], mesh.nodes[nodes[i]]);
    longest = std::max(longest, std::hypot(edge[0], edge[1]));
  }
  Shape2D heights{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const Vec<2>& corner = mesh.nodes[nodes[i]];
    const Vec<2> u = detail::minus(mesh.nodes[nodes[(i + 1) % nodes.size()]], corner);
    const Vec<2> v = detail::minus(mesh.nodes[nodes[(i + nodes.size() - 1) % nodes.size()]], corner);
    const double height = longest > 0 ? detail::cross(u, v) / (longest * longest) : 0;
    heights.least = std::min(heights.least, height);
    heights.greatest = std::max(heights.greatest, height);
  }
  return heights;
}

void check_shape(const Scanner& file, const Element& element, const Mesh<2>& mesh, std::vector<int>& nodes) {
  Shape2D heights = corner_heights(mesh, nodes);
  if (heights.greatest < -thinnest) {
    std::reverse(nodes.begin() + 1, nodes.end());
    heights = corner_heights(mesh, nodes);
  }
  if (heights.least > thinnest) return;
  const char* kind = element.type == ElementType::T3 ? "triangle" : "quadrilateral";
  if (heights.greatest > thinnest && heights.least < -thinnest)
    file.fail(fmt::format("element {}, a {}, is not convex", element.tag, kind),
              fmt::format("{} nodes: {}", nodes.size(),
                          fmt::join(element.nodes.begin(), element.nodes.begin() + nodes.size(), ", ")),
              "make the mesh again with better shaped elements", element.where);
  file.fail(fmt::format("element {}, a {}, has no area to speak of", element.tag, kind),
            fmt::format("a height of {:.3g} times its longest edge", heights.least),
            "make the mesh again with better shaped elements", element.where);
}

void add_elements(const Scanner& file, const std::vector<Node>& sorted, const std::vector<int>& number,
                  const std::vector<Element>& elements, Mesh<2>& mesh) {
  mesh.offsets.push_back(0);
  std::vector<int> nodes;
  for (const Element& element : elements) {
    nodes.clear();
    for (int i = 0; i < nodes_of(element.type); ++i)
      nodes.push_back(number[find_node(sorted, element.nodes[i]) - sorted.data()]);
    check_shape(file, element, mesh, nodes);
    mesh.types.push_back(element.type);
    mesh.connectivity.insert(mesh.connectivity.end(), nodes.begin(), nodes.end());
    mesh.offsets.push_back(static_cast<int>(mesh.connectivity.size()));
  }
}

/// Neighbours run along a shared edge in opposite directions. Two that run the same way lie on top of one another.
void check_overlaps(const Scanner& file, const std::vector<Element>& elements, const Mesh<2>& mesh) {
  struct Edge {
    int from, to, element;
    auto operator<=>(const Edge&) const = default;
  };
  std::vector<Edge> edges;
  edges.reserve(mesh.connectivity.size());
  for (int e = 0; e < mesh.element_count(); ++e) {
    const auto nodes = mesh.element_nodes(e);
    for (std::size_t i = 0; i < nodes.size(); ++i) edges.push_back({nodes[i], nodes[(i + 1) % nodes.size()], e});
  }
  std::sort(edges.begin(), edges.end());
  for (std::size_t i = 1; i < edges.size(); ++i)
    if (edges[i].from == edges[i - 1].from && edges[i].to == edges[i - 1].to) {
      const Element &first = elements[edges[i - 1].element], &second = elements[edges[i].element];
      file.fail(fmt::format("elements {} and {} overlap", first.tag, second.tag),
                "two elements on the same side of a shared edge", "make the mesh again", second.where);
    }
}

void add_node_sets(const Scanner& file, const std::vector<Node>& sorted, const std::vector<int>& number,
                   const Contents& contents, Mesh<2>& mesh) {
  for (const auto& [group, tags] : contents.group_nodes) {
    const auto name = contents.group_names.find(group);
    std::vector<int> set;
    for (Tag tag : tags) {
      const Node* node = find_node(sorted, tag);
      if (!node)
        file.fail("a physical group uses a node that the file does not have", fmt::format("node {}", tag), damaged,
                  file.here());
      if (number[node - sorted.data()] >= 0) set.push_back(number[node - sorted.data()]);
    }
    if (set.empty()) continue;
    auto& all = mesh.node_sets[name == contents.group_names.end() ? fmt::format("{}", group.second) : name->second];
    all.insert(all.end(), set.begin(), set.end());
    std::sort(all.begin(), all.end());
    all.erase(std::unique(all.begin(), all.end()), all.end());
  }
}

}  // namespace

TypeInfo type_info(const Scanner& file, std::int64_t type) {
  switch (type) {
    case 1:
      return {2, 1};
    case 2:
      return {3, 2};
    case 3:
      return {4, 2};
    case 15:
      return {1, 0};
    default:
      break;
  }
  static const std::map<std::int64_t, const char*> higher = {
      {8, "3-node line"},      {9, "6-node triangle"},   {10, "9-node quadrilateral"}, {16, "8-node quadrilateral"},
      {20, "9-node triangle"}, {21, "10-node triangle"}, {26, "4-node line"},          {27, "5-node line"}};
  static const std::map<std::int64_t, const char*> solid = {
      {4, "4-node tetrahedron"},   {5, "8-node hexahedron"},   {6, "6-node prism"},       {7, "5-node pyramid"},
      {11, "10-node tetrahedron"}, {12, "27-node hexahedron"}, {17, "20-node hexahedron"}};
  if (const auto at = higher.find(type); at != higher.end())
    file.fail("only 3-node triangles and 4-node quadrilaterals are read",
              fmt::format("a {} (type {})", at->second, type), "mesh with Mesh.ElementOrder = 1 (gmsh -order 1)",
              file.last());
  if (const auto at = solid.find(type); at != solid.end())
    file.fail("only plane meshes are read", fmt::format("a {} (type {})", at->second, type),
              "mesh surfaces only (gmsh -2)", file.last());
  file.fail("only 3-node triangles and 4-node quadrilaterals are read", fmt::format("an element of type {}", type),
            "mesh the surface with triangles or quadrilaterals of first order (gmsh -2 -order 1)", file.last());
}

void add_element(Contents& contents, const TypeInfo& type, const Element& element, const std::vector<int>& groups) {
  if (type.dimension == 2) {
    contents.elements.push_back(element);
    contents.elements.back().type = type.nodes == 3 ? ElementType::T3 : ElementType::Q4;
    return;
  }
  for (int group : groups) {
    std::vector<Tag>& nodes = contents.group_nodes[{type.dimension, group}];
    nodes.insert(nodes.end(), element.nodes.begin(), element.nodes.begin() + type.nodes);
  }
}

Mesh<2> to_mesh(const Scanner& file, Contents contents) {
  // Eight neighbours or so for each element must still be counted by int.
  constexpr std::size_t most = std::numeric_limits<int>::max() / 16;
  if (contents.elements.size() > most || contents.nodes.size() > most)
    file.fail(fmt::format("a mesh may have at most {} nodes and elements", most),
              fmt::format("{} nodes, {} elements", contents.nodes.size(), contents.elements.size()),
              "use a coarser mesh", file.here());
  if (contents.elements.empty())
    file.fail("the file holds no triangles or quadrilaterals", "",
              "mesh the surface (gmsh -2) and put it in a Physical Surface, or save all elements (Mesh.SaveAll = 1)",
              file.here());
  sort_nodes(file, contents.nodes);
  drop_repeated(contents.elements);
  const std::vector<int> number = number_nodes(file, contents.nodes, contents.elements);
  Mesh<2> mesh;
  add_nodes(file, contents.nodes, number, mesh);
  add_elements(file, contents.nodes, number, contents.elements, mesh);
  check_overlaps(file, contents.elements, mesh);
  add_node_sets(file, contents.nodes, number, contents, mesh);
  order_along_curve(mesh);
  complete(mesh);
  return mesh;
}

}  // namespace scarp::gmsh
