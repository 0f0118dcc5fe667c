// Principal values and directions of symmetric tensors, without branches: the same text runs on double and in SIMD
// batches, and repeated values are ordinary.
#pragma once

#include <array>
#include <utility>

#include "scarp/tensor/sym.hpp"

namespace scarp {

/// a = Σ value[i] projection[i], value[0] ≥ value[1] ≥ value[2]. A projection is n ⊗ n of a unit direction n. Where
/// values repeat, the directions are some orthogonal ones of their plane (or space).
template <class T, int N>
struct Spectral {
  std::array<T, 3> value;
  std::array<Sym<T, N>, 3> projection;
};

/// Σ value[i] projection[i]
template <class T, int N>
inline Sym<T, N> composed(const std::array<T, 3>& value, const std::array<Sym<T, N>, 3>& projection) {
  return value[0] * projection[0] + value[1] * projection[1] + value[2] * projection[2];
}

namespace detail {

/// Puts the larger of two values, with its projection, in place i < j.
template <class T, int N>
inline void order(Spectral<T, N>& s, std::size_t i, std::size_t j) {
  const Mask<T> wrong = s.value[i] < s.value[j];
  const T high = select(wrong, s.value[j], s.value[i]);
  s.value[j] = select(wrong, s.value[i], s.value[j]);
  s.value[i] = high;
  for (int c = 0; c < N; ++c) {
    const T first = select(wrong, s.projection[j][c], s.projection[i][c]);
    s.projection[j][c] = select(wrong, s.projection[i][c], s.projection[j][c]);
    s.projection[i][c] = first;
  }
}

template <class T, int N>
inline void order(Spectral<T, N>& s) {
  order(s, 0, 1);
  order(s, 1, 2);
  order(s, 0, 1);
}

/// One Jacobi rotation in the plane of axes p and q (Golub & Van Loan, Matrix Computations, 8.5): m[p][q] becomes 0,
/// and the columns of v turn along.
template <class T>
inline void jacobi(T (&m)[3][3], T (&v)[3][3], int p, int q) {
  const int r = 3 - p - q;
  const T off = T(2.0) * m[p][q], gap = m[q][q] - m[p][p];
  const T root = abs(gap) + sqrt(gap * gap + off * off);
  // The smaller angle: |t| ≤ 1. A diagonal pair, equal or not, does not turn; 1e-300 makes 0/0 a 0.
  const T t = select(gap < T(0.0), -off, off) / (root + T(1e-300));
  const T c = T(1.0) / sqrt(T(1.0) + t * t), s = t * c;
  m[p][p] = m[p][p] - t * m[p][q];
  m[q][q] = m[q][q] + t * m[p][q];
  m[p][q] = m[q][p] = T(0.0);
  const T rp = m[r][p], rq = m[r][q];
  m[r][p] = m[p][r] = c * rp - s * rq;
  m[r][q] = m[q][r] = s * rp + c * rq;
  for (int i = 0; i < 3; ++i) {
    const T vp = v[i][p], vq = v[i][q];
    v[i][p] = c * vp - s * vq;
    v[i][q] = s * vp + c * vq;
  }
}

}  // namespace detail

/// In the plane: Mohr's circle.
template <class T>
inline Spectral<T, 4> spectral(const Sym<T, 4>& a) {
  const T centre = T(0.5) * (a[0] + a[1]), half = T(0.5) * (a[0] - a[1]), shear = T(1.0 / sqrt2) * a[3];
  const T radius = sqrt(half * half + shear * shear);
  const Mask<T> round = radius < T(1e-150);  // no direction in the plane is preferred: x and y
  const T inverse = T(1.0) / select(round, T(1.0), radius);
  const T cos2 = select(round, T(1.0), half * inverse), sin2 = select(round, T(0.0), shear * inverse);
  const T zero(0.0), one(1.0), c = T(0.5) * cos2, s = T(1.0 / sqrt2) * sin2;
  Spectral<T, 4> r{{centre + radius, centre - radius, a[2]},
                   {Sym<T, 4>{{T(0.5) + c, T(0.5) - c, zero, s}}, Sym<T, 4>{{T(0.5) - c, T(0.5) + c, zero, -s}},
                    Sym<T, 4>{{zero, zero, one, zero}}}};
  detail::order(r);
  return r;
}

/// In space: cyclic Jacobi rotations. They converge quadratically from any tensor; after five sweeps what is left off
/// the diagonal is below rounding (the unit test has the evidence).
template <class T>
inline Spectral<T, 6> spectral(const Sym<T, 6>& a) {
  constexpr int sweeps = 5;
  const T k(1.0 / sqrt2), zero(0.0), one(1.0);
  T m[3][3] = {{a[0], k * a[3], k * a[5]}, {k * a[3], a[1], k * a[4]}, {k * a[5], k * a[4], a[2]}};
  T v[3][3] = {{one, zero, zero}, {zero, one, zero}, {zero, zero, one}};
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    detail::jacobi(m, v, 0, 1);
    detail::jacobi(m, v, 1, 2);
    detail::jacobi(m, v, 0, 2);
  }
  Spectral<T, 6> r;
  const T root2(sqrt2);
  for (int i = 0; i < 3; ++i) {
    const T x = v[0][i], y = v[1][i], z = v[2][i];
    r.value[static_cast<std::size_t>(i)] = m[i][i];
    r.projection[static_cast<std::size_t>(i)] = {{x * x, y * y, z * z, root2 * x * y, root2 * y * z, root2 * z * x}};
  }
  detail::order(r);
  return r;
}

}  // namespace scarp
