// What step 6 hands to step 7, for the points of a chunk of elements in their order: small enough to stay in the cache.
#pragma once

#include <array>
#include <vector>

#include "scarp/mesh/basis.hpp"
#include "scarp/points/points.hpp"
#include "scarp/tensor/rotation.hpp"
#include "scarp/transfer/batches.hpp"

namespace scarp {

template <int Dim>
struct Strains {
  std::array<Column, sym_size<Dim>> deps;   ///< strain increment (eq. 10), Mandel components, tension positive
  std::array<Column, spin_size<Dim>> spin;  ///< spin increment (eq. 11): W_xy (, W_yz, W_zx)
  Column volume;                            ///< w Ω_p in the middle of the step: what the work of stress is taken over
  Column per_mass;  ///< max(1, w) Ω_p / (m_p h²): where a point stands for more, its stiffness does too; h is the least
                    ///< height of its element
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
  return (T(1.0) + L[0][0]) * (T(1.0) + L[1][1]) - L[0][1] * L[1][0];
}
template <class T>
inline T determinant_of_stretch(const std::array<std::array<T, 3>, 3>& L) {
  const T x = T(1.0) + L[0][0], y = T(1.0) + L[1][1], z = T(1.0) + L[2][2];
  return x * (y * z - L[1][2] * L[2][1]) - L[0][1] * (L[1][0] * z - L[1][2] * L[2][0]) +
         L[0][2] * (L[1][0] * L[2][1] - y * L[2][0]);
}

/// L̃ = L dt (I + ½ L dt)⁻¹: the gradient of the step's displacement where the body is in the middle of it. A rotation
/// by any angle is without strain there, and a stretch of 1 + e has the strain ln(1 + e) to third order.
template <std::size_t Dim, class T>
inline std::array<std::array<T, Dim>, Dim> of_middle(const std::array<std::array<T, Dim>, Dim>& L) {
  std::array<std::array<T, Dim>, Dim> A, I, M;
  repeat<Dim>([&](auto j) { repeat<Dim>([&](auto k) { A[j][k] = fma(T(0.5), L[j][k], T(j == k ? 1.0 : 0.0)); }); });
  scarp::detail::inverse(A, I);
  repeat<Dim>([&](auto j) {
    repeat<Dim>([&](auto k) {
      M[j][k] = L[j][0] * I[0][k];
      repeat<Dim - 1>([&](auto l) { M[j][k] = fma(L[j][l + 1], I[l + 1][k], M[j][k]); });
    });
  });
  return M;
}

/// Turns the strain increments at place `at`, those of the middle of the step, by half the spin there to its end, where
/// the stress is turned to.
template <int Dim, class T>
inline void turn_to_end(Strains<Dim>& strains, int at) {
  constexpr int N = sym_size<Dim>;
  Sym<T, N> deps;
  Spin<T, N> half;
  repeat<N>([&](auto c) { deps[c] = T::load_unaligned(strains.deps[c].data() + at); });
  repeat<spin_size<Dim>>([&](auto c) { half.w[c] = T(0.5) * T::load_unaligned(strains.spin[c].data() + at); });
  const auto turned = Rotation<T, N>(half)(deps);
  repeat<N>([&](auto c) { turned[c].store_unaligned(strains.deps[c].data() + at); });
}

/// Strain and spin increments (eqs 10, 11) of L dt to the places `at` on; in the plane `hoop` is that of the
/// circumference, zero in plane strain. Whole batches are written: what comes behind the last point of an element is
/// overwritten by the next.
template <int Dim, class T>
inline void store_strains(const std::array<std::array<T, Dim>, Dim>& L, const T& hoop, Strains<Dim>& strains, int at) {
  repeat<Dim>([&](auto j) { L[j][j].store_unaligned(strains.deps[j].data() + at); });
  if constexpr (Dim == 2) hoop.store_unaligned(strains.deps[2].data() + at);
  repeat<spin_size<Dim>>([&](auto j) {  // xy, yz, zx
    constexpr int k = (j + 1) % Dim;
    (T(0.5 * sqrt2) * (L[j][k] + L[k][j])).store_unaligned(strains.deps[3 + j].data() + at);
    (T(0.5) * (L[j][k] - L[k][j])).store_unaligned(strains.spin[j].data() + at);
  });
}

}  // namespace transfer
}  // namespace scarp
