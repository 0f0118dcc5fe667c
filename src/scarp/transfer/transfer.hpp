// Points → nodes and nodes → points for the points of one element: the sums of the report's steps 1, 4, 5, 6 and 10,
// in its symbols, for every basis and dimension; a point in each lane. No loops over the mesh and no threads here.
// Tension positive.
#pragma once

#include <array>

#include "scarp/transfer/local.hpp"
#include "scarp/transfer/quadrature.hpp"
#include "scarp/transfer/strains.hpp"

namespace scarp::transfer {

/// What a local node receives in step 1, as numbers beside each other: m (eq. 1), p (eq. 2), F_int (eq. 4).
template <int Dim>
inline constexpr int node_sums = 1 + 2 * Dim;

/// Sums over an element's points in step 1.
template <class Basis>
struct ElementSums {
  static constexpr int dim = Basis::dim, nodes = Basis::nodes, stresses = dim * (dim + 1) / 2;
  using T = PointBatch<dim>;

  static constexpr std::size_t node_size = whole_batches<T>(nodes * node_sums<dim>);
  static constexpr int plane_integrals = 1 + nodes * dim + stresses;
  static constexpr std::size_t integral_size =
      whole_batches<T>(plane_integrals + (is_axisymmetric<Basis> ? 1 + nodes : 0));

  alignas(64) std::array<double, node_size> node{};
  alignas(
      64) std::array<double, integral_size> integral{};  ///< Σ Ω_p, Σ Ω_p B_i, Σ Ω_p σ_p (, Σ Ω_p σ_θθ, Σ Ω_p N_i / r)

  double volume() const { return integral[0]; }
  const double* gradient() const { return integral.data() + 1; }
  /// Σ Ω_p σ_jk
  double stress(int j, int k) const {
    const int c = mandel(j, k);
    return integral[1 + nodes * dim + (dim == 2 && c == 3 ? 2 : c)];
  }
  /// In a body of revolution: Σ Ω_p σ_θθ and Σ Ω_p N_i / r.
  double hoop_stress() const { return integral[plane_integrals]; }
  const double* hoop() const { return integral.data() + plane_integrals + 1; }
};

/// Step 1: m_i += Σ m_p N_i, p_i += Σ m_p v_p N_i, F_i^int += Σ B_iᵀ σ_p Ω_p (eqs 1, 2, 4), and to the radial component
/// Σ σ_θθ N_i / r Ω_p in a body of revolution. Gravity (eq. 3) is uniform, so F_i^grav = m_i g is formed at the node.
template <class Basis>
void points_to_nodes(const typename Basis::Cell& cell, const Points<Basis::dim>& points, PointRange range,
                     ElementSums<Basis>& sums) {
  constexpr int Dim = Basis::dim, K = Basis::nodes, Q = node_sums<Dim>;
  using T = PointBatch<Dim>;
  for_each_batch<T>(range, [&](const Lanes<T>& p, int) {
    std::array<T, K> N;
    std::array<std::array<T, Dim>, K> B;
    cell.gradients(local_coordinates<Basis>(cell, points, p), N, B);
    const T m = p.load(points.mass), Omega = p.load(points.volume);
    std::array<T, Dim> mv;
    std::array<std::array<T, Dim>, Dim> s;  // σ_p Ω_p
    for (int j = 0; j < Dim; ++j) {
      mv[j] = m * p.load(points.v[j]);
      for (int k = 0; k <= j; ++k) {
        s[j][k] = Omega * p.load(points.sigma[mandel(j, k)]);
        if (k != j) s[k][j] = s[j][k] = T(1 / sqrt2) * s[j][k];
      }
    }
    std::array<T, ElementSums<Basis>::node_size> node;
    std::array<T, ElementSums<Basis>::integral_size> integral;
    for (int i = 0; i < K; ++i) {
      node[i * Q] = m * N[i];
      for (int j = 0; j < Dim; ++j) {
        T F = B[i][0] * s[0][j];
        for (int k = 1; k < Dim; ++k) F = fma(B[i][k], s[k][j], F);
        node[i * Q + 1 + j] = mv[j] * N[i];
        node[i * Q + 1 + Dim + j] = F;
        integral[1 + i * Dim + j] = Omega * B[i][j];
      }
    }
    integral[0] = Omega;
    int c = 1 + K * Dim;
    for (int j = 0; j < Dim; ++j) integral[c++] = s[j][j];
    for (int l = 0; l < Dim * (Dim - 1) / 2; ++l) integral[c++] = s[(l + 1) % Dim][l];
    if constexpr (is_axisymmetric<Basis>) {
      // Lanes without a point lie at no distance from the axis, and take no part.
      const T r = p.load(points.x[0]), per_r = select(r > T(0.0), T(1.0) / r, T(0.0));
      integral[c++] = Omega * p.load(points.sigma[2]);
      for (int i = 0; i < K; ++i) {
        const T hoop = N[i] * per_r;
        node[i * Q + 1 + Dim] = fma(hoop, integral[ElementSums<Basis>::plane_integrals], node[i * Q + 1 + Dim]);
        integral[c++] = Omega * hoop;
      }
    }
    for (std::size_t i = K * Q; i < node.size(); ++i) node[i] = T(0.0);
    for (std::size_t i = c; i < integral.size(); ++i) integral[i] = T(0.0);
    add_lanes(node, sums.node.data());
    add_lanes(integral, sums.integral.data());
  });
}

/// F_i^int of an element whose points are used by a quadrature of w and s_i.
template <class Basis>
void correct(ElementSums<Basis>& sums, const Quadrature<Basis>& quadrature) {
  constexpr int Dim = Basis::dim, Q = node_sums<Dim>;
  for (int i = 0; i < Basis::nodes; ++i) {
    for (int j = 0; j < Dim; ++j) {
      double& F = sums.node[i * Q + 1 + Dim + j];
      for (int k = 0; k < Dim; ++k) F += quadrature.shift[i][k] * sums.stress(k, j);
      if constexpr (is_axisymmetric<Basis>) {
        if (j == 0) F += quadrature.hoop_shift[i] * sums.hoop_stress();
      }
      F *= quadrature.weight;
    }
  }
}

/// What steps 2 and 3 leave at the local nodes for their points.
template <class Basis>
struct NodeMotion {
  std::array<Vec<Basis::dim>, Basis::nodes> a;  ///< acceleration, eq. 5
  std::array<Vec<Basis::dim>, Basis::nodes> v;  ///< v^t + a dt with its conditions, for the PIC share
};

/// Sums over points of what moves, a lane for itself each.
template <int Dim>
struct MotionSums {
  using T = PointBatch<Dim>;
  T mass = T(0.0), kinetic_energy = T(0.0), taken = T(0.0), fastest2 = T(0.0);
  std::array<T, Dim> momentum;

  MotionSums() { momentum.fill(T(0.0)); }
};

/// Steps 4 and 5: v_p += Σ a_i N_i dt (eq. 6), blended with the share 1 − flip of the interpolated nodal velocity
/// (PIC), then p_i += Σ m_p v_p N_i (eq. 7) into momentum[i * Dim + j]. `taken` is the kinetic energy that the PIC
/// share takes from the points.
template <class Basis>
void update_velocities(const typename Basis::Cell& cell, const NodeMotion<Basis>& node, double dt, double flip,
                       Points<Basis::dim>& points, PointRange range, double* momentum, MotionSums<Basis::dim>& sums) {
  constexpr int Dim = Basis::dim, K = Basis::nodes;
  using T = PointBatch<Dim>;
  for_each_batch<T>(range, [&](const Lanes<T>& p, int) {
    std::array<T, K> N;
    cell.shape(local_coordinates<Basis>(cell, points, p), N);
    const T m = p.load(points.mass);
    std::array<T, whole_batches<T>(K * Dim)> part;
    T v2(0.0);
    for (int j = 0; j < Dim; ++j) {
      T a = N[0] * T(node.a[0][j]);
      for (int i = 1; i < K; ++i) a = fma(N[i], T(node.a[i][j]), a);
      T v = fma(a, T(dt), p.load(points.v[j]));
      if (flip != 1) {
        T v_pic = N[0] * T(node.v[0][j]);
        for (int i = 1; i < K; ++i) v_pic = fma(N[i], T(node.v[i][j]), v_pic);
        const T v_flip = v;
        v = fma(T(1 - flip), v_pic - v_flip, v_flip);
        sums.taken = fma(T(0.5) * m, v_flip * v_flip - v * v, sums.taken);
      }
      p.store(v, points.v[j]);
      v2 = fma(v, v, v2);
      const T mv = m * v;
      sums.momentum[j] += mv;
      for (int i = 0; i < K; ++i) part[i * Dim + j] = mv * N[i];
    }
    sums.mass += m;
    sums.kinetic_energy = fma(T(0.5) * m, v2, sums.kinetic_energy);
    sums.fastest2 = max(sums.fastest2, select(m > T(0.0), v2, T(0.0)));  // lanes without a point have any v
    for (std::size_t i = K * Dim; i < part.size(); ++i) part[i] = T(0.0);
    add_lanes(part, momentum);
  });
}

/// Strain increment of the circumference at distance r from the axis: Σ du_i,r (N_i / r + s_i).
template <class Basis, class T>
T hoop_strain(const std::array<T, Basis::nodes>& N, const Quadrature<Basis>& quadrature,
              const std::array<Vec<2>, Basis::nodes>& du_i, const T& r) {
  T du = N[0] * T(du_i[0][0]);
  double shifted = du_i[0][0] * quadrature.hoop_shift[0];
  for (int i = 1; i < Basis::nodes; ++i) {
    du = fma(N[i], T(du_i[i][0]), du);
    shifted += du_i[i][0] * quadrature.hoop_shift[i];
  }
  return du / r + T(shifted);
}

/// Steps 6, 8, 9 and 10 from du_i = v_i dt at the local nodes (eqs 8, 16): L dt = Σ du_i ⊗ ∇N_i (eq. 9), strain and
/// spin increments (eqs 10, 11) to `strains` from place `at` on, volume by det(I + L dt) (eq. 14 in its finite form;
/// the density of eq. 15 is m_p / Ω_p), and position (eqs 17–19; the displacement is x_p less x_p at the start). Then
/// moved(cell, lanes, x) for each batch.
template <class Basis, class F>
void nodes_to_points(const typename Basis::Cell& cell, const Quadrature<Basis>& quadrature,
                     const std::array<Vec<Basis::dim>, Basis::nodes>& du_i, double element_size,
                     Points<Basis::dim>& points, PointRange range, Strains<Basis::dim>& strains, int at, F&& moved) {
  constexpr int Dim = Basis::dim, K = Basis::nodes;
  using T = PointBatch<Dim>;
  Vec<Dim * Dim> shifted{};  // Σ du_i ⊗ s_i
  for (int i = 0; i < K; ++i) {
    for (int l = 0; l < Dim * Dim; ++l) shifted[l] += du_i[i][l / Dim] * quadrature.shift[i][l % Dim];
  }
  for_each_batch<T>(range, [&](const Lanes<T>& p, int first) {
    std::array<T, K> N;
    std::array<std::array<T, Dim>, K> B;
    cell.gradients(local_coordinates<Basis>(cell, points, p), N, B);
    std::array<T, Dim> x;
    std::array<std::array<T, Dim>, Dim> L;  // L dt
    T speed2(0.0), hoop(0.0);
    if constexpr (is_axisymmetric<Basis>) hoop = hoop_strain<Basis>(N, quadrature, du_i, p.load(points.x[0]));
    for (int j = 0; j < Dim; ++j) {
      T du = N[0] * T(du_i[0][j]);
      for (int i = 1; i < K; ++i) du = fma(N[i], T(du_i[i][j]), du);
      for (int k = 0; k < Dim; ++k) {
        L[j][k] = T(shifted[j * Dim + k]);
        for (int i = 0; i < K; ++i) L[j][k] = fma(B[i][k], T(du_i[i][j]), L[j][k]);
      }
      x[j] = p.load(points.x[j]) + du;
      p.store(x[j], points.x[j]);
      const T v = p.load(points.v[j]);
      speed2 = fma(v, v, speed2);
    }
    const T Omega_t = p.load(points.volume), Omega = Omega_t * determinant_of_stretch(L) * (T(1.0) + hoop);
    p.store(Omega, points.volume);
    const T m = p.load(points.mass);
    store_strains<Dim>(L, hoop, strains, at + first);
    T dilation = L[0][0];
    for (int j = 1; j < Dim; ++j) dilation += L[j][j];
    if constexpr (is_axisymmetric<Basis>) dilation += hoop;
    const double w = quadrature.weight;
    (T(w) * Omega * (T(1.0) - T(0.5) * dilation)).store_unaligned(strains.volume.data() + at + first);
    (T(w > 1 ? w : 1) * Omega / m).store_unaligned(strains.per_mass.data() + at + first);
    speed2.store_unaligned(strains.speed2.data() + at + first);
    T(element_size).store_unaligned(strains.size.data() + at + first);
    moved(cell, p, x);
  });
}

}  // namespace scarp::transfer
