// Closed surfaces whose volume and shape are known.
#pragma once

#include <cmath>
#include <vector>

#include "scarp/base/facet.hpp"

namespace scarp::test {

using Triangles = std::vector<Triangle>;

/// The corners of a triangle swapped, so that it faces the other way.
inline Triangles turned(Triangles triangles) {
  for (auto& triangle : triangles) std::swap(triangle[1], triangle[2]);
  return triangles;
}

inline Triangles together(Triangles a, const Triangles& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

/// A convex polygon of x and z (anticlockwise seen from -y), extruded from y = low to high.
inline Triangles extruded(const std::vector<Vec<2>>& polygon, double low, double high) {
  Triangles triangles;
  const auto at = [&](std::size_t i, double y) {
    const auto& corner = polygon[i % polygon.size()];
    return Vec<3>{corner[0], y, corner[1]};
  };
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    triangles.push_back({at(i, low), at(i + 1, low), at(i + 1, high)});
    triangles.push_back({at(i, low), at(i + 1, high), at(i, high)});
    if (i > 0 && i + 1 < polygon.size()) {
      triangles.push_back({at(0, low), at(i + 1, low), at(i, low)});
      triangles.push_back({at(0, high), at(i, high), at(i + 1, high)});
    }
  }
  return turned(triangles);
}

inline Triangles box(const Vec<3>& low, const Vec<3>& high) {
  return extruded({{low[0], low[2]}, {high[0], low[2]}, {high[0], high[2]}, {low[0], high[2]}}, low[1], high[1]);
}

/// Corner at `corner`, legs of length `leg` along the axes.
inline Triangles tetrahedron(const Vec<3>& corner, double leg) {
  const Vec<3> o = corner, x{o[0] + leg, o[1], o[2]}, y{o[0], o[1] + leg, o[2]}, z{o[0], o[1], o[2] + leg};
  return {{o, y, x}, {o, x, z}, {o, z, y}, {x, y, z}};
}

/// An octahedron refined towards the unit sphere `level` times (8·4^level triangles), scaled and moved.
inline Triangles sphere(int level, double radius, const Vec<3>& centre) {
  const Vec<3> x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1}, X{-1, 0, 0}, Y{0, -1, 0}, Z{0, 0, -1};
  Triangles triangles{{x, y, z}, {y, X, z}, {X, Y, z}, {Y, x, z}, {y, x, Z}, {X, y, Z}, {Y, X, Z}, {x, Y, Z}};
  const auto between = [](const Vec<3>& a, const Vec<3>& b) {
    Vec<3> m{a[0] + b[0], a[1] + b[1], a[2] + b[2]};
    const double length = std::sqrt(m[0] * m[0] + m[1] * m[1] + m[2] * m[2]);
    for (double& c : m) c /= length;
    return m;
  };
  for (int k = 0; k < level; ++k) {
    Triangles finer;
    for (const auto& [a, b, c] : triangles) {
      const Vec<3> ab = between(a, b), bc = between(b, c), ca = between(c, a);
      for (const Triangle& t : {Triangle{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}}) finer.push_back(t);
    }
    triangles = finer;
  }
  for (auto& triangle : triangles) {
    for (auto& corner : triangle) {
      for (int j = 0; j < 3; ++j) corner[j] = centre[j] + radius * corner[j];
    }
  }
  return triangles;
}

/// Turned about the axis (1, 2, 2)/3 by an angle whose cosine and sine are 3/5 and 4/5: nothing stays along an axis.
inline Triangles tilted(Triangles triangles) {
  for (auto& triangle : triangles) {
    for (auto& v : triangle) {
      const Vec<3> k{1.0 / 3, 2.0 / 3, 2.0 / 3};
      const double kv = k[0] * v[0] + k[1] * v[1] + k[2] * v[2];
      const Vec<3> cross{k[1] * v[2] - k[2] * v[1], k[2] * v[0] - k[0] * v[2], k[0] * v[1] - k[1] * v[0]};
      for (int j = 0; j < 3; ++j) v[j] = 0.6 * v[j] + 0.8 * cross[j] + 0.4 * kv * k[j];
    }
  }
  return triangles;
}

}  // namespace scarp::test
