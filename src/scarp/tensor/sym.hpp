// Symmetric second-order tensors in Mandel components: xx, yy, zz, √2 xy (N = 4: plane strain, axisymmetry) and
// √2 yz, √2 zx (N = 6: three dimensions). The full contraction and the Frobenius norm are then plain dot
// products. T is double or a SIMD batch.
#pragma once

#include <array>

#include "scarp/tensor/scalar.hpp"

namespace scarp {

inline constexpr double sqrt2 = 1.4142135623730950488;
inline constexpr double sqrt3 = 1.7320508075688772935;
inline constexpr double sqrt_2_3 = 0.81649658092772603273;  ///< √(2/3)
inline constexpr double sqrt_3_2 = 1.2247448713915890491;   ///< √(3/2)

/// Number of Mandel components of a symmetric tensor in a Dim-dimensional analysis.
template <int Dim>
inline constexpr int sym_size = Dim == 2 ? 4 : 6;

template <class T, int N>
struct Sym {
  static_assert(N == 4 || N == 6);
  std::array<T, N> c;  ///< Mandel components

  static constexpr int size = N;
  T& operator[](int i) { return c[static_cast<std::size_t>(i)]; }
  const T& operator[](int i) const { return c[static_cast<std::size_t>(i)]; }

  static Sym zero() {
    Sym r;
    for (int i = 0; i < N; ++i) r[i] = T(0.0);
    return r;
  }
};

template <class T, int N>
inline Sym<T, N> operator+(const Sym<T, N>& a, const Sym<T, N>& b) {
  Sym<T, N> r;
  for (int i = 0; i < N; ++i) r[i] = a[i] + b[i];
  return r;
}

template <class T, int N>
inline Sym<T, N> operator-(const Sym<T, N>& a, const Sym<T, N>& b) {
  Sym<T, N> r;
  for (int i = 0; i < N; ++i) r[i] = a[i] - b[i];
  return r;
}

template <class T, int N>
inline Sym<T, N> operator*(const T& s, const Sym<T, N>& a) {
  Sym<T, N> r;
  for (int i = 0; i < N; ++i) r[i] = s * a[i];
  return r;
}

/// a : b
template <class T, int N>
inline T dot(const Sym<T, N>& a, const Sym<T, N>& b) {
  T r = a[0] * b[0];
  for (int i = 1; i < N; ++i) r = r + a[i] * b[i];
  return r;
}

template <class T, int N>
inline T trace(const Sym<T, N>& a) {
  return a[0] + a[1] + a[2];
}

/// tr a / 3; the mean effective stress p of an effective stress tensor.
template <class T, int N>
inline T mean(const Sym<T, N>& a) {
  return trace(a) * T(1.0 / 3.0);
}

template <class T, int N>
inline Sym<T, N> isotropic(const T& value) {
  Sym<T, N> r = Sym<T, N>::zero();
  r[0] = r[1] = r[2] = value;
  return r;
}

/// dev a = a − (tr a / 3) I
template <class T, int N>
inline Sym<T, N> deviator(const Sym<T, N>& a) {
  Sym<T, N> r = a;
  const T m = mean(a);
  for (int i = 0; i < 3; ++i) r[i] = a[i] - m;
  return r;
}

/// Frobenius norm.
template <class T, int N>
inline T norm(const Sym<T, N>& a) {
  return sqrt(dot(a, a));
}

/// q = √(3/2) ‖dev a‖
template <class T, int N>
inline T deviatoric_stress(const Sym<T, N>& a) {
  return T(sqrt_3_2) * norm(deviator(a));
}

/// Third invariant J3 = det s of a deviator s.
template <class T>
inline T det(const Sym<T, 4>& s) {
  return s[2] * (s[0] * s[1] - T(0.5) * s[3] * s[3]);
}
template <class T>
inline T det(const Sym<T, 6>& s) {
  return s[0] * s[1] * s[2] + T(1.0 / sqrt2) * s[3] * s[4] * s[5] -
         T(0.5) * (s[0] * s[4] * s[4] + s[1] * s[5] * s[5] + s[2] * s[3] * s[3]);
}

/// cos 3θ of a deviator with θ the Lode angle: +1 in triaxial compression and −1 in extension where compression
/// is positive. 1 where the deviator vanishes.
template <class T, int N>
inline T cos_3_lode(const Sym<T, N>& s) {
  const T j2 = T(0.5) * dot(s, s);
  const T scale = j2 * sqrt(j2);
  const Mask<T> vanishes = scale < T(1e-280);
  const T value = T(2.5980762113533159403) * det(s) / select(vanishes, T(1.0), scale);
  return select(vanishes, T(1.0), max(T(-1.0), min(T(1.0), value)));
}

/// The same of a deviator of norm 1, without a division; 0 of the zero tensor.
template <class T, int N>
inline T cos_3_lode_of_unit(const Sym<T, N>& direction) {
  return max(T(-1.0), min(T(1.0), T(7.3484692283495342946) * det(direction)));  // 3√6
}

/// Mandel components from plain tensor components xx, yy, zz, xy(, yz, zx), and back.
template <int N>
inline Sym<double, N> to_mandel(const std::array<double, N>& t) {
  Sym<double, N> r{t};
  for (int i = 3; i < N; ++i) r[i] *= sqrt2;
  return r;
}
template <int N>
inline std::array<double, N> from_mandel(const Sym<double, N>& a) {
  std::array<double, N> t = a.c;
  for (std::size_t i = 3; i < N; ++i) t[i] /= sqrt2;
  return t;
}

}  // namespace scarp
