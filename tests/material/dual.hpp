// Dual numbers v + d ε with ε² = 0: a function of them carries its exact derivative along.
#pragma once

#include <cmath>

namespace scarp::test {

struct Dual {
  double v = 0;  ///< value
  double d = 0;  ///< derivative

  Dual() = default;
  explicit Dual(double value, double derivative = 0) : v(value), d(derivative) {}
};

inline Dual operator+(const Dual& a, const Dual& b) {
  return Dual(a.v + b.v, a.d + b.d);
}
inline Dual operator-(const Dual& a, const Dual& b) {
  return Dual(a.v - b.v, a.d - b.d);
}
inline Dual operator-(const Dual& a) {
  return Dual(-a.v, -a.d);
}
inline Dual operator*(const Dual& a, const Dual& b) {
  return Dual(a.v * b.v, a.d * b.v + a.v * b.d);
}
inline Dual operator/(const Dual& a, const Dual& b) {
  return Dual(a.v / b.v, (a.d - a.v / b.v * b.d) / b.v);
}
inline bool operator<(const Dual& a, const Dual& b) {
  return a.v < b.v;
}
inline bool operator>(const Dual& a, const Dual& b) {
  return a.v > b.v;
}
inline bool operator<=(const Dual& a, const Dual& b) {
  return a.v <= b.v;
}
inline bool operator>=(const Dual& a, const Dual& b) {
  return a.v >= b.v;
}

inline Dual sqrt(const Dual& a) {
  const double root = std::sqrt(a.v);
  return Dual(root, root > 0 ? 0.5 * a.d / root : 0.0);
}
inline Dual log(const Dual& a) {
  return Dual(std::log(a.v), a.d / a.v);
}
inline Dual exp(const Dual& a) {
  const double value = std::exp(a.v);
  return Dual(value, a.d * value);
}
inline Dual abs(const Dual& a) {
  return a.v < 0 ? -a : a;
}
inline Dual max(const Dual& a, const Dual& b) {
  return a.v > b.v ? a : b;
}
inline Dual min(const Dual& a, const Dual& b) {
  return a.v < b.v ? a : b;
}
inline Dual select(bool condition, const Dual& yes, const Dual& no) {
  return condition ? yes : no;
}

}  // namespace scarp::test
