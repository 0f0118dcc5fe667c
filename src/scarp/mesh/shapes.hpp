// Shape functions of the element types, local coordinates of points and their tests. Called for every point in
// every step, so everything is inline, on plain doubles, and without allocation.
//
// Each shape S has: S::nodes, S::dim, S::type, and (as static functions)
//   shape(xi, N)               values N_i at the local point xi
//   local_gradient(xi, dN)     dN_i/dxi
//   local_coordinates(x_i, x)  xi of the global point x, inside or outside the element
//   beyond(xi)                 how far xi is beyond the element's boundary, as a part of the element's height;
//                              negative inside
// and the functions further down work on any of them. Another dimension adds its shapes to `with_shape`.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "scarp/mesh/mesh.hpp"

namespace scarp {

/// Positions of an element's nodes [m], in local node order.
template <class Shape>
using NodePositions = std::array<Vec<Shape::dim>, Shape::nodes>;

namespace detail {
inline double cross(const Vec<2>& a, const Vec<2>& b) {
  return a[0] * b[1] - a[1] * b[0];
}
inline Vec<2> minus(const Vec<2>& a, const Vec<2>& b) {
  return {a[0] - b[0], a[1] - b[1]};
}
}  // namespace detail

/// Three-node triangle; xi in the unit triangle, nodes (0,0), (1,0), (0,1).
struct T3 {
  static constexpr int nodes = 3, dim = 2;
  static constexpr ElementType type = ElementType::T3;

  static void shape(const Vec<2>& xi, std::array<double, 3>& N) { N = {1 - xi[0] - xi[1], xi[0], xi[1]}; }

  static void local_gradient(const Vec<2>&, std::array<Vec<2>, 3>& dN) { dN = {{{-1, -1}, {1, 0}, {0, 1}}}; }

  /// Closed form, exact anywhere in the plane.
  static Vec<2> local_coordinates(const NodePositions<T3>& x_nodes, const Vec<2>& x) {
    const Vec<2> u = detail::minus(x_nodes[1], x_nodes[0]), v = detail::minus(x_nodes[2], x_nodes[0]);
    const Vec<2> r = detail::minus(x, x_nodes[0]);
    const double inverse = 1 / detail::cross(u, v);
    return {detail::cross(r, v) * inverse, detail::cross(u, r) * inverse};
  }

  static double beyond(const Vec<2>& xi) {
    // The sum first: max keeps a NaN only there.
    return std::max({xi[0] + xi[1] - 1, -xi[0], -xi[1]});
  }
};

/// Four-node quadrilateral; xi in [-1,1]^2, nodes anticlockwise from (-1,-1).
struct Q4 {
  static constexpr int nodes = 4, dim = 2;
  static constexpr ElementType type = ElementType::Q4;

  static void shape(const Vec<2>& xi, std::array<double, 4>& N) {
    const double left = 0.5 * (1 - xi[0]), right = 0.5 * (1 + xi[0]);
    const double low = 0.5 * (1 - xi[1]), high = 0.5 * (1 + xi[1]);
    N = {left * low, right * low, right * high, left * high};
  }

  static void local_gradient(const Vec<2>& xi, std::array<Vec<2>, 4>& dN) {
    const double left = 0.25 * (1 - xi[0]), right = 0.25 * (1 + xi[0]);
    const double low = 0.25 * (1 - xi[1]), high = 0.25 * (1 + xi[1]);
    dN = {{{-low, -left}, {low, -right}, {high, right}, {-high, left}}};
  }

  /// Closed form. With x = a + b xi + c eta + d xi eta and r = x - a, eliminating eta (or xi) leaves
  ///   (d x b) xi^2 + (r x d - b x c) xi + r x c = 0,    (d x c) eta^2 + (r x d + b x c) eta + r x b = 0,
  /// and both have the discriminant J^2, J = det dx/dxi at the solution. J > 0 picks the root; it is written
  /// so that nothing cancels inside a convex element, and a parallelogram (d = 0) needs no case of its own.
  /// Points outside that have no solution get a place on the line J = 0, which is outside any convex element.
  static Vec<2> local_coordinates(const NodePositions<Q4>& x_nodes, const Vec<2>& x) {
    using detail::cross;
    const Vec<2> p = detail::minus(x_nodes[1], x_nodes[0]), q = detail::minus(x_nodes[2], x_nodes[0]),
                 s = detail::minus(x_nodes[3], x_nodes[0]), from_first = detail::minus(x, x_nodes[0]);
    Vec<2> b, c, d, r;
    for (int k = 0; k < 2; ++k) {
      b[k] = 0.25 * (p[k] + q[k] - s[k]);
      c[k] = 0.25 * (q[k] + s[k] - p[k]);
      d[k] = 0.25 * (q[k] - p[k] - s[k]);
      r[k] = from_first[k] - 0.25 * (p[k] + q[k] + s[k]);
    }
    const double bc = cross(b, c), rd = cross(r, d), db = cross(d, b), dc = cross(d, c), rc = cross(r, c);
    const double first = bc - rd, second = bc + rd;  // both positive inside a convex element
    const double square = first * first - 4 * db * rc;
    if (!(square < 1e200)) return {far, far};  // also x that is no number
    if (square < 0) return {quotient(0.5 * first, db), quotient(-0.5 * second, dc)};
    const double J = std::sqrt(square);
    if (first > 0 && second > 0) return {2 * rc / (first + J), -2 * cross(r, b) / (second + J)};
    return {first > 0 ? 2 * rc / (first + J) : quotient(first - J, 2 * db),
            second > 0 ? -2 * cross(r, b) / (second + J) : quotient(J - second, 2 * dc)};
  }

  static double beyond(const Vec<2>& xi) { return 0.5 * (std::max(std::abs(xi[0]), std::abs(xi[1])) - 1); }

 private:
  static constexpr double far = 1e30;

  /// Far outside, where the solution runs to infinity, a large finite number stands for it.
  static double quotient(double above, double below) {
    return std::abs(above) < far * std::abs(below) ? above / below : far;
  }
};

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
  return type == ElementType::T3 ? T3::nodes : Q4::nodes;
}

/// Calls f(Shape{}) with the shape of an element type, so that the choice is made once per element.
template <int Dim, class F>
requires(Dim == 2) decltype(auto) with_shape(ElementType type, F&& f) {
  return type == ElementType::T3 ? std::forward<F>(f)(T3{}) : std::forward<F>(f)(Q4{});
}

/// Positions of the nodes of element e, which must be of this shape [m].
template <class Shape>
NodePositions<Shape> node_positions(const Mesh<Shape::dim>& mesh, int e) {
  const int* node = mesh.connectivity.data() + mesh.offsets[e];
  NodePositions<Shape> x;
  for (int i = 0; i < Shape::nodes; ++i) x[i] = mesh.nodes[node[i]];
  return x;
}

}  // namespace scarp
