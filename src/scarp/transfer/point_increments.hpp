// What step 6 hands to step 7, for the points of a chunk of elements in their order: small enough to stay in the cache.
#pragma once

#include <array>
#include <vector>

#include "scarp/mesh/basis.hpp"
#include "scarp/points/points.hpp"
#include "scarp/tensor/rotation.hpp"
#include "scarp/transfer/simd/batches.hpp"

namespace scarp {

template <int Dim>
struct PointIncrements {
  std::array<Column, sym_size<Dim>> deps;   ///< strain increment (eq. 10), Mandel components, tension positive
  std::array<Column, spin_size<Dim>> spin;  ///< spin increment (eq. 11): W_xy (, W_yz, W_zx)
  Column volume;                            ///< w Ω_p in the middle of the step: what the work of stress is taken over
  Column per_mass;  ///< max(1, w) Ω_p / (m_p h²): where a point stands for more, its stiffness does too; h is the least
                    ///< height of its element. In simplices not less than their nodes ask for (step/node_rates.hpp)
  Column speed2;  ///< |v_p|² / h²

  /// Room for so many points, and for a batch that starts at the last of them; twice that where it has to grow.
  void reserve(int points) {
    constexpr std::size_t widest = 8;
    if (volume.size() >= static_cast<std::size_t>(points) + widest) return;
    const std::size_t room = 2 * static_cast<std::size_t>(points) + widest;
    for (auto& column : deps) column.resize(room, 0.0);
    for (auto& column : spin) column.resize(room, 0.0);
    for (auto* column : {&volume, &per_mass, &speed2}) column->resize(room, 0.0);
  }
};

namespace transfer {

/// det(I + L dt)
template <class T>
inline T determinant_of_stretch(const std::array<std::array<T, 2>, 2>& L) {
  return fma(-L[0][1], L[1][0], (T(1.0) + L[0][0]) * (T(1.0) + L[1][1]));
}
template <class T>
inline T determinant_of_stretch(const std::array<std::array<T, 3>, 3>& L) {
  const T x = T(1.0) + L[0][0], y = T(1.0) + L[1][1], z = T(1.0) + L[2][2];
  return x * (y * z - L[1][2] * L[2][1]) - L[0][1] * (L[1][0] * z - L[1][2] * L[2][0]) +
         L[0][2] * (L[1][0] * L[2][1] - y * L[2][0]);
}

/// Strain and spin increments of a step (eqs 10, 11).
template <class T, int Dim>
struct StrainAndSpin {
  Sym<T, sym_size<Dim>> deps;
  Spin<T, sym_size<Dim>> spin;
};

/// Those of L dt; in the plane `hoop` is the strain of the circumference, zero in plane strain.
template <class T, std::size_t Dim>
inline StrainAndSpin<T, int{Dim}> strain_and_spin_of(const std::array<std::array<T, Dim>, Dim>& L, const T& hoop) {
  StrainAndSpin<T, int{Dim}> of;
  repeat<Dim>([&](auto j) { of.deps[j] = L[j][j]; });  // eq. 10
  if constexpr (Dim == 2) of.deps[2] = hoop;
  repeat<spin_size<Dim>>([&](auto j) {  // xy, yz, zx
    constexpr int k = (j + 1) % Dim;
    of.deps[3 + j] = T(0.5 * sqrt2) * (L[j][k] + L[k][j]);
    of.spin.w[j] = T(0.5) * (L[j][k] - L[k][j]);  // eq. 11
  });
  return of;
}

/// Those of L̃ = L dt (I + ½ L dt)⁻¹, the gradient of the step's displacement where the body is in the middle of it; the
/// strain rotated by half of the spin to the end of the step, where the stress is rotated to. A rotation by any angle
/// is without strain, and a stretch of 1 + e has the strain ln(1 + e) to third order.
template <class T>
inline StrainAndSpin<T, 3> strain_and_spin_of_middle(const std::array<std::array<T, 3>, 3>& L, const T& hoop) {
  std::array<std::array<T, 3>, 3> A, I, M;
  repeat<3>([&](auto j) { repeat<3>([&](auto k) { A[j][k] = fma(T(0.5), L[j][k], T(j == k ? 1.0 : 0.0)); }); });
  scarp::detail::inverse(A, I);
  repeat<3>([&](auto j) {
    repeat<3>([&](auto k) { M[j][k] = fma(L[j][2], I[2][k], fma(L[j][1], I[1][k], L[j][0] * I[0][k])); });
  });
  auto of = strain_and_spin_of(M, hoop);
  Spin<T, 6> half;
  repeat<3>([&](auto c) { half.w[c] = T(0.5) * of.spin.w[c]; });
  of.deps = Rotation<T, 6>(half)(of.deps);
  return of;
}

/// The same in the plane, with one division. By Cayley and Hamilton L̃ = (L dt + ½ det(L dt) I) / D with
/// D = det(I + ½ L dt) = 1 + ½ tr(L dt) + ¼ det(L dt); its spin is W / 2D with W = L_xy dt − L_yx dt. Half of that
/// turns by the φ of tan(φ/2) = −W / 8D (tensor/rotation.hpp), and the deviator by 2φ.
template <class T>
inline StrainAndSpin<T, 2> strain_and_spin_of_middle(const std::array<std::array<T, 2>, 2>& L, const T& hoop) {
  const T half_det = T(0.5) * fma(-L[0][1], L[1][0], L[0][0] * L[1][1]), half_trace = T(0.5) * (L[0][0] + L[1][1]);
  const T D = T(1.0) + half_trace + T(0.5) * half_det, W = L[0][1] - L[1][0];
  const T D8 = T(8.0) * D, q = fma(D8, D8, W * W), per_Dq = T(1.0) / (D * q), per_D = q * per_Dq, per_q = D * per_Dq;
  const T c = (D8 * D8 - W * W) * per_q, s = T(-2.0) * D8 * W * per_q;  // cos φ and sin φ
  const T c2 = c * c - s * s, s2 = T(2.0) * c * s;
  const T mean = (half_trace + half_det) * per_D, normal = T(0.5) * (L[0][0] - L[1][1]) * per_D,
          shear = T(0.5) * (L[0][1] + L[1][0]) * per_D;
  const T rotated = c2 * normal - s2 * shear;
  return {{{mean + rotated, mean - rotated, hoop, T(sqrt2) * (s2 * normal + c2 * shear)}}, {{T(0.5) * W * per_D}}};
}

/// These to the places `at` on of `increments`. Whole batches are written: what comes behind the last point of an
/// element is overwritten by the next.
template <class T, int Dim>
inline void store_increments(const StrainAndSpin<T, Dim>& of, PointIncrements<Dim>& increments, int at) {
  repeat<sym_size<Dim>>([&](auto c) { of.deps[c].store_unaligned(increments.deps[c].data() + at); });
  repeat<spin_size<Dim>>([&](auto c) { of.spin.w[c].store_unaligned(increments.spin[c].data() + at); });
}

}  // namespace transfer
}  // namespace scarp
