// Shapes of the plane: triangle and quadrilateral.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "scarp/mesh/mesh.hpp"
#include "scarp/mesh/shapes/vectors.hpp"

namespace scarp {

/// Three-node triangle; xi in the unit triangle, nodes (0,0), (1,0), (0,1).
struct T3 {
  static constexpr int nodes = 3, dim = 2;
  static constexpr ElementType type = ElementType::T3;
  static constexpr std::array<std::array<int, 2>, 3> sides = {{{0, 1}, {1, 2}, {2, 0}}};

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
  static constexpr std::array<std::array<int, 2>, 4> sides = {{{0, 1}, {1, 2}, {2, 3}, {3, 0}}};

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

}  // namespace scarp
