// Shapes of space: tetrahedron and hexahedron.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "scarp/mesh/mesh.hpp"
#include "scarp/mesh/shapes/vectors.hpp"

namespace scarp {

/// Four-node tetrahedron; xi in the unit tetrahedron, nodes (0,0,0), (1,0,0), (0,1,0), (0,0,1).
struct T4 {
  static constexpr int nodes = 4, dim = 3;
  static constexpr ElementType type = ElementType::T4;
  static constexpr std::array<std::array<int, 3>, 4> sides = {{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}};
  static constexpr std::array<std::array<int, 3>, 4> corners = {{{1, 2, 3}, {2, 0, 3}, {0, 1, 3}, {1, 0, 2}}};

  static void shape(const Vec<3>& xi, std::array<double, 4>& N) {
    N = {1 - xi[0] - xi[1] - xi[2], xi[0], xi[1], xi[2]};
  }

  static void local_gradient(const Vec<3>&, std::array<Vec<3>, 4>& dN) {
    dN = {{{-1, -1, -1}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  }

  /// Closed form, exact anywhere in space.
  static Vec<3> local_coordinates(const NodePositions<T4>& x_nodes, const Vec<3>& x) {
    using namespace detail;
    const Vec<3> u = minus(x_nodes[1], x_nodes[0]), v = minus(x_nodes[2], x_nodes[0]),
                 w = minus(x_nodes[3], x_nodes[0]);
    const Vec<3> r = minus(x, x_nodes[0]), vw = cross(v, w);
    const double inverse = 1 / dot(u, vw);
    return {dot(r, vw) * inverse, dot(r, cross(w, u)) * inverse, dot(r, cross(u, v)) * inverse};
  }

  static double beyond(const Vec<3>& xi) {
    // The sum first: max keeps a NaN only there.
    return std::max({xi[0] + xi[1] + xi[2] - 1, -xi[0], -xi[1], -xi[2]});
  }
};

/// Eight-node hexahedron; xi in [-1,1]^3, nodes anticlockwise from (-1,-1) seen from above, the lower four first.
struct H8 {
  static constexpr int nodes = 8, dim = 3;
  static constexpr ElementType type = ElementType::H8;
  static constexpr std::array<std::array<int, 4>, 6> sides = {
      {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}};
  static constexpr std::array<std::array<int, 3>, 8> corners = {
      {{1, 3, 4}, {2, 0, 5}, {3, 1, 6}, {0, 2, 7}, {7, 5, 0}, {4, 6, 1}, {5, 7, 2}, {6, 4, 3}}};

  static void shape(const Vec<3>& xi, std::array<double, 8>& N) {
    const double left = 0.125 * (1 - xi[0]), right = 0.125 * (1 + xi[0]);
    const double front = 1 - xi[1], back = 1 + xi[1], low = 1 - xi[2], high = 1 + xi[2];
    const std::array<double, 4> plan = {left * front, right * front, right * back, left * back};
    for (int i = 0; i < 4; ++i) {
      N[i] = plan[i] * low;
      N[i + 4] = plan[i] * high;
    }
  }

  static void local_gradient(const Vec<3>& xi, std::array<Vec<3>, 8>& dN) {
    const double left = 0.125 * (1 - xi[0]), right = 0.125 * (1 + xi[0]);
    const double front = 1 - xi[1], back = 1 + xi[1], low = 1 - xi[2], high = 1 + xi[2];
    const std::array<double, 4> plan = {left * front, right * front, right * back, left * back};
    const std::array<double, 4> d_xi = {-0.125 * front, 0.125 * front, 0.125 * back, -0.125 * back};
    const std::array<double, 4> d_eta = {-left, -right, right, left};
    for (int i = 0; i < 4; ++i) {
      dN[i] = {d_xi[i] * low, d_eta[i] * low, -plan[i]};
      dN[i + 4] = {d_xi[i] * high, d_eta[i] * high, plan[i]};
    }
  }

  /// The map x(xi) - x_0 = a + sum_j b_j xi_j + (c_0 xi_1 xi_2 + c_1 xi_2 xi_0 + c_2 xi_0 xi_1) + d xi_0 xi_1 xi_2.
  struct Map {
    Vec<3> a;
    std::array<Vec<3>, 3> b, c;
    Vec<3> d;

    explicit Map(const NodePositions<H8>& x_nodes);
    /// Columns dx/dxi_j at xi.
    std::array<Vec<3>, 3> derivative(const Vec<3>& xi) const;
    Vec<3> value(const Vec<3>& xi) const;
    /// Is the element a parallelepiped, to round-off?
    bool straight() const;
  };

  /// Closed form for a parallelepiped. For others Newton's method from the centre; where that does not reach a point
  /// with det J > 0 in a fixed number of steps, search_parts() decides. A point that has no such place gets one far
  /// outside, so an element whose det J is positive throughout contains exactly the points of its image.
  static Vec<3> local_coordinates(const NodePositions<H8>& x_nodes, const Vec<3>& x) {
    const Map map(x_nodes);
    const Vec<3> r = detail::minus(x, x_nodes[0]);
    Vec<3> xi{};
    double J;
    if (map.straight()) {
      newton_step(map, r, xi, J);
      return size(xi) < far ? xi : Vec<3>{far, far, far};  // also x that is no number
    }
    if (newton(map, r, xi, J) && J > 0) return xi;
    return search_parts(map, x_nodes, x);
  }

  static double beyond(const Vec<3>& xi) { return 0.5 * (size(xi) - 1); }

 private:
  static constexpr double far = 1e30;

  /// The largest of the |xi_j|; NaN when any is.
  static double size(const Vec<3>& xi) {
    const double largest = std::max({std::abs(xi[0]), std::abs(xi[1]), std::abs(xi[2])});
    return largest + 0 * (xi[0] + xi[1] + xi[2]);
  }

  /// One step; returns its size.
  static double newton_step(const Map& map, const Vec<3>& r, Vec<3>& xi, double& J) {
    using namespace detail;
    const std::array<Vec<3>, 3> by = map.derivative(xi);
    const Vec<3> off = minus(r, map.value(xi)), c0 = cross(by[1], by[2]);
    J = dot(by[0], c0);
    const double inverse = 1 / J;
    const Vec<3> step = {dot(off, c0) * inverse, dot(off, cross(by[2], by[0])) * inverse,
                         dot(off, cross(by[0], by[1])) * inverse};
    for (int k = 0; k < 3; ++k) xi[k] += step[k];
    return size(step);
  }

  /// From xi to the solution; false when 12 steps do not get there. Convergence is quadratic, so after a step of 1e-9
  /// nothing but round-off is left.
  static bool newton(const Map& map, const Vec<3>& r, Vec<3>& xi, double& J) {
    for (int i = 0; i < 12; ++i) {
      const double step = newton_step(map, r, xi, J);
      if (step <= 1e-9 * std::max(1.0, size(xi))) return true;
      if (!(step < 1e6)) return false;
    }
    return false;
  }

  /// Newton's method from the centres of ever smaller parts of the local cube, eight in each, three levels deep,
  /// leaving out each part that cannot hold x: a part's image lies in the hull of the images of its corners.
  static Vec<3> search_parts(const Map& map, const NodePositions<H8>& x_nodes, const Vec<3>& x);
  static bool search_part(const Map& map, const Vec<3>& r, const Vec<3>& centre, double half, Vec<3>& xi);
};

inline H8::Map::Map(const NodePositions<H8>& x_nodes) {
  for (int k = 0; k < 3; ++k) {
    const auto p = [&](int i) { return x_nodes[i][k] - x_nodes[0][k]; };
    // Sums and differences over the two ends of xi_0, of xi_1, of xi_2, in turn.
    const double sum[4] = {p(1), p(2) + p(3), p(4) + p(5), p(6) + p(7)};
    const double difference[4] = {p(1), p(2) - p(3), p(5) - p(4), p(6) - p(7)};
    const auto combine = [](const double(&f)[4], double& both, double& along_1, double& along_2, double& mixed) {
      both = 0.125 * ((f[0] + f[1]) + (f[2] + f[3]));
      along_1 = 0.125 * ((f[1] - f[0]) + (f[3] - f[2]));
      along_2 = 0.125 * ((f[2] + f[3]) - (f[0] + f[1]));
      mixed = 0.125 * ((f[3] - f[2]) - (f[1] - f[0]));
    };
    combine(sum, a[k], b[1][k], b[2][k], c[0][k]);
    combine(difference, b[0][k], c[2][k], c[1][k], d[k]);
  }
}

inline std::array<Vec<3>, 3> H8::Map::derivative(const Vec<3>& xi) const {
  std::array<Vec<3>, 3> by;
  for (int k = 0; k < 3; ++k) {
    by[0][k] = b[0][k] + c[2][k] * xi[1] + (c[1][k] + d[k] * xi[1]) * xi[2];
    by[1][k] = b[1][k] + c[0][k] * xi[2] + (c[2][k] + d[k] * xi[2]) * xi[0];
    by[2][k] = b[2][k] + c[1][k] * xi[0] + (c[0][k] + d[k] * xi[0]) * xi[1];
  }
  return by;
}

inline Vec<3> H8::Map::value(const Vec<3>& xi) const {
  Vec<3> x;
  for (int k = 0; k < 3; ++k)
    x[k] = a[k] + (b[0][k] + c[2][k] * xi[1] + (c[1][k] + d[k] * xi[1]) * xi[2]) * xi[0] +
           (b[1][k] + c[0][k] * xi[2]) * xi[1] + b[2][k] * xi[2];
  return x;
}

inline bool H8::Map::straight() const {
  double bent = 0, length = 0;
  for (int k = 0; k < 3; ++k) {
    for (int j = 0; j < 3; ++j) {
      bent = std::max(bent, std::abs(c[j][k]));
      length = std::max(length, std::abs(b[j][k]));
    }
    bent = std::max(bent, std::abs(d[k]));
  }
  return bent <= 1e-15 * length;
}

/// Height of the parallelepiped that the three edges of a corner span, on the largest of its faces [m]; negative when
/// the corner is turned inside out, and 0 when its edges lie in a line.
template <class Shape>
double corner_height(const NodePositions<Shape>& x_nodes, int corner) {
  using namespace detail;
  const auto& [i, j, k] = Shape::corners[corner];
  const Vec<3> u = minus(x_nodes[i], x_nodes[corner]), v = minus(x_nodes[j], x_nodes[corner]),
               w = minus(x_nodes[k], x_nodes[corner]);
  const Vec<3> vw = cross(v, w);
  const double largest = std::max({norm(vw), norm(cross(w, u)), norm(cross(u, v))});
  return largest > 0 ? dot(u, vw) / largest : 0;
}

}  // namespace scarp
