// The return to the surface of Mohr and Coulomb with a tension cut-off, in principal stresses, for σ1 ≥ σ2 ≥ σ3,
// compression positive:
//   f = (1 − sin φ) σ1 − (1 + sin φ) σ3 − 2c cos φ,  flow along r = (1 − sin ψ, 0, −(1 + sin ψ))
//   σ3 = −t,                                         flow along (0, 0, −1)
// Isotropic elasticity keeps the principal directions of the trial stress, so that its return is a linear problem with
// one of nine active sets (Koiter 1953): the plane A; its edges C (σ2 = σ3, triaxial compression) and E (σ1 = σ2,
// extension); the plane T of tension and its edge U (σ2 = σ3 = −t); the line L where A and T meet; and the corners
// where L meets C and E, and σ1 = σ2 = σ3 = −t. The regions of trial stress that return to two neighbours are parted by
// planes through what they share (cf. Clausen, Damkilde & Andersen 2006): a stress that its own set would carry beyond
// its end belongs to the neighbour there. docs/models/mohr-coulomb.md has the derivation.
#pragma once

#include <array>

#include "scarp/material/elastoplastic.hpp"
#include "scarp/tensor/spectral.hpp"

namespace scarp::elastoplastic {

template <class T>
struct PrincipalStrength {
  T sin_phi, sin_psi;
  T cohesion;  ///< 2c cos φ [stress]
  T tension;   ///< t ≤ c cot φ [stress]; not looked at without a cut-off
};

/// Trial stress less returned stress.
template <class T>
struct PrincipalReturn {
  std::array<T, 3> fall;
  Mask<T> plastic;
  Mask<T> apex;  ///< returned to σ1 = σ2 = σ3 = −t
};

namespace detail {

template <class T>
std::array<T, 3> select3(const Mask<T>& m, const std::array<T, 3>& yes, const std::array<T, 3>& no) {
  return {select(m, yes[0], no[0]), select(m, yes[1], no[1]), select(m, yes[2], no[2])};
}

/// What an amount 1 of flow along r takes from the stress: D r = (alpha, beta, gamma).
template <class T>
struct Flow {
  T alpha, beta, gamma;
  Flow(const T& sin_psi, const Elasticity& e)
      : alpha(T(-2.0 * e.lame()) * sin_psi + T(2.0 * e.G) * (T(1.0) - sin_psi)),
        beta(T(-2.0 * e.lame()) * sin_psi),
        gamma(T(-2.0 * e.lame()) * sin_psi - T(2.0 * e.G) * (T(1.0) + sin_psi)) {}
};

/// A, or its edge where the plane alone would put σ2 beyond σ1 or σ3.
template <class T>
std::array<T, 3> to_shear(const std::array<T, 3>& s, const PrincipalStrength<T>& y, const Flow<T>& d) {
  const T half(0.5), a = T(1.0) - y.sin_phi, b = T(1.0) + y.sin_phi;
  const T f13 = a * s[0] - b * s[2] - y.cohesion;
  const T f12 = a * s[0] - b * s[1] - y.cohesion, f23 = a * s[1] - b * s[2] - y.cohesion;
  const T h = a * d.alpha - b * d.gamma;
  const T on_A = f13 / h;
  const T on_C = (f13 + f12) / (h + a * d.alpha - b * d.beta);  // sum of the two amounts
  const T on_E = (f13 + f23) / (h + a * d.beta - b * d.gamma);
  const std::array<T, 3> A{on_A * d.alpha, on_A * d.beta, on_A * d.gamma};
  const T mean_C = half * (d.beta + d.gamma) * on_C, apart_C = half * (s[1] - s[2]);
  const T mean_E = half * (d.alpha + d.beta) * on_E, apart_E = half * (s[0] - s[1]);
  const std::array<T, 3> C{on_C * d.alpha, mean_C + apart_C, mean_C - apart_C};
  const std::array<T, 3> E{mean_E + apart_E, mean_E - apart_E, on_E * d.gamma};
  const T s2 = s[1] - A[1];
  const auto edge = select3<T>(s2 < s[2] - A[2], C, A);
  return select3<T>((s2 > s[0] - A[0]) && (s2 >= s[2] - A[2]), E, edge);
}

/// T, U, L or a corner, for a stress that A and its edges leave beyond the cut-off.
template <class T>
PrincipalReturn<T> to_tension(const std::array<T, 3>& s, const PrincipalStrength<T>& y, const Flow<T>& d,
                              const Elasticity& e) {
  const T l(e.lame()), m(e.lame() + 2.0 * e.G), end = -y.tension;
  const T a = T(1.0) - y.sin_phi, b = T(1.0) + y.sin_phi;
  const T corner = max(end, (y.cohesion + b * end) / a);  // σ1 on L
  const T on_T = (end - s[2]) / m;
  const T on_U = (end + end - s[1] - s[2]) / (l + m);  // sum of the two amounts
  const Mask<T> edge = s[1] + l * on_T < end;
  std::array<T, 3> r{select(edge, -l * on_U, -l * on_T), select(edge, s[1] - end, -l * on_T), s[2] - end};
  const T s1 = s[0] - r[0];
  const Mask<T> apex = s1 < end;
  r[0] = select(apex, s[0] - end, r[0]);
  // L: amounts of both flows from σ1 = corner and σ3 = end.
  const T d1 = s[0] - corner, d3 = s[2] - end;
  const T inverse = T(1.0) / (d.alpha * m - d.gamma * l);
  const T shear = (m * d1 - l * d3) * inverse, tension = (d.gamma * d1 - d.alpha * d3) * inverse;
  const T s2 = s[1] - shear * d.beta + l * tension;
  const Mask<T> sheared = s1 > corner;
  r[0] = select(sheared, d1, r[0]);
  r[1] = select(sheared, s[1] - max(end, min(corner, s2)), r[1]);
  return {r, apex, apex || (sheared && (corner <= end))};  // without cohesion L is the apex, too
}

}  // namespace detail

template <bool Cutoff, class T>
PrincipalReturn<T> mohr_coulomb_return(const std::array<T, 3>& s, const PrincipalStrength<T>& y, const Elasticity& e) {
  const T f = (T(1.0) - y.sin_phi) * s[0] - (T(1.0) + y.sin_phi) * s[2] - y.cohesion;
  const T rounding = T(on_surface) * (abs(s[0]) + abs(s[2]) + y.cohesion);
  const Mask<T> sheared = f > rounding;
  const detail::Flow<T> flow(y.sin_psi, e);
  const T zero(0.0);
  PrincipalReturn<T> r{detail::select3<T>(sheared, detail::to_shear(s, y, flow), {zero, zero, zero}), sheared,
                       zero != zero};
  if constexpr (Cutoff) {
    const Mask<T> torn = s[2] - r.fall[2] < -y.tension - rounding;
    if (any(torn)) {
      const auto t = detail::to_tension(s, y, flow, e);
      r.fall = detail::select3<T>(torn, t.fall, r.fall);
      r.plastic = r.plastic || torn;
      r.apex = torn && t.apex;
    }
  }
  return r;
}

/// Isotropic opening in the elastic strain e1 ≥ e2 ≥ e3 that goes with a stress, at an apex at zero: the g for which
/// e + (g/3) I lies on the boundary of the cone of the flow around the apex.
///  - Without cohesion the shear planes meet there, and tr e = −sin ψ Σ|e_i| for all sums of their flows. On the
///    boundary e1 ≥ 0 ≥ e3, and Σ|e_i| is the larger of e1 ± e2 − e3.
///  - With cohesion the planes of the cut-off do, e_i ≤ 0: what opens is what all directions do.
template <class T>
T apex_opening(const std::array<T, 3>& s, const PrincipalStrength<T>& y, const Elasticity& e) {
  const T shear(0.5 / e.G), volume = T(1.0 / (9.0 * e.K) - 1.0 / (6.0 * e.G)) * (s[0] + s[1] + s[2]);
  const T e1 = shear * s[0] + volume, e2 = shear * s[1] + volume, e3 = shear * s[2] + volume;
  const T third = T(1.0 / 3.0) * y.sin_psi, grown = -(e1 + e2 + e3);
  const T up = (grown - y.sin_psi * (e1 + e2 - e3)) / (T(1.0) + third);
  const T down = (grown - y.sin_psi * (e1 - e2 - e3)) / (T(1.0) - third);
  return select(y.cohesion > T(0.0), T(-3.0) * e1, min(up, down));
}

/// The larger of both excesses; df/dσ = Σ (df/dσ_i) n_i ⊗ n_i.
template <bool Cutoff, class T, int N>
Excess<T> principal_excess(const Spectral<T, N>& at, const PrincipalStrength<T>& y, const Sym<T, N>& way) {
  const T a = T(1.0) - y.sin_phi, b = T(1.0) + y.sin_phi;
  const T way3 = dot(at.projection[2], way);
  const Excess<T> shear{a * at.value[0] - b * at.value[2] - y.cohesion, a * dot(at.projection[0], way) - b * way3};
  if constexpr (!Cutoff) return shear;
  const T torn = -y.tension - at.value[2];
  const Mask<T> more = torn > shear.f;
  return {select(more, torn, shear.f), select(more, -way3, shear.df)};
}

/// The correction that goes with a return in principal stresses.
template <class T>
Correction<std::array<T, 3>, T> principal_correction(const PrincipalReturn<T>& r, const Elasticity& e) {
  const T m = T(1.0 / 3.0) * (r.fall[0] + r.fall[1] + r.fall[2]);
  const T x = r.fall[0] - m, y = r.fall[1] - m, z = r.fall[2] - m;
  const T dkappa = T(sqrt_2_3 * 0.5 / e.G) * sqrt(x * x + y * y + z * z);
  return {r.fall, select(r.plastic, dkappa, T(0.0)), r.plastic, r.apex};
}

}  // namespace scarp::elastoplastic
