// Points → nodes for the points of one element: the sums of the report's steps 1 and 2 in its symbols, a local node in
// each lane, for every basis and dimension. No loops over the mesh and no threads here. Tension positive.
#pragma once

#include <array>

#include "scarp/transfer/at_nodes.hpp"
#include "scarp/transfer/quadrature.hpp"

namespace scarp::transfer {

/// What a node receives in step 1, as numbers beside each other: m (eq. 1), p (eq. 2), F_int (eq. 4); in space one more
/// that is not used.
template <int Dim>
inline constexpr int node_sums = Dim == 2 ? 5 : 8;

/// Do the elements keep M_ij = Σ m_p N_i N_j? With few nodes that is less work than to go through the points again.
inline constexpr int most_nodes_with_mass_matrix = 8;
template <class Basis>
inline constexpr bool keeps_mass_matrix = Basis::nodes <= most_nodes_with_mass_matrix;

/// Sums over an element's points in step 1.
template <class Basis>
struct ElementSums {
  static constexpr int dim = Basis::dim, nodes = Basis::nodes;
  static constexpr int rows = keeps_mass_matrix<Basis> ? nodes : 0;
  using T = Lane<Basis>;

  Nodal<Basis> m;                   ///< Σ m_p N_i
  std::array<Nodal<Basis>, dim> p;  ///< Σ m_p v_p N_i
  std::array<Nodal<Basis>, dim> F_normal,
      F_shear;                       ///< Σ B_iᵀ σ_p Ω_p by normal and by shear stress, the latter times √2
  std::array<Nodal<Basis>, dim> B;   ///< Σ Ω_p B_i
  Hoop<Basis> hoop;                  ///< Σ Ω_p N_i / r
  std::array<Nodal<Basis>, rows> M;  ///< rows of Σ m_p N_i N_j
  double Omega = 0;                  ///< Σ Ω_p
  std::array<double, sym_size<dim>> Omega_sigma{};  ///< Σ Ω_p σ_p, Mandel components

  ElementSums() {
    repeat<nodal_batches<Basis>>([&](auto b) {
      m[b] = T(0.0);
      repeat<dim>([&](auto j) { p[j][b] = F_normal[j][b] = F_shear[j][b] = B[j][b] = T(0.0); });
      repeat<rows>([&](auto i) { M[i][b] = T(0.0); });
      for (auto& of_nodes : hoop) of_nodes[b] = T(0.0);
    });
  }
};

/// Step 1: m_i += Σ m_p N_i, p_i += Σ m_p v_p N_i, F_i^int += Σ B_iᵀ σ_p Ω_p (eqs 1, 2, 4), and to the radial component
/// Σ σ_θθ N_i / r Ω_p in a body of revolution. Gravity (eq. 3) is uniform, so F_i^grav = m_i g is formed at the node.
template <class Basis>
inline void points_to_nodes(const ShapesAtPoints<Basis>& shapes, const Points<Basis::dim>& points,
                            const PointRange& range, ElementSums<Basis>& sums) {
  constexpr int Dim = Basis::dim, K = Basis::nodes, batches = nodal_batches<Basis>;
  using T = Lane<Basis>;
  shapes.for_each(points, range, [&](int i, const Shapes<Basis>& at) {
    const double Omega = points.volume[i];
    const T m(points.mass[i]);
    alignas(64) double N[nodal_size<Basis>];
    if constexpr (keeps_mass_matrix<Basis>) store_nodal<Basis>(at.N, N);
    repeat<batches>([&](auto b) {
      const T mN = m * at.N[b];
      sums.m[b] += mN;
      repeat<Dim>([&](auto j) {
        sums.p[j][b] = fma(mN, T(points.v[j][i]), sums.p[j][b]);
        const T B = T(Omega) * at.B[j][b];
        sums.B[j][b] += B;
        repeat<Dim>([&](auto k) {
          T& F = (j == k ? sums.F_normal : sums.F_shear)[k][b];
          F = fma(B, T(points.sigma[mandel(j, k)][i]), F);
        });
      });
      if constexpr (is_axisymmetric<Basis>) {
        const T hoop = T(Omega / points.x[0][i]) * at.N[b];
        sums.hoop[0][b] += hoop;
        sums.F_normal[0][b] = fma(hoop, T(points.sigma[2][i]), sums.F_normal[0][b]);
      }
      repeat<keeps_mass_matrix<Basis> ? K : 0>([&](auto j) { sums.M[j][b] = fma(mN, T(N[j]), sums.M[j][b]); });
    });
    sums.Omega += Omega;
    repeat<sym_size<Dim>>([&](auto c) {
      if (Dim == 3 || c != 2 || is_axisymmetric<Basis>)
        sums.Omega_sigma[c] += Omega * points.sigma[c][i];  // σ_zz does no work in plane strain
    });
  });
}

/// F_i^int of an element whose points are used by a quadrature of w and s_i.
template <class Basis>
inline std::array<Nodal<Basis>, Basis::dim> internal_force(const ElementSums<Basis>& sums,
                                                           const Quadrature<Basis>& quadrature) {
  constexpr int Dim = Basis::dim;
  using T = Lane<Basis>;
  std::array<Nodal<Basis>, Dim> F;
  repeat<nodal_batches<Basis>>([&](auto b) {
    repeat<Dim>([&](auto j) {
      T sum = fma(T(1 / sqrt2), sums.F_shear[j][b], sums.F_normal[j][b]);
      repeat<Dim>([&](auto k) {
        const double sigma = (j == k ? 1 : 1 / sqrt2) * sums.Omega_sigma[mandel(j, k)];
        sum = fma(quadrature.shift[k][b], T(sigma), sum);
      });
      if constexpr (is_axisymmetric<Basis> && j == 0) {
        sum = fma(quadrature.hoop_shift[0][b], T(sums.Omega_sigma[2]), sum);
      }
      F[j][b] = sum * T(quadrature.weight);
    });
  });
  return F;
}

/// Adds m, p and F_int of an element to those of its nodes: step 2.
template <class Basis>
inline void add_to_nodes(const ElementSums<Basis>& sums, const std::array<Nodal<Basis>, Basis::dim>& F,
                         const int* place, double* nodes) {
  constexpr int Dim = Basis::dim, W = lanes_of<Lane<Basis>>;
  repeat<nodal_batches<Basis>>([&](auto b) {
    std::array<Lane<Basis>, node_sums<Dim>> values;
    values[0] = sums.m[b];
    repeat<Dim>([&](auto j) {
      values[1 + j] = sums.p[j][b];
      values[1 + Dim + j] = F[j][b];
    });
    if constexpr (Dim == 3) values[7] = Lane<Basis>(0.0);
    add_to_places<std::min(W, Basis::nodes - b * W)>(values, place + b * W, nodes);
  });
}

}  // namespace scarp::transfer
