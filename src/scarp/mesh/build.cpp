#include "scarp/mesh/build.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "scarp/mesh/shapes.hpp"

namespace scarp {
namespace {

/// Elements of each node, as offsets and a list (ascending for each node).
struct ElementsOfNodes {
  std::vector<int> offsets, elements;
};

template <int Dim>
ElementsOfNodes elements_of_nodes(const Mesh<Dim>& mesh) {
  ElementsOfNodes of;
  of.offsets.assign(mesh.nodes.size() + 1, 0);
  for (int node : mesh.connectivity) ++of.offsets[node + 1];
  for (std::size_t n = 0; n < mesh.nodes.size(); ++n) of.offsets[n + 1] += of.offsets[n];
  of.elements.resize(mesh.connectivity.size());
  std::vector<int> next(of.offsets.begin(), of.offsets.end() - 1);
  for (int e = 0; e < mesh.element_count(); ++e)
    for (int node : mesh.element_nodes(e)) of.elements[next[node]++] = e;
  return of;
}

}  // namespace

template <int Dim>
void build_around(Mesh<Dim>& mesh) {
  mesh.around_offsets.clear();
  mesh.around.clear();
  if (mesh.grid) return;
  const ElementsOfNodes of = elements_of_nodes(mesh);
  mesh.around_offsets.reserve(mesh.types.size() + 1);
  mesh.around_offsets.push_back(0);
  std::vector<int> found;
  for (int e = 0; e < mesh.element_count(); ++e) {
    found.clear();
    for (int node : mesh.element_nodes(e))
      found.insert(found.end(), of.elements.begin() + of.offsets[node], of.elements.begin() + of.offsets[node + 1]);
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
    std::copy_if(found.begin(), found.end(), std::back_inserter(mesh.around), [e](int other) { return other != e; });
    mesh.around_offsets.push_back(static_cast<int>(mesh.around.size()));
  }
}

namespace {

template <int Dim>
double cell_size(const Grid<Dim>& grid) {
  return *std::min_element(grid.spacing.begin(), grid.spacing.end());
}

/// Corners of elements are no nodes of theirs where a grid's functions are not linear.
template <int Dim>
bool has_no_corners(const Mesh<Dim>& mesh) {
  return mesh.grid && mesh.grid->functions != GridFunctions::linear;
}

template <int Dim>
double cell_volume(const Grid<Dim>& grid) {
  double volume = 1;
  for (const double edge : grid.spacing) volume *= edge;
  return volume;
}

}  // namespace

double element_size(const Mesh<2>& mesh, int e) {
  if (has_no_corners(mesh)) return cell_size(*mesh.grid);
  return with_shape<2>(mesh.types[e], [&]<class Shape>(Shape) {
    const NodePositions<Shape> x = node_positions<Shape>(mesh, e);
    std::array<Vec<2>, Shape::nodes> edge;
    std::array<double, Shape::nodes> length;
    for (int i = 0; i < Shape::nodes; ++i) {
      edge[i] = detail::minus(x[(i + 1) % Shape::nodes], x[i]);
      length[i] = std::hypot(edge[i][0], edge[i][1]);
    }
    // For a triangle every corner spans the same area, so the least over corners is that over the longest edge.
    double least = std::numeric_limits<double>::infinity();
    for (int i = 0; i < Shape::nodes; ++i) {
      const int j = (i + 1) % Shape::nodes;
      least = std::min(least, std::abs(detail::cross(edge[i], edge[j])) / std::max(length[i], length[j]));
    }
    return least;
  });
}

double element_size(const Mesh<3>& mesh, int e) {
  if (has_no_corners(mesh)) return cell_size(*mesh.grid);
  return with_shape<3>(mesh.types[e], [&]<class Shape>(Shape) {
    const NodePositions<Shape> x = node_positions<Shape>(mesh, e);
    // A tetrahedron's corners span the same volume, and three of its faces each: all four faces are seen.
    double least = std::numeric_limits<double>::infinity();
    for (int i = 0; i < Shape::nodes; ++i) least = std::min(least, std::abs(corner_height<Shape>(x, i)));
    return least;
  });
}

double element_area(const Mesh<2>& mesh, int e) {
  if (has_no_corners(mesh)) return cell_volume(*mesh.grid);
  const auto nodes = mesh.element_nodes(e);
  const Vec<2>& first = mesh.nodes[nodes[0]];
  double twice = 0;
  for (std::size_t i = 1; i + 1 < nodes.size(); ++i)
    twice += detail::cross(detail::minus(mesh.nodes[nodes[i]], first), detail::minus(mesh.nodes[nodes[i + 1]], first));
  return 0.5 * twice;
}

double element_volume(const Mesh<3>& mesh, int e) {
  if (has_no_corners(mesh)) return cell_volume(*mesh.grid);
  if (mesh.types[e] == ElementType::T4) {
    const NodePositions<T4> x = node_positions<T4>(mesh, e);
    const Vec<3> u = detail::minus(x[1], x[0]), v = detail::minus(x[2], x[0]), w = detail::minus(x[3], x[0]);
    return detail::dot(u, detail::cross(v, w)) / 6;
  }
  // det dx/dxi is of second degree in each local coordinate: two Gauss points along each are exact.
  const NodePositions<H8> x = node_positions<H8>(mesh, e);
  std::array<double, 8> N;
  std::array<Vec<3>, 8> B;
  const double g = 1 / std::sqrt(3.0);
  double volume = 0;
  for (int corner = 0; corner < 8; ++corner)
    volume += gradients<H8>(x, {corner & 1 ? g : -g, corner & 2 ? g : -g, corner & 4 ? g : -g}, N, B);
  return volume;
}

double mesh_volume(const Mesh<3>& mesh) {
  double volume = 0;
  for (int e = 0; e < mesh.element_count(); ++e) volume += element_volume(mesh, e);
  return volume;
}

double mesh_area(const Mesh<2>& mesh) {
  double area = 0;
  for (int e = 0; e < mesh.element_count(); ++e) area += element_area(mesh, e);
  return area;
}

template <int Dim>
void add_side_sets(Mesh<Dim>& mesh) {
  if (mesh.nodes.empty()) return;
  Vec<Dim> low = mesh.nodes[0], high = low;
  for (const Vec<Dim>& x : mesh.nodes)
    for (int k = 0; k < Dim; ++k) {
      low[k] = std::min(low[k], x[k]);
      high[k] = std::max(high[k], x[k]);
    }
  const auto add = [&](const char* name, int axis, double side) {
    if (mesh.node_sets.contains(name)) return;
    const double near = 1e-9 * (high[axis] - low[axis]);
    std::vector<int>& set = mesh.node_sets[name];
    for (int n = 0; n < mesh.node_count(); ++n)
      if (std::abs(mesh.nodes[n][axis] - side) <= near) set.push_back(n);
  };
  add("left", 0, low[0]);
  add("right", 0, high[0]);
  add("bottom", Dim - 1, low[Dim - 1]);
  add("top", Dim - 1, high[Dim - 1]);
  if constexpr (Dim == 3) {
    add("front", 1, low[1]);
    add("back", 1, high[1]);
  }
}

template <int Dim>
void complete(Mesh<Dim>& mesh) {
  build_around(mesh);
  mesh.size.resize(mesh.types.size());
  for (int e = 0; e < mesh.element_count(); ++e) mesh.size[e] = element_size(mesh, e);
  add_side_sets(mesh);
}

template void build_around(Mesh<2>&);
template void build_around(Mesh<3>&);
template void add_side_sets(Mesh<2>&);
template void add_side_sets(Mesh<3>&);
template void complete(Mesh<2>&);
template void complete(Mesh<3>&);

}  // namespace scarp
