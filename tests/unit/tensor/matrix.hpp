// Plain 3 × 3 matrices: the obvious twin of the Mandel components.
#pragma once

#include <array>
#include <random>

#include "scarp/tensor/sym.hpp"

namespace scarp::test {

using Matrix = std::array<std::array<double, 3>, 3>;

inline Matrix operator*(const Matrix& a, const Matrix& b) {
  Matrix r{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      for (std::size_t k = 0; k < 3; ++k) r[i][j] += a[i][k] * b[k][j];
  return r;
}

inline Matrix transposed(const Matrix& a) {
  Matrix r{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) r[i][j] = a[j][i];
  return r;
}

inline double determinant(const Matrix& a) {
  return a[0][0] * (a[1][1] * a[2][2] - a[1][2] * a[2][1]) - a[0][1] * (a[1][0] * a[2][2] - a[1][2] * a[2][0]) +
         a[0][2] * (a[1][0] * a[2][1] - a[1][1] * a[2][0]);
}

template <int N>
Matrix to_matrix(const Sym<double, N>& a) {
  const double r = 1.0 / std::sqrt(2.0), xy = r * a[3];
  double yz = 0, zx = 0;
  if constexpr (N == 6) {
    yz = r * a[4];
    zx = r * a[5];
  }
  return {{{a[0], xy, zx}, {xy, a[1], yz}, {zx, yz, a[2]}}};
}

template <int N>
Sym<double, N> from_matrix(const Matrix& m) {
  const double r = std::sqrt(2.0);
  if constexpr (N == 4) return {{m[0][0], m[1][1], m[2][2], r * m[0][1]}};
  if constexpr (N == 6) return {{m[0][0], m[1][1], m[2][2], r * m[0][1], r * m[1][2], r * m[2][0]}};
}

template <int N>
Sym<double, N> random_tensor(std::mt19937& generator, double size = 1.0) {
  std::uniform_real_distribution<double> uniform(-size, size);
  Sym<double, N> a;
  for (int i = 0; i < N; ++i) a[i] = uniform(generator);
  return a;
}

}  // namespace scarp::test
