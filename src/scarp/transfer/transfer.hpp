// Nodes → points for the points of one element: the sums of the report's steps 4 to 6 and 8 to 10, in its symbols, for
// every basis and dimension; a point in each lane. No loops over the mesh and no threads here. Tension positive.
#pragma once

#include <array>
#include <bit>

#include "scarp/transfer/field.hpp"
#include "scarp/transfer/strains.hpp"
#include "scarp/transfer/sums.hpp"

namespace scarp::transfer {

/// What moves the points, of each node: c_i, by which their velocity changes (eq. 6; step.cpp), and du_i = v_i dt
/// (eq. 16), beside each other. Whole rows, so that they may be loaded as such.
template <int Dim>
struct alignas(8 * std::bit_ceil(unsigned{row_size<2 * Dim>})) Motion {
  std::array<double, row_size<2 * Dim>> row{};

  double& dv(int j) { return row[j]; }
  double& du(int j) { return row[Dim + j]; }
  double dv(int j) const { return row[j]; }
  double du(int j) const { return row[Dim + j]; }
};

/// Numbers side by side for n components of a node in the places of the assembly: 2, 4 or 8.
template <int n>
inline constexpr int place_size = static_cast<int>(std::bit_ceil(unsigned{n}));
/// The most that a step puts there: changes of velocity of two kinds.
template <int Dim>
inline constexpr int momentum_size = place_size<2 * Dim>;

/// Sums over points of what moves, a lane for itself each.
template <int Dim>
struct MotionSums {
  using T = PointBatch<Dim>;
  T mass = T(0.0), kinetic_energy = T(0.0), taken = T(0.0), fastest2 = T(0.0);
  std::array<T, Dim> momentum;

  MotionSums() { momentum.fill(T(0.0)); }
};

/// Adds n components p of an element's local nodes to the places of its nodes, `size` numbers each, from number `first`
/// on.
template <class Basis, int size, int first, std::size_t n>
inline void momentum_to_places(const std::array<Nodal<Basis>, n>& p, const int* place, double* momentum) {
  constexpr int W = lanes_of<Lane<Basis>>;
  repeat<nodal_batches<Basis>>([&](auto b) {
    std::array<Lane<Basis>, size> of_batch;
    repeat<size>([&](auto j) {
      constexpr bool used = first <= j && j < first + static_cast<int>(n);
      of_batch[j] = used ? p[used ? j - first : 0][b] : Lane<Basis>(0.0);
    });
    add_to_places<std::min(W, Basis::nodes - b * W)>(of_batch, place + b * W, momentum);
  });
}

/// Σ_j M_ij w_j for n components w of the nodes of an element that keeps its M_ij, into the places of its nodes. With
/// w = c that is steps 4 and 5: what the change c_j of the points' velocities adds to the momentum of local node i
/// (eqs 6, 7; step.cpp).
template <class Basis, int n>
inline void add_momentum(const double* M, const NodeRows<Basis>& rows, const int* place, double* momentum) {
  constexpr int K = Basis::nodes, batches = nodal_batches<Basis>;
  const auto w = make_array<n>([&](auto j) { return nodal<Basis>([&](int i) { return rows[i][j]; }); });
  std::array<Nodal<Basis>, n> p;
  repeat<mass_matrix_rows(K)>([&](auto k) {
    Nodal<Basis> M_k;  // M_i,i+k
    repeat<batches>([&](auto b) { M_k[b] = load_mass_matrix<Basis, k, b>(M); });
    repeat<n>([&](auto j) {
      const auto w_k = turned<K, k>(w[j]);
      repeat<batches>([&](auto b) { p[j][b] = k == 0 ? M_k[b] * w_k[b] : fma(M_k[b], w_k[b], p[j][b]); });
      if constexpr (k > 0 && 2 * k != K) {  // and M_i,i−k
        Nodal<Basis> Mw;
        repeat<batches>([&](auto b) { Mw[b] = M_k[b] * w[j][b]; });
        const auto from_behind = turned<K, K - k>(Mw);
        repeat<batches>([&](auto b) { p[j][b] += from_behind[b]; });
      }
    });
  });
  momentum_to_places<Basis, place_size<n>, 0>(p, place, momentum);
}

/// The same for all components of the nodes' Motion at once, side by side: what schemes with P need.
template <class Basis>
inline void add_products(const double* M, const NodeRows<Basis>& rows, const int* place, double* products) {
  constexpr int K = Basis::nodes, n = 2 * Basis::dim, size = row_size<n>;
  static_assert(size == place_size<n>);
  using T = typename Row<n>::value_type;
  repeat<size / lanes_of<T>>([&](auto b) {
    const auto w = make_array<K>([&](auto i) { return T::load_aligned(rows[i] + b * lanes_of<T>); });
    repeat<K>([&](auto i) {
      T p = T(M[mass_matrix_place<Basis>(i, i)]) * w[i];
      repeat<K - 1>([&](auto k) {
        constexpr int j = (i + k + 1) % K;
        p = fma(T(M[mass_matrix_place<Basis>(i, j)]), w[j], p);
      });
      double* to = products + static_cast<std::size_t>(place[i]) * size + b * lanes_of<T>;
      (T::load_unaligned(to) + p).store_unaligned(to);
    });
  });
}

/// n components w for an element that does not keep M_ij: Σ_p m_p N_i Σ_j N_j w_j, through its points. Places have
/// `size` numbers, which this adds to from number `first` on.
template <class Basis, int n, int size, int first>
inline void add_momentum(const typename Basis::Cell& cell, const Points<Basis::dim>& points, const PointRange& range,
                         const NodeRows<Basis>& rows, const int* place, double* momentum) {
  using T = PointBatch<Basis::dim>;
  const ShapesAtPoints<Basis> shapes(cell);
  const Field<Basis, n, Rows::just> w(cell, rows);
  std::array<WideNodal<Basis>, n> sums;
  repeat<n>([&](auto j) { clear<Basis>(sums[j]); });
  for_each_batch_of_element<T>(range, [&](const auto& p, int) {
    const auto local = local_coordinates<Basis>(cell, points, p);
    const auto here = w.at(local);
    const T m = p.load(points.mass);
    const auto mw_of = make_array<n>([&](auto j) { return OfPoints<Basis>(m * here.value(j)); });
    shapes.with(points, p, [&](const auto& at) {
      for_each_group<Basis>(p, [&](int l) {
        const auto N = at(l).N;
        repeat<n>([&](auto j) {
          const auto mw = mw_of[j].of(l);
          repeat<nodal_batches<Basis>>([&](auto b) { sums[j][b] = fma(mw, N[b], sums[j][b]); });
        });
      });
    });
  });
  momentum_to_places<Basis, size, first>(totals<Basis>(sums), place, momentum);
}

/// What an element has for its points in steps 4 to 10.
template <class Basis>
struct ElementMotion {
  NodeRows<Basis> motion;              ///< Motion of each local node
  NodeRows<Basis> a_dt;                ///< change of velocity of pure FLIP of each; only where points book PIC
  const double* shift;                 ///< Shift of its quadrature, as stored
  double weight, size;                 ///< w of its quadrature, and its least height
  const double* hoop_shift = nullptr;  ///< that of N_i / r, in a body of revolution
  double mean_dilation = 0;            ///< volume strain of its points, where that is a mean
  double least_per_mass = 0;           ///< a bound from below of Strains::per_mass; in simplices
};

/// How points are moved and strained.
struct MotionRules {
  double flip = 1;      ///< φ
  bool middle = false;  ///< strain of the middle of the step
  bool affine = false;  ///< points keep the gradient of their velocity, C_p
  double dt = 0;        ///< [s]; asked for with `affine`
};

/// Strain increment of the circumference at distance r from the axis, where the radial displacement is du:
/// Σ du_i,r (N_i / r + s_i).
template <class Basis, class T>
inline T hoop_strain(const ElementMotion<Basis>& element, const T& du, const T& r) {
  double shifted = 0;
  for (int i = 0; i < Basis::nodes; ++i) shifted += element.motion[i][Basis::dim] * element.hoop_shift[i];
  return du / r + T(shifted);
}

/// L dt at points, from the displacements of the nodes and their corrected gradients; and the strain increment of the
/// circumference.
template <class T, int Dim>
struct Gradients {
  std::array<std::array<T, Dim>, Dim> L;
  T hoop = T(0.0);

  T trace() const {
    T sum = L[0][0];
    repeat<Dim - 1>([&](auto j) { sum += L[j + 1][j + 1]; });
    return sum + hoop;
  }
};

template <class Basis, class Shifted, class Motion, class Here, class Local, class T>
inline Gradients<T, Basis::dim> gradients_at(const ElementMotion<Basis>& element, const Shifted& shifted,
                                             const Motion& motion, const Here& here, const Local& local, const T& r) {
  constexpr int Dim = Basis::dim;
  Gradients<T, Dim> g;
  if constexpr (is_axisymmetric<Basis>) g.hoop = hoop_strain<Basis>(element, here.value(Dim), r);
  repeat<Dim>([&](auto j) {
    repeat<Dim>([&](auto k) { g.L[j][k] = shifted.template derivative<j, k>(motion, here, local); });  // eq. 9
  });
  return g;
}

/// Σ du_i · B̄_i of an element of mean dilatation, in a body of revolution with the mean of N_i / r, too.
template <class Basis>
inline double mean_dilation(const Means<Basis>& mean, const NodeRows<Basis>& motion) {
  constexpr int Dim = Basis::dim;
  Lane<Basis> sum(0.0);
  repeat<Dim>([&](auto j) {
    const auto du = nodal<Basis>([&](int i) { return motion[i][Dim + j]; });
    repeat<nodal_batches<Basis>>([&](auto b) {
      sum = fma(du[b], mean.gradient[j][b], sum);
      if constexpr (is_axisymmetric<Basis>) {
        if constexpr (j == 0) sum = fma(du[b], mean.hoop[0][b], sum);
      }
    });
  });
  return xsimd::hadd(sum);
}

/// The same from the cell.
template <class Basis>
inline double mean_dilation(const typename Basis::Cell& cell, const NodeRows<Basis>& motion) {
  if constexpr (std::is_same_v<Basis, GridLinear<Basis::dim>>) {  // B̄_i = ± 2 / (K h) along each axis
    double sum = 0;
    repeat<Basis::dim>([&](auto d) {
      double along = 0;
      repeat<Basis::nodes>([&](auto i) {
        const double du = motion[i][Basis::dim + d];
        along += scarp::detail::far_side(i, d) ? du : -du;
      });
      sum += along * cell.inverse()[d];
    });
    return sum * (2.0 / Basis::nodes);
  } else {
    return mean_dilation<Basis>(Means<Basis>(cell), motion);
  }
}

/// Steps 4 (eq. 6: v_p = φ v_p + Σ c_i N_i; step.cpp), 6, 8, 9 and 10: L dt = Σ du_i ⊗ B_i (eq. 9), strain and
/// spin increments (eqs 10, 11) to `strains` from place `at` on, volume by det(I + L dt) (eq. 14 in its finite form;
/// the density of eq. 15 is m_p / Ω_p), and position (eqs 17–19; the displacement is x_p less x_p at the start). Then
/// moved(lanes, x, motion there before) for each batch.
template <bool pic, class Basis, class Averaged, class F>
inline void nodes_to_points(const typename Basis::Cell& cell, const ElementMotion<Basis>& element,
                            const MotionRules& rules, Points<Basis::dim>& points, const PointRange& range,
                            Strains<Basis::dim>& strains, int at, Averaged averaged, MotionSums<Basis::dim>& sums,
                            F&& moved) {
  constexpr int Dim = Basis::dim;
  using T = PointBatch<Dim>;
  const Field<Basis, 2 * Dim> motion(cell, element.motion);
  const Field<Basis, Dim, Rows::just> a_dt(cell, pic ? element.a_dt : element.motion);
  const ShiftedGradients<Basis> shifted(element.motion, element.shift);
  const double w = element.weight, per_size2 = 1 / (element.size * element.size),
               stiffer = w > 1 ? w * per_size2 : per_size2;
  for_each_batch_of_element<T>(range, [&](const auto& p, int first) {
    const auto local = local_coordinates<Basis>(cell, points, p);
    const auto here = motion.at(local);
    const T m = p.load(points.mass);
    std::array<T, Dim> x;
    T v2(0.0);
    auto g = gradients_at<Basis>(element, shifted, motion, here, local, p.load(points.x[0]));
    repeat<Dim>([&](auto j) {
      const T v_t = p.load(points.v[j]), v = fma(T(rules.flip), v_t, here.value(j));  // eq. 6
      p.store(v, points.v[j]);
      v2 = fma(v, v, v2);
      sums.momentum[j] = fma(m, v, sums.momentum[j]);
      if constexpr (pic) {
        const T v_flip = v_t + a_dt.at(local).value(j);
        sums.taken = fma(m, v_flip * v_flip - v * v, sums.taken);
      }
      x[j] = p.load(points.x[j]) + here.value(Dim + j);  // eq. 17 and eq. 19
      p.store(x[j], points.x[j]);
    });
    if constexpr (pic) {
      if (rules.affine) {
        repeat<Dim>([&](auto j) {
          repeat<Dim>(
              [&](auto k) { p.store(here.template derivative<k>(Dim + j) * T(1 / rules.dt), points.C[j * Dim + k]); });
        });
      }
    }
    sums.mass += m;
    sums.kinetic_energy = fma(m, v2, sums.kinetic_energy);
    sums.fastest2 = max(sums.fastest2, select(m > T(0.0), v2, T(0.0)));  // lanes without a point have any v
    if (averaged) {
      T more = (T(element.mean_dilation) - g.trace()) * T(1.0 / mean_directions<Basis>);
      if constexpr (keeps_means<Basis>) more *= share_of_mean<Basis>(local);
      repeat<Dim>([&](auto j) { g.L[j][j] += more; });
      if constexpr (is_axisymmetric<Basis>) g.hoop += more;
    }
    const T Omega = p.load(points.volume) * determinant_of_stretch(g.L) * (T(1.0) + g.hoop);  // eq. 14, finite
    p.store(Omega, points.volume);
    const T dilation = g.trace();
    if (rules.middle) {
      T hoop(0.0);
      if constexpr (is_axisymmetric<Basis>) hoop = g.hoop / fma(T(0.5), g.hoop, T(1.0));
      store_strains(increments_of_middle(g.L, hoop), strains, at + first);
    } else {
      store_strains(increments_of(g.L, g.hoop), strains, at + first);
    }
    (T(w) * Omega * (T(1.0) - T(0.5) * dilation)).store_unaligned(strains.volume.data() + at + first);
    T per_mass = T(stiffer) * Omega / m;
    if constexpr (is_simplex<Basis>) per_mass = max(per_mass, T(element.least_per_mass));
    per_mass.store_unaligned(strains.per_mass.data() + at + first);
    (T(per_size2) * v2).store_unaligned(strains.speed2.data() + at + first);
    moved(p, x, here);
  });
}

}  // namespace scarp::transfer
