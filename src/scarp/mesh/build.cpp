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
  const auto nodes = static_cast<std::size_t>(mesh.node_count());
  of.offsets.assign(nodes + 1, 0);
  for (int node : mesh.lists.connectivity) ++of.offsets[node + 1];
  for (std::size_t n = 0; n < nodes; ++n) of.offsets[n + 1] += of.offsets[n];
  of.elements.resize(mesh.lists.connectivity.size());
  std::vector<int> next(of.offsets.begin(), of.offsets.end() - 1);
  for (int e = 0; e < mesh.element_count(); ++e)
    for (int node : mesh.element_nodes(e)) of.elements[next[node]++] = e;
  return of;
}

}  // namespace

template <int Dim>
void build_around(Mesh<Dim>& mesh) {
  auto& around = mesh.lists.around;
  auto& offsets = mesh.lists.around_offsets;
  around.clear();
  offsets.clear();
  const ElementsOfNodes of = elements_of_nodes(mesh);
  offsets.reserve(mesh.lists.types.size() + 1);
  offsets.push_back(0);
  std::vector<int> found;
  for (int e = 0; e < mesh.element_count(); ++e) {
    found.clear();
    for (int node : mesh.element_nodes(e))
      found.insert(found.end(), of.elements.begin() + of.offsets[node], of.elements.begin() + of.offsets[node + 1]);
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
    std::copy_if(found.begin(), found.end(), std::back_inserter(around), [e](int other) { return other != e; });
    offsets.push_back(static_cast<int>(around.size()));
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
  return with_shape<2>(mesh.type_of(e), [&]<class Shape>(Shape) {
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
  return with_shape<3>(mesh.type_of(e), [&]<class Shape>(Shape) {
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
  const Vec<2> first = mesh.node(nodes[0]);
  double twice = 0;
  for (std::size_t i = 1; i + 1 < nodes.size(); ++i)
    twice += detail::cross(detail::minus(mesh.node(nodes[i]), first), detail::minus(mesh.node(nodes[i + 1]), first));
  return 0.5 * twice;
}

double element_volume(const Mesh<3>& mesh, int e) {
  if (has_no_corners(mesh)) return cell_volume(*mesh.grid);
  if (mesh.type_of(e) == ElementType::T4) {
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

namespace {

/// f(edges) for every cell of a grid that is unlike the others in the last bits of its edges.
template <int Dim, class F>
void for_unlike_cells(const Grid<Dim>& grid, F&& f) {
  std::array<std::vector<double>, Dim> edges;
  std::array<std::size_t, Dim> at{};
  for (int k = 0; k < Dim; ++k) {
    for (int i = 0; i < grid.elements[k]; ++i) {
      const double edge = grid.lines[k][i + 1] - grid.lines[k][i];
      if (std::find(edges[k].begin(), edges[k].end(), edge) == edges[k].end()) edges[k].push_back(edge);
    }
  }
  while (true) {
    Vec<Dim> edge;
    for (int k = 0; k < Dim; ++k) edge[k] = edges[k][at[k]];
    f(edge);
    int k = 0;
    while (++at[k] == edges[k].size()) {
      at[k] = 0;
      if (++k == Dim) return;
    }
  }
}

}  // namespace

template <int Dim>
double least_size(const Mesh<Dim>& mesh) {
  double least = std::numeric_limits<double>::infinity();
  if (!mesh.grid) {
    for (const double size : mesh.lists.size) least = std::min(least, size);
  } else if (mesh.grid->functions == GridFunctions::linear) {
    for_unlike_cells(*mesh.grid, [&](const Vec<Dim>& edge) { least = std::min(least, detail::least_height(edge)); });
  } else {
    least = mesh.size_of(0);  // at sides functions are no wider than inside
  }
  return least;
}

template <int Dim>
BoxOf<Dim> bounds(const Mesh<Dim>& mesh) {
  BoxOf<Dim> box;
  if (mesh.grid) {
    for (int k = 0; k < Dim; ++k) {
      box.low[k] = mesh.grid->lines[k].front();
      box.high[k] = mesh.grid->lines[k].back();
    }
    return box;
  }
  box.low.fill(std::numeric_limits<double>::infinity());
  box.high.fill(-std::numeric_limits<double>::infinity());
  for (const Vec<Dim>& x : mesh.lists.nodes)
    for (int k = 0; k < Dim; ++k) {
      box.low[k] = std::min(box.low[k], x[k]);
      box.high[k] = std::max(box.high[k], x[k]);
    }
  return box;
}

template <int Dim>
double largest_coordinate(const Mesh<Dim>& mesh) {
  const BoxOf<Dim> box = bounds(mesh);
  double largest = 0;
  for (int k = 0; k < Dim && mesh.node_count() > 0; ++k)
    largest = std::max({largest, std::abs(box.low[k]), std::abs(box.high[k])});
  return largest;
}

template <int Dim>
void add_side_sets(Mesh<Dim>& mesh) {
  if (mesh.node_count() == 0) return;
  const BoxOf<Dim> box = bounds(mesh);
  for (const auto& [name, axis, last] : sides_of_box<Dim>) {
    if (mesh.node_sets.contains(name)) continue;
    const double near = 1e-9 * (box.high[axis] - box.low[axis]), side = last ? box.high[axis] : box.low[axis];
    std::vector<int>& set = mesh.node_sets[name];
    for (int n = 0; n < mesh.node_count(); ++n)
      if (std::abs(mesh.lists.nodes[n][axis] - side) <= near) set.push_back(n);
  }
}

template <int Dim>
void complete(Mesh<Dim>& mesh) {
  build_around(mesh);
  mesh.lists.size.resize(mesh.lists.types.size());
  for (int e = 0; e < mesh.element_count(); ++e) mesh.lists.size[e] = element_size(mesh, e);
  add_side_sets(mesh);
}

template double least_size(const Mesh<2>&);
template double least_size(const Mesh<3>&);
template BoxOf<2> bounds(const Mesh<2>&);
template BoxOf<3> bounds(const Mesh<3>&);
template double largest_coordinate(const Mesh<2>&);
template double largest_coordinate(const Mesh<3>&);
template void build_around(Mesh<2>&);
template void build_around(Mesh<3>&);
template void add_side_sets(Mesh<2>&);
template void add_side_sets(Mesh<3>&);
template void complete(Mesh<2>&);
template void complete(Mesh<3>&);

}  // namespace scarp
