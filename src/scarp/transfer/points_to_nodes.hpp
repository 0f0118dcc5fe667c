// Points → nodes for the points of one element: the sums of the report's steps 1 and 2 in its symbols, a local node in
// each lane, for every basis and dimension. No loops over the mesh and no threads here. Tension positive.
#pragma once

#include <array>

#include "scarp/transfer/mass_matrix.hpp"
#include "scarp/transfer/node_sums.hpp"
#include "scarp/transfer/quadrature.hpp"
#include "scarp/transfer/simd/shapes_at_points.hpp"

namespace scarp::transfer {

/// Sums over an element's points in step 1.
template <class Basis>
struct ElementSums {
  static constexpr int dim = Basis::dim, rows = mass_matrix_rows(Basis::nodes);
  using OfNodes = WideNodal<Basis>;
  using OfPoints = PointBatch<dim>;

  OfNodes m;                                       ///< Σ m_p N_i
  std::array<OfNodes, dim> p;                      ///< Σ m_p v_p N_i
  std::array<OfNodes, dim> F;                      ///< Σ B_iᵀ σ_p Ω_p
  CorrectionSums<Basis> correction;                ///< what s_i follows from
  std::array<OfNodes, Hoop<Basis>{}.size()> hoop;  ///< Σ Ω_p N_i / r
  MassMatrixSums<Basis> M;                         ///< Σ m_p N_i N_{i+k}
  OfPoints m_v2 = OfPoints(0.0);                   ///< Σ m_p |v_p|²
  OfPoints Omega = OfPoints(0.0);                  ///< Σ Ω_p
  OfPoints Omega_mean = OfPoints(0.0);             ///< Σ Ω_p s_p, of mean stresses that were left out of the others
  std::array<OfNodes, keeps_means<Basis> ? dim : 0> Omega_B;  ///< with these, Σ γ_p Ω_p B_i
  OfPoints Omega_share = OfPoints(0.0);                       ///< Σ γ_p Ω_p, of GIMP
  std::array<OfPoints, sym_size<dim>> Omega_sigma;            ///< Σ Ω_p σ_p

  ElementSums() {
    clear<Basis>(m);
    repeat<dim>([&](auto j) {
      clear<Basis>(p[j]);
      clear<Basis>(F[j]);
    });
    repeat<rows>([&](auto k) { clear<Basis>(M[k]); });
    if constexpr (is_axisymmetric<Basis>) clear<Basis>(hoop[0]);
    if constexpr (keeps_means<Basis>) repeat<dim>([&](auto j) { clear<Basis>(Omega_B[j]); });
    repeat<sym_size<dim>>([&](auto c) { Omega_sigma[c] = OfPoints(0.0); });
  }
};

/// Places x_i of an element's nodes, a node in each lane, for the parts of momentum that the points of an affine scheme
/// carry.
template <class Basis>
struct NodePlaces {
  std::array<WideNodal<Basis>, Basis::dim> x;

  NodePlaces(const Mesh<Basis::dim>& mesh, int e) {
    const auto n = mesh.element_nodes(e);
    repeat<Basis::dim>(
        [&](auto j) { x[j] = for_each_point<Basis>(nodal<Basis>([&](int i) { return mesh.node(n[i])[j]; })); });
  }
};
/// Of schemes whose points carry their velocity alone.
struct NoPlaces {};

/// The stress that the nodes feel: σ*, where the points have it.
template <int Dim>
inline const std::array<Column, sym_size<Dim>>& felt_stress(const Points<Dim>& points) {
  return points.sigma_ahead[0].empty() ? points.sigma : points.sigma_ahead;
}

/// Components of σ of some points. σ_zz does no work in plane strain; Mandel components of shear are √2 times the
/// stress.
template <class Basis, class Lanes>
inline auto felt_at(const std::array<Column, sym_size<Basis::dim>>& felt, const Lanes& p) {
  using T = PointBatch<Basis::dim>;
  return make_array<sym_size<Basis::dim>>([&](auto c) {
    constexpr bool used = Basis::dim == 3 || c != 2 || is_axisymmetric<Basis>;
    if constexpr (used) return T(c < 3 ? 1 : 1 / sqrt2) * p.load(felt[c]);
    return T(0.0);
  });
}

/// Takes the mean stress s_p = tr σ_p / d of some points, in part γ_p where they have domains, out of σ_p and sums it
/// up by itself; sets the volume that takes part in it.
template <class Basis, class Lanes, class T, std::size_t n>
inline void take_mean_apart(const ShapesAtPoints<Basis>& shapes, const Points<Basis::dim>& points, const Lanes& p,
                            const T& volume, std::array<T, n>& felt_here, T& volume_of_mean, ElementSums<Basis>& sums) {
  T mean = felt_here[0] + felt_here[1];
  if constexpr (mean_directions<Basis> == 3) mean += felt_here[2];
  mean *= T(1.0 / mean_directions<Basis>);
  if constexpr (keeps_means<Basis>) {
    const T share = share_of_mean<Basis>(local_coordinates<Basis>(shapes.cell(), points, p));
    mean *= share;
    volume_of_mean *= share;
    sums.Omega_share += volume_of_mean;
  }
  repeat<mean_directions<Basis>>([&](auto j) { felt_here[j] -= mean; });
  sums.Omega_mean = fma(volume, mean, sums.Omega_mean);
}

/// F_i,r += σ_θθ N_i / r Ω_p, of `Omega_sigma` = Ω_p σ_θθ, and Σ Ω_p N_i / r.
template <class Basis, class W>
inline void add_hoop(const Shapes<Basis>& here, const W& Omega, const W& r, const W& Omega_sigma,
                     ElementSums<Basis>& sums) {
  const W per_r = select(Omega > W(0.0), W(1.0) / r, W(0.0));  // lanes without a point have no r
  repeat<nodal_batches<Basis>>([&](auto b) {
    const W hoop = per_r * here.N[b];
    sums.hoop[0][b] = fma(Omega, hoop, sums.hoop[0][b]);
    sums.F[0][b] = fma(hoop, Omega_sigma, sums.F[0][b]);
  });
}

/// M_ij += m_p N_i N_j, in rows of j = i + k.
template <class Basis>
inline void add_mass_matrix(const Shapes<Basis>& here, const WideNodal<Basis>& mN, ElementSums<Basis>& sums) {
  repeat<ElementSums<Basis>::rows>([&](auto k) {
    const auto N = rotated<Basis::nodes, k>(here.N);
    repeat<nodal_batches<Basis>>([&](auto b) { sums.M[k][b] = fma(mN[b], N[b], sums.M[k][b]); });
  });
}

/// Step 1: m_i += Σ m_p N_i, p_i += Σ m_p v_p N_i, F_i^int += Σ B_iᵀ σ_p Ω_p (eqs 1, 2, 4), and to the radial component
/// Σ σ_θθ N_i / r Ω_p in a body of revolution. Gravity (eq. 3) is uniform, so F_i^grav = m_i g is formed at the node.
/// With `apart` mean stresses are left out and summed up by themselves.
/// NodePlaces instead of NoPlaces: the points bring v_p + C_p (x_i − x_p) in place of v_p.
template <class Basis, class Places, class Apart>
inline void points_to_nodes(const ShapesAtPoints<Basis>& shapes, const Places& places, const Points<Basis::dim>& points,
                            const PointRange& range, Apart apart, ElementSums<Basis>& sums) {
  constexpr int Dim = Basis::dim, components = sym_size<Dim>;
  constexpr bool affine = !std::is_same_v<Places, NoPlaces>;
  const auto& felt = felt_stress(points);
  using T = PointBatch<Dim>;
  using W = Wide<Basis>;
  for_each_batch_of_element<T>(range, [&](const auto& p, int) {
    const auto m_of = of_points<Basis>(p, points.mass), Omega_of = of_points<Basis>(p, points.volume);
    const auto v_of = make_array<Dim>([&](auto j) { return of_points<Basis>(p, points.v[j]); });
    const T volume = p.load(points.volume);
    T v2(0.0);
    repeat<Dim>([&](auto j) { v2 = fma(p.load(points.v[j]), p.load(points.v[j]), v2); });
    sums.m_v2 = fma(p.load(points.mass), v2, sums.m_v2);
    sums.Omega += volume;
    sums.correction.add_batch(shapes, points, p, volume);
    auto felt_here = felt_at<Basis>(felt, p);
    T volume_of_mean = volume;
    if (apart) take_mean_apart<Basis>(shapes, points, p, volume, felt_here, volume_of_mean, sums);
    const auto volume_of_mean_of = OfPoints<Basis>(volume_of_mean);
    const auto sigma_of = make_array<components>([&](auto c) {
      sums.Omega_sigma[c] = fma(volume, felt_here[c], sums.Omega_sigma[c]);
      return OfPoints<Basis>(volume * felt_here[c]);
    });
    shapes.with(points, p, [&](const auto& at) {
      for_each_group<Basis>(p, [&](int l) {
        const Shapes<Basis> here = at(l);
        const W m = m_of.of(l), Omega = Omega_of.of(l);
        const auto v = make_array<Dim>([&](auto j) { return v_of[j].of(l); });
        const auto sigma = make_array<components>([&](auto c) { return sigma_of[c].of(l); });  // Ω_p σ_p
        WideNodal<Basis> mN;
        repeat<nodal_batches<Basis>>([&](auto b) {
          mN[b] = m * here.N[b];
          sums.m[b] += mN[b];  // eq. 1
          repeat<Dim>([&](auto j) {
            if constexpr (affine) {
              W v_at = v[j];
              repeat<Dim>([&](auto k) {
                v_at = fma(of_points<Basis>(p, points.C[j * Dim + k]).of(l),
                           places.x[k][b] - of_points<Basis>(p, points.x[k]).of(l), v_at);
              });
              sums.p[j][b] = fma(mN[b], v_at, sums.p[j][b]);
            } else {
              sums.p[j][b] = fma(mN[b], v[j], sums.p[j][b]);  // eq. 2
            }
            repeat<Dim>([&](auto k) {
              sums.F[k][b] = fma(here.B[j][b], sigma[mandel(j, k)], sums.F[k][b]);  // eq. 4
            });
          });
        });
        sums.correction.add(Omega, here);
        if constexpr (keeps_means<Basis>) {
          if (apart) {
            const W Omega_share = volume_of_mean_of.of(l);
            repeat<Dim>([&](auto j) {
              repeat<nodal_batches<Basis>>(
                  [&](auto b) { sums.Omega_B[j][b] = fma(Omega_share, here.B[j][b], sums.Omega_B[j][b]); });
            });
          }
        }
        if constexpr (is_axisymmetric<Basis>)
          add_hoop(here, Omega, of_points<Basis>(p, points.x[0]).of(l), sigma[2], sums);
        add_mass_matrix(here, mN, sums);
      });
    });
  });
}

/// F_i^int of an element whose points are used by a quadrature of w and s_i; mean stresses that were summed up apart
/// act on the mean gradient of the element.
template <class Basis>
inline std::array<Nodal<Basis>, Basis::dim> internal_force(const ElementSums<Basis>& sums,
                                                           const Quadrature<Basis>& quadrature) {
  constexpr int Dim = Basis::dim;
  using T = Lane<Basis>;
  const auto Omega_sigma = make_array<sym_size<Dim>>([&](auto c) { return xsimd::hadd(sums.Omega_sigma[c]); });
  auto F = totals<Basis>(sums.F);
  quadrature.correction.add_force(Omega_sigma, F);
  if constexpr (has_correction<Basis> || keeps_means<Basis>) {
    if (quadrature.means) {
      const T mean(xsimd::hadd(sums.Omega_mean));
      repeat<nodal_batches<Basis>>([&](auto b) {
        repeat<Dim>([&](auto j) { F[j][b] = fma(quadrature.means->gradient[j][b], mean, F[j][b]); });
        if constexpr (is_axisymmetric<Basis>) F[0][b] = fma(quadrature.means->hoop[0][b], mean, F[0][b]);
      });
    }
  }
  repeat<nodal_batches<Basis>>([&](auto b) {
    if constexpr (is_axisymmetric<Basis>) F[0][b] = fma(quadrature.hoop_correction[0][b], T(Omega_sigma[2]), F[0][b]);
    repeat<Dim>([&](auto j) { F[j][b] *= T(quadrature.weight); });
  });
  return F;
}

/// Adds m, p and F_int of an element to those of its nodes: step 2.
template <class Basis>
inline void add_to_nodes(const ElementSums<Basis>& sums, const std::array<Nodal<Basis>, Basis::dim>& F,
                         const int* accumulator, double* nodes) {
  constexpr int Dim = Basis::dim, W = lanes_of<Lane<Basis>>;
  const auto m = total<Basis>(sums.m);
  const auto p = totals<Basis>(sums.p);
  repeat<nodal_batches<Basis>>([&](auto b) {
    using Sums = NodeSums<Dim>;
    std::array<Lane<Basis>, Sums::size> values;
    values[Sums::mass_at] = m[b];
    repeat<Dim>([&](auto j) {
      values[Sums::momentum_at + j] = p[j][b];
      values[Sums::internal_force_at + j] = F[j][b];
    });
    if constexpr (Dim == 3) values[7] = Lane<Basis>(0.0);
    add_to_accumulators<std::min(W, Basis::nodes - b * W)>(values, accumulator + b * W, nodes);
  });
}

}  // namespace scarp::transfer
