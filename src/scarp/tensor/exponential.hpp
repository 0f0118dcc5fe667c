// Products and the exponential of symmetric tensors, in Mandel components.
#pragma once

#include "scarp/tensor/sym.hpp"

namespace scarp {

/// ½ (a b + b a): the product a b itself where the two commute, symmetric where they do not.
template <class T>
inline Sym<T, 4> symmetric_product(const Sym<T, 4>& a, const Sym<T, 4>& b) {
  const T xy = T(0.5) * a[3] * b[3];
  return {{a[0] * b[0] + xy, a[1] * b[1] + xy, a[2] * b[2], T(0.5) * ((a[0] + a[1]) * b[3] + (b[0] + b[1]) * a[3])}};
}
template <class T>
inline Sym<T, 6> symmetric_product(const Sym<T, 6>& a, const Sym<T, 6>& b) {
  const T r(1.0 / sqrt2);
  const T xy = T(0.5) * a[3] * b[3], yz = T(0.5) * a[4] * b[4], zx = T(0.5) * a[5] * b[5];
  return {{a[0] * b[0] + xy + zx, a[1] * b[1] + xy + yz, a[2] * b[2] + yz + zx,
           T(0.5) * ((a[0] + a[1]) * b[3] + (b[0] + b[1]) * a[3] + r * (a[4] * b[5] + a[5] * b[4])),
           T(0.5) * ((a[1] + a[2]) * b[4] + (b[1] + b[2]) * a[4] + r * (a[3] * b[5] + a[5] * b[3])),
           T(0.5) * ((a[2] + a[0]) * b[5] + (b[2] + b[0]) * a[5] + r * (a[3] * b[4] + a[4] * b[3]))}};
}

/// a b a = 2 a∘(a∘b) − (a∘a)∘b with the symmetric product ∘.
template <class T, int N>
inline Sym<T, N> triple_product(const Sym<T, N>& a, const Sym<T, N>& b) {
  return T(2.0) * symmetric_product(a, symmetric_product(a, b)) - symmetric_product(symmetric_product(a, a), b);
}

/// exp(a): Taylor's series to the eighth power at a/4, squared twice. No eigenvalues, so that one text serves doubles
/// and SIMD lanes, and coinciding eigenvalues are nothing special. Exact to rounding for ‖a‖ ≤ 0.1.
template <class T, int N>
inline Sym<T, N> exponential(const Sym<T, N>& a) {
  const Sym<T, N> x = T(0.25) * a, one = isotropic<T, N>(T(1.0));
  Sym<T, N> e = one + T(1.0 / 8) * x;
  for (int k = 7; k >= 1; --k) e = one + T(1.0 / k) * symmetric_product(x, e);
  e = symmetric_product(e, e);
  return symmetric_product(e, e);
}

/// Bound of the relative error of exponential(a) for ‖a‖ ≤ 4: the rest of the series, x⁹/9! e^x at x = ‖a/4‖, relative
/// to the smallest eigenvalue e^−x, and four times by the squarings. Larger a give a number that is no bound, but
/// large.
template <class T, int N>
inline T exponential_error(const Sym<T, N>& a) {
  const T x2 = T(1.0 / 16) * dot(a, a), x4 = x2 * x2;
  return T(4.0 * 7.4 / 362880.0) * x4 * x4 * sqrt(x2);
}

}  // namespace scarp
