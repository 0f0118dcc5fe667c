// Vector products for the geometry of elements.
#pragma once

#include <array>
#include <cmath>

#include "scarp/base/vec.hpp"

namespace scarp {

/// Positions of an element's nodes [m], in local node order.
template <class Shape>
using NodePositions = std::array<Vec<Shape::dim>, Shape::nodes>;

namespace detail {

inline double cross(const Vec<2>& a, const Vec<2>& b) {
  return a[0] * b[1] - a[1] * b[0];
}

inline Vec<3> cross(const Vec<3>& a, const Vec<3>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

inline Vec<2> minus(const Vec<2>& a, const Vec<2>& b) {
  return {a[0] - b[0], a[1] - b[1]};
}

inline Vec<3> minus(const Vec<3>& a, const Vec<3>& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

inline double dot(const Vec<3>& a, const Vec<3>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

inline double norm(const Vec<3>& a) {
  return std::sqrt(dot(a, a));
}

}  // namespace detail
}  // namespace scarp
