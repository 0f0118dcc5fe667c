// Shape of a critical state surface in the deviatoric plane after Willam & Warnke (1975).
#pragma once

#include "scarp/tensor/sym.hpp"

namespace scarp {

/// cos(π/3 − θ) from cos 3θ, 0 ≤ θ ≤ π/3, without acos: with φ = π − 3θ it is cos(φ/3), and as a function of
/// w = cos(φ/2) = √((1 − cos 3θ)/2) it is smooth on all of 0 ≤ w ≤ 1. Polynomial of degree 18 in 2w − 1, error
/// 1.4e-16 (tools/third_angle_coefficients.py).
template <class T>
inline T cos_third_angle(const T& cos3) {
  constexpr double c[] = {
      0.766044443118978,       0.24740906632285342,    -0.015509188436486424,   0.0024663528150652356,
      -0.0005041246911250438,  0.00011642545332376988, -2.8919936440265828e-05, 7.541075528639302e-06,
      -2.0358689700992568e-06, 5.641644492145283e-07,  -1.5954537531426307e-07, 4.5826101529351644e-08,
      -1.334519367092948e-08,  3.982274037822892e-09,  -1.1880162409356414e-09, 3.092253983971399e-10,
      -9.128174258928075e-11,  5.1178745156550326e-11, -1.6089233320740645e-11};
  const T t = T(2.0) * sqrt(max(T(0.0), T(0.5) - T(0.5) * cos3)) - T(1.0);
  // Even and odd powers apart: two shorter chains of multiplications for the processor to overlap.
  const T t2 = t * t;
  T even(c[18]), odd(c[17]);
  for (int i = 16; i >= 0; i -= 2) even = even * t2 + T(c[i]);
  for (int i = 15; i >= 1; i -= 2) odd = odd * t2 + T(c[i]);
  return even + t * odd;
}

/// h(θ): 1 in triaxial compression (cos 3θ = 1), k in extension (cos 3θ = −1), convex for 0.5 < k ≤ 1.
template <class T>
inline T willam_warnke(const T& cos3, double k) {
  const T x = cos_third_angle(cos3);
  const double k2 = k * k;
  const T quad = T(4.0 * (1.0 - k2)) * x * x;
  const T root = sqrt(max(T(0.0), quad + T(5.0 * k2 - 4.0 * k)));
  return (T(2.0 * (1.0 - k2)) * x + T(2.0 * k - 1.0) * root) / (quad + T((1.0 - 2.0 * k) * (1.0 - 2.0 * k)));
}

}  // namespace scarp
