// Shape functions of the element types, local coordinates of points and their tests. Called for every point in
// every step, so everything is inline, on plain doubles, and without allocation.
//
// Each shape S has: S::nodes, S::dim, S::type, and (as static functions)
//   shape(xi, N)               values N_i at the local point xi
//   local_gradient(xi, dN)     dN_i/dxi
//   local_coordinates(x_i, x)  xi of the global point x, inside or outside the element
//   beyond(xi)                 how far xi is beyond the element's boundary, as a part of the element's height;
//                              negative inside
//   sides                      local nodes of each edge (2D) or face (3D), anticlockwise seen from outside
//   corners                    (3D) for each node the three that edges join to it, as a right-handed triple
// and the functions further down work on any of them.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "scarp/mesh/mesh.hpp"
#include "scarp/mesh/multilinear.hpp"
#include "scarp/mesh/shapes/plane.hpp"
#include "scarp/mesh/shapes/solid.hpp"

namespace scarp {

/// How far xi is outside the element, as a part of its height; 0 inside and on the boundary.
template <class Shape>
double outsideness(const Vec<Shape::dim>& xi) {
  return std::max(0.0, Shape::beyond(xi));
}

/// Is xi inside the element, or outside by no more than `tolerance` parts of its height? Never true for the
/// local coordinates of a point that is no number.
template <class Shape>
bool inside(const Vec<Shape::dim>& xi, double tolerance) {
  return Shape::beyond(xi) <= tolerance;
}

/// Shape functions N_i and their global gradients B_i = dN_i/dx [1/m] at the local point xi of an element with
/// node positions x_nodes [m]. Returns det J = det dx/dxi [m^2]: positive when nodes run anticlockwise.
template <class Shape>
requires(Shape::dim == 2) double gradients(const NodePositions<Shape>& x_nodes, const Vec<2>& xi,
                                           std::array<double, Shape::nodes>& N, std::array<Vec<2>, Shape::nodes>& B) {
  Shape::shape(xi, N);
  std::array<Vec<2>, Shape::nodes> dN;
  Shape::local_gradient(xi, dN);
  double x_xi = 0, x_eta = 0, y_xi = 0, y_eta = 0;
  for (int i = 0; i < Shape::nodes; ++i) {
    x_xi += x_nodes[i][0] * dN[i][0];
    x_eta += x_nodes[i][0] * dN[i][1];
    y_xi += x_nodes[i][1] * dN[i][0];
    y_eta += x_nodes[i][1] * dN[i][1];
  }
  const double J = x_xi * y_eta - x_eta * y_xi;
  const double inverse = 1 / J;
  for (int i = 0; i < Shape::nodes; ++i) {
    B[i][0] = (y_eta * dN[i][0] - y_xi * dN[i][1]) * inverse;
    B[i][1] = (x_xi * dN[i][1] - x_eta * dN[i][0]) * inverse;
  }
  return J;
}

/// The same in space; det J [m^3] is positive for elements that are not turned inside out.
template <class Shape>
requires(Shape::dim == 3) double gradients(const NodePositions<Shape>& x_nodes, const Vec<3>& xi,
                                           std::array<double, Shape::nodes>& N, std::array<Vec<3>, Shape::nodes>& B) {
  Shape::shape(xi, N);
  std::array<Vec<3>, Shape::nodes> dN;
  Shape::local_gradient(xi, dN);
  std::array<Vec<3>, 3> x_xi{};  // columns dx/dxi_j
  for (int i = 0; i < Shape::nodes; ++i)
    for (int j = 0; j < 3; ++j)
      for (int k = 0; k < 3; ++k) x_xi[j][k] += x_nodes[i][k] * dN[i][j];
  const std::array<Vec<3>, 3> cofactor = {detail::cross(x_xi[1], x_xi[2]), detail::cross(x_xi[2], x_xi[0]),
                                          detail::cross(x_xi[0], x_xi[1])};
  const double J = detail::dot(x_xi[0], cofactor[0]);
  const double inverse = 1 / J;
  for (int i = 0; i < Shape::nodes; ++i)
    for (int k = 0; k < 3; ++k)
      B[i][k] = (cofactor[0][k] * dN[i][0] + cofactor[1][k] * dN[i][1] + cofactor[2][k] * dN[i][2]) * inverse;
  return J;
}

/// The global point at xi [m].
template <class Shape>
Vec<Shape::dim> global_coordinates(const NodePositions<Shape>& x_nodes, const Vec<Shape::dim>& xi) {
  std::array<double, Shape::nodes> N;
  Shape::shape(xi, N);
  Vec<Shape::dim> x{};
  for (int i = 0; i < Shape::nodes; ++i)
    for (int k = 0; k < Shape::dim; ++k) x[k] += N[i] * x_nodes[i][k];
  return x;
}

/// Number of nodes of an element of this type.
constexpr int nodes_of(ElementType type) {
  switch (type) {
    case ElementType::T3:
      return T3::nodes;
    case ElementType::Q4:
      return Q4::nodes;
    case ElementType::T4:
      return T4::nodes;
    default:
      return H8::nodes;
  }
}

/// Calls f(Shape{}) with the shape of an element type of this dimension, so that the choice is made once per element.
template <int Dim, class F>
requires(Dim == 2) decltype(auto) with_shape(ElementType type, F&& f) {
  return type == ElementType::T3 ? std::forward<F>(f)(T3{}) : std::forward<F>(f)(Q4{});
}

template <int Dim, class F>
requires(Dim == 3) decltype(auto) with_shape(ElementType type, F&& f) {
  return type == ElementType::T4 ? std::forward<F>(f)(T4{}) : std::forward<F>(f)(H8{});
}

/// The number of a side, given as one of Shape::sides, as bases count them: of a simplex that of the node opposite; of
/// others 2d + 1 at the end of axis d of the local coordinates, 2d at its start.
template <class Shape, std::size_t n>
constexpr int side_of(const std::array<int, n>& local) {
  if constexpr (Shape::nodes == Shape::dim + 1) {
    int opposite = Shape::dim * (Shape::dim + 1) / 2;  // the sum of all nodes' numbers
    for (const int i : local) opposite -= i;
    return opposite;
  } else {
    for (int d = 0; d < Shape::dim; ++d) {
      int far = 0;
      for (const int i : local) far += detail::far_side(i, d);
      if (far == 0) return 2 * d;
      if (far == static_cast<int>(n)) return 2 * d + 1;
    }
    return -1;
  }
}

/// Positions of the nodes of element e, which must be of this shape [m].
template <class Shape>
NodePositions<Shape> node_positions(const Mesh<Shape::dim>& mesh, int e) {
  NodePositions<Shape> x;
  if (!mesh.grid) {  // in sweeps: of a number that is known, so that they stay in registers
    const int* n = mesh.lists.connectivity.data() + mesh.lists.offsets[e];
    for (int i = 0; i < Shape::nodes; ++i) x[i] = mesh.lists.nodes[n[i]];
    return x;
  }
  mesh.for_local_positions(e, [&, i = 0](const Vec<Shape::dim>& x_i) mutable { x[i++] = x_i; });
  return x;
}

}  // namespace scarp
