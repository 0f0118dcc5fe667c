// From what a Gmsh file holds to a checked mesh.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "scarp/mesh/build.hpp"
#include "scarp/mesh/gmsh/check.hpp"
#include "scarp/mesh/gmsh/contents.hpp"
#include "scarp/mesh/order.hpp"
#include "scarp/mesh/shapes.hpp"

namespace scarp::gmsh {
namespace {

constexpr const char* damaged = "the file is damaged; write it again with Gmsh";

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

/// An element in two physical groups stands twice in files of version 2.2; the first stays.
void drop_repeated(std::vector<Element>& elements) {
  struct Key {
    std::array<Tag, 8> nodes;
    std::size_t element;
    auto operator<=>(const Key&) const = default;
  };
  std::vector<Key> keys;
  keys.reserve(elements.size());
  for (std::size_t e = 0; e < elements.size(); ++e) {
    keys.push_back({elements[e].nodes, e});
    std::sort(keys.back().nodes.begin(), keys.back().nodes.end());
  }
  std::sort(keys.begin(), keys.end());
  std::vector<bool> repeated(elements.size(), false);
  for (std::size_t i = 1; i < keys.size(); ++i) repeated[keys[i].element] = keys[i].nodes == keys[i - 1].nodes;
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

template <int Dim>
void add_nodes(const Scanner& file, const std::vector<Node>& sorted, const std::vector<int>& number, Mesh<Dim>& mesh) {
  double extent = 0;
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    if (number[i] < 0) continue;
    Vec<Dim> x;
    for (int k = 0; k < Dim; ++k) x[k] = sorted[i].x[k];
    mesh.lists.nodes.push_back(x);
    for (int k = 0; k < Dim; ++k) extent = std::max(extent, std::abs(x[k] - mesh.lists.nodes.front()[k]));
  }
  // Squares of lengths (cubes, in space) must stay within the range of numbers.
  if (!(extent < 1e100)) file.fail("the mesh is too large", fmt::format("{} m", extent), damaged, file.here());
  if constexpr (Dim == 2)
    for (std::size_t i = 0; i < sorted.size(); ++i)
      if (number[i] >= 0 && std::abs(sorted[i].x[2]) > 1e-9 * extent)
        file.fail(fmt::format("a plane mesh must lie at z = 0, but node {} does not", sorted[i].tag),
                  fmt::format("z = {}", sorted[i].x[2]), "draw the geometry in the plane of x and y, at z = 0",
                  sorted[i].where);
}

template <int Dim>
void add_elements(const Scanner& file, const std::vector<Node>& sorted, const std::vector<int>& number,
                  const std::vector<Element>& elements, Mesh<Dim>& mesh) {
  mesh.lists.offsets.push_back(0);
  std::vector<int> nodes;
  for (const Element& element : elements) {
    nodes.clear();
    for (int i = 0; i < nodes_of(element.type); ++i)
      nodes.push_back(number[find_node(sorted, element.nodes[i]) - sorted.data()]);
    check_shape(file, element, mesh, nodes);
    mesh.lists.types.push_back(element.type);
    mesh.lists.connectivity.insert(mesh.lists.connectivity.end(), nodes.begin(), nodes.end());
    mesh.lists.offsets.push_back(static_cast<int>(mesh.lists.connectivity.size()));
  }
}

template <int Dim>
void add_node_sets(const Scanner& file, const std::vector<Node>& sorted, const std::vector<int>& number,
                   const Contents& contents, Mesh<Dim>& mesh) {
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

[[noreturn]] void fail_without_elements(const Scanner& file, const Contents& contents) {
  if (contents.dimension == 2)
    file.fail("the file holds no triangles or quadrilaterals", "",
              "mesh the surface (gmsh -2) and put it in a Physical Surface, or save all elements (Mesh.SaveAll = 1)",
              file.here());
  file.fail("a mesh of space is asked for, but the file holds no tetrahedra or hexahedra",
            fmt::format("{} elements of surfaces, lines and points", contents.lower_elements),
            "mesh the volume (gmsh -3) and put it in a Physical Volume, or set up the case in plane strain",
            file.here());
}

}  // namespace

template <int Dim>
Mesh<Dim> to_mesh(const Scanner& file, Contents contents) {
  // The elements around each, eight or so in the plane and up to a hundred in space, must still be counted by int.
  constexpr std::size_t most = std::numeric_limits<int>::max() / (Dim == 2 ? 16 : 128);
  if (contents.elements.size() > most || contents.nodes.size() > most)
    file.fail(fmt::format("a mesh may have at most {} nodes and elements", most),
              fmt::format("{} nodes, {} elements", contents.nodes.size(), contents.elements.size()),
              "use a coarser mesh", file.here());
  if (contents.elements.empty()) fail_without_elements(file, contents);
  sort_nodes(file, contents.nodes);
  drop_repeated(contents.elements);
  const std::vector<int> number = number_nodes(file, contents.nodes, contents.elements);
  Mesh<Dim> mesh;
  add_nodes(file, contents.nodes, number, mesh);
  add_elements(file, contents.nodes, number, contents.elements, mesh);
  check_sides(file, contents.elements, mesh);
  add_node_sets(file, contents.nodes, number, contents, mesh);
  order_along_curve(mesh);
  complete(mesh);
  return mesh;
}

template Mesh<2> to_mesh(const Scanner&, Contents);
template Mesh<3> to_mesh(const Scanner&, Contents);

}  // namespace scarp::gmsh
