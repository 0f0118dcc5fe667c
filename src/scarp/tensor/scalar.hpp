// The scalar functions that generic code calls without qualification, for double. A SIMD batch brings its own
// (found by argument-dependent lookup, see batch.hpp), so that one text of a law serves both.
#pragma once

#include <algorithm>
#include <cmath>

namespace scarp {

/// The result of comparing two T: bool, or a mask with one bit for each lane.
template <class T>
using Mask = decltype(T() < T());

/// True in no lane.
template <class T>
inline Mask<T> no_lanes() {
  return T(0.0) != T(0.0);
}

inline double sqrt(double x) {
  return std::sqrt(x);
}
inline double cbrt(double x) {
  return std::cbrt(x);
}
inline double log(double x) {
  return std::log(x);
}
inline double expm1(double x) {
  return std::expm1(x);
}
inline double log1p(double x) {
  return std::log1p(x);
}
inline double sin(double x) {
  return std::sin(x);
}
inline double cos(double x) {
  return std::cos(x);
}
inline double exp(double x) {
  return std::exp(x);
}
inline double abs(double x) {
  return std::fabs(x);
}
inline double max(double a, double b) {
  return a > b ? a : b;
}
inline double min(double a, double b) {
  return a < b ? a : b;
}
inline double select(bool condition, double yes, double no) {
  return condition ? yes : no;
}
inline bool any(bool mask) {
  return mask;
}
inline bool all(bool mask) {
  return mask;
}

}  // namespace scarp
