#include "scarp/mesh/gmsh/check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "scarp/mesh/gmsh/joints.hpp"
#include "scarp/mesh/gmsh/sides.hpp"
#include "scarp/mesh/shapes.hpp"
#include "scarp/mesh/shapes/valid.hpp"

namespace scarp::gmsh {
namespace {

/// Heights below this part of an element's longest edge are errors: its shape functions lose all their digits.
constexpr double thinnest = 1e-6;

/// The least and greatest height over the corners, per longest edge: negative when a corner turns the other way.
struct Heights {
  double least = std::numeric_limits<double>::infinity();
  double greatest = -std::numeric_limits<double>::infinity();

  void add(double height) {
    least = std::min(least, height);
    greatest = std::max(greatest, height);
  }
};

template <class Shape>
requires(Shape::dim == 2) Heights corner_heights(const NodePositions<Shape>& x) {
  constexpr int n = Shape::nodes;
  double longest = 0;
  for (int i = 0; i < n; ++i) {
    const Vec<2> edge = detail::minus(x[(i + 1) % n], x[i]);
    longest = std::max(longest, std::hypot(edge[0], edge[1]));
  }
  Heights heights;
  for (int i = 0; i < n; ++i) {
    const Vec<2> u = detail::minus(x[(i + 1) % n], x[i]), v = detail::minus(x[(i + n - 1) % n], x[i]);
    heights.add(longest > 0 ? detail::cross(u, v) / (longest * longest) : 0);
  }
  return heights;
}

template <class Shape>
requires(Shape::dim == 3) Heights corner_heights(const NodePositions<Shape>& x) {
  double longest = 0;
  for (int i = 0; i < Shape::nodes; ++i)
    for (int j : Shape::corners[i]) longest = std::max(longest, detail::norm(detail::minus(x[j], x[i])));
  Heights heights;
  for (int i = 0; i < Shape::nodes; ++i) heights.add(longest > 0 ? corner_height<Shape>(x, i) / longest : 0);
  return heights;
}

template <class Shape>
void turn_round(std::vector<int>& nodes) {
  if constexpr (Shape::type == ElementType::T4) {
    std::swap(nodes[1], nodes[2]);
  } else if constexpr (Shape::type == ElementType::H8) {
    std::swap(nodes[1], nodes[3]);
    std::swap(nodes[5], nodes[7]);
  } else {
    std::reverse(nodes.begin() + 1, nodes.end());
  }
}

const char* name_of(ElementType type) {
  switch (type) {
    case ElementType::T3:
      return "triangle";
    case ElementType::Q4:
      return "quadrilateral";
    case ElementType::T4:
      return "tetrahedron";
    default:
      return "hexahedron";
  }
}

[[noreturn]] void fail_bent(const Scanner& file, const Element& element) {
  const int nodes = nodes_of(element.type);
  const bool solid = element.type == ElementType::H8;
  file.fail(fmt::format("element {}, a {}, is {}", element.tag, name_of(element.type),
                        solid ? "twisted: parts of it are turned inside out" : "not convex"),
            fmt::format("{} nodes: {}", nodes, fmt::join(element.nodes.begin(), element.nodes.begin() + nodes, ", ")),
            solid ? "number its nodes as Gmsh does, or make the mesh again with better shaped elements"
                  : "make the mesh again with better shaped elements",
            element.where);
}

template <class Shape>
void check(const Scanner& file, const Element& element, const Mesh<Shape::dim>& mesh, std::vector<int>& nodes) {
  const auto positions = [&] {
    NodePositions<Shape> x;
    for (int i = 0; i < Shape::nodes; ++i) x[i] = mesh.node(nodes[i]);
    return x;
  };
  Heights heights = corner_heights<Shape>(positions());
  if (heights.greatest < -thinnest) {
    turn_round<Shape>(nodes);
    heights = corner_heights<Shape>(positions());
  }
  if (heights.least > thinnest) {
    if constexpr (Shape::type == ElementType::H8)
      if (!positive_throughout(positions())) fail_bent(file, element);
    return;
  }
  if (heights.greatest > thinnest && heights.least < -thinnest) fail_bent(file, element);
  file.fail(fmt::format("element {}, a {}, has no {} to speak of", element.tag, name_of(element.type),
                        Shape::dim == 2 ? "area" : "volume"),
            fmt::format("a height of {:.3g} times its longest edge", heights.least),
            "make the mesh again with better shaped elements", element.where);
}

/// A triangle of an outer face of a tetrahedron that lies on three of the nodes of a hexahedron's outer face.
void check_mixed(const Scanner& file, const std::vector<Element>& elements, const std::vector<Side>& sides) {
  const auto sorted = [](std::array<int, 3> nodes) {
    std::sort(nodes.begin(), nodes.end());
    return nodes;
  };
  std::vector<std::pair<std::array<int, 3>, int>> triangles;
  for (std::size_t i = 0; i < sides.size(); ++i)
    if (const auto& [a, b, c, d] = sides[i].nodes; d < 0 && is_outer(sides, i))
      triangles.emplace_back(sorted({a, b, c}), sides[i].element);
  std::sort(triangles.begin(), triangles.end());
  for (std::size_t i = 0; i < sides.size() && !triangles.empty(); ++i) {
    const auto& [a, b, c, d] = sides[i].nodes;
    if (d < 0 || !is_outer(sides, i)) continue;
    for (const auto& part : {sorted({a, b, c}), sorted({b, c, d}), sorted({c, d, a}), sorted({d, a, b})}) {
      const auto at = std::lower_bound(triangles.begin(), triangles.end(), std::pair{part, -1});
      if (at == triangles.end() || at->first != part) continue;
      const Element &hexahedron = elements[sides[i].element], &tetrahedron = elements[at->second];
      file.fail(fmt::format("hexahedron {} and tetrahedron {} meet across a face", hexahedron.tag, tetrahedron.tag),
                "four nodes on one side and three on the other, so displacements would differ between them",
                "mesh volumes that share a surface with the same kind of element", tetrahedron.where);
    }
  }
}

}  // namespace

template <int Dim>
void check_shape(const Scanner& file, const Element& element, const Mesh<Dim>& mesh, std::vector<int>& nodes) {
  with_shape<Dim>(element.type, [&]<class Shape>(Shape) { check<Shape>(file, element, mesh, nodes); });
}

// Neighbours go round a shared side in opposite directions. Two that go the same way lie on top of one another.
template <int Dim>
void check_sides(const Scanner& file, const std::vector<Element>& elements, const Mesh<Dim>& mesh) {
  const std::vector<Side> sides = sorted_sides(mesh);
  for (std::size_t i = 1; i < sides.size(); ++i)
    if (sides[i].same_place(sides[i - 1]) && sides[i].backwards == sides[i - 1].backwards) {
      const Element &first = elements[sides[i - 1].element], &second = elements[sides[i].element];
      file.fail(fmt::format("elements {} and {} overlap", first.tag, second.tag),
                Dim == 2 ? "two elements on the same side of a shared edge"
                         : "two elements on the same side of a shared face",
                "make the mesh again", second.where);
    }
  if constexpr (Dim == 3) check_mixed(file, elements, sides);
  check_joints(file, elements, mesh, sides);
}

template void check_shape(const Scanner&, const Element&, const Mesh<2>&, std::vector<int>&);
template void check_shape(const Scanner&, const Element&, const Mesh<3>&, std::vector<int>&);
template void check_sides(const Scanner&, const std::vector<Element>&, const Mesh<2>&);
template void check_sides(const Scanner&, const std::vector<Element>&, const Mesh<3>&);

}  // namespace scarp::gmsh
