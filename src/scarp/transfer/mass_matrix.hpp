// The mass matrix M_ij = Σ m_p N_i N_j of an element: how it is kept, and its products with fields of the nodes.
#pragma once

#include <algorithm>
#include <array>

#include "scarp/transfer/node_values.hpp"
#include "scarp/transfer/simd/fields.hpp"
#include "scarp/transfer/simd/shapes_at_points.hpp"

namespace scarp::transfer {

/// Do the elements keep M_ij = Σ m_p N_i N_j? With few nodes that is less work than to go through the points again.
inline constexpr int most_nodes_with_mass_matrix = 8;
template <class Basis>
inline constexpr bool keeps_mass_matrix = Basis::nodes <= most_nodes_with_mass_matrix;

/// M_ij is symmetric: it is kept in rows of M_i,i+k (indices modulo the number of nodes) for k = 0 to half of that
/// number; where that is even the last row has each number twice, and only half of it is kept.
constexpr int mass_matrix_rows(int nodes) {
  return nodes <= most_nodes_with_mass_matrix ? nodes / 2 + 1 : 0;
}
/// Numbers that are kept, in rows of `padded`.
constexpr std::size_t mass_matrix_size(int nodes, std::size_t padded) {
  const auto rows = static_cast<std::size_t>(mass_matrix_rows(nodes));
  return nodes % 2 == 0 && rows > 0 ? (rows - 1) * padded + padded / 2 : rows * padded;
}

/// Where M_ij of an element is in what it keeps.
template <class Basis>
constexpr int mass_matrix_place(int i, int j) {
  constexpr int K = Basis::nodes;
  const int k = (j - i + K) % K;
  if (2 * k > K) return mass_matrix_place<Basis>(j, i);
  return k * nodal_size<Basis> + (2 * k == K ? i % (K / 2) : i);
}

/// The rows as they are summed up.
template <class Basis>
using MassMatrixSums = std::array<WideNodal<Basis>, mass_matrix_rows(Basis::nodes)>;

/// Sums Σ m_p N_i N_{i+k} over the points, in the rows that an element keeps.
template <class Basis>
inline void store_mass_matrix(const MassMatrixSums<Basis>& sums, double* M) {
  constexpr int K = Basis::nodes, W = lanes_of<Lane<Basis>>;
  repeat<mass_matrix_rows(K)>([&](auto k) {
    const auto row = total<Basis>(sums[k]);
    double* to = M + k * nodal_size<Basis>;
    if constexpr (2 * k < K) {
      store_nodal<Basis>(row, to);
    } else if constexpr (K == W) {
      store_first(row[0], to, K / 2);
    } else {
      repeat<nodal_batches<Basis> / 2>([&](auto b) { row[b].store_unaligned(to + b * W); });
    }
  });
}

/// Batch b of row k.
template <class Basis, int k, int b>
inline Lane<Basis> load_mass_matrix(const double* M) {
  constexpr int K = Basis::nodes, W = lanes_of<Lane<Basis>>;
  const double* from = M + k * nodal_size<Basis>;
  if constexpr (2 * k < K) return Lane<Basis>::load_unaligned(from + b * W);
  if constexpr (K == W) return load_twice<Lane<Basis>>(from);
  return Lane<Basis>::load_unaligned(from + b % std::max(1, nodal_batches<Basis> / 2) * W);
}

/// Adds n components p of an element's local nodes to the accumulators of its nodes, `size` numbers each, from number
/// `first` on.
template <class Basis, int size, int first, std::size_t n>
inline void momentum_to_accumulators(const std::array<Nodal<Basis>, n>& p, const int* accumulator, double* momentum) {
  constexpr int W = lanes_of<Lane<Basis>>;
  repeat<nodal_batches<Basis>>([&](auto b) {
    std::array<Lane<Basis>, size> of_batch;
    repeat<size>([&](auto j) {
      constexpr bool used = first <= j && j < first + static_cast<int>(n);
      of_batch[j] = used ? p[used ? j - first : 0][b] : Lane<Basis>(0.0);
    });
    add_to_accumulators<std::min(W, Basis::nodes - b * W)>(of_batch, accumulator + b * W, momentum);
  });
}

/// Σ_j M_ij w_j for n components w of the nodes of an element that keeps its M_ij, into the accumulators of its nodes.
/// With w = c that is steps 4 and 5: what the change c_j of the points' velocities adds to the momentum of local node i
/// (eqs 6, 7; step.cpp).
template <class Basis, int n>
inline void add_momentum(const double* M, const NodeRows<Basis>& rows, const int* accumulator, double* momentum) {
  constexpr int K = Basis::nodes, batches = nodal_batches<Basis>;
  const auto w = make_array<n>([&](auto j) { return nodal<Basis>([&](int i) { return rows[i][j]; }); });
  std::array<Nodal<Basis>, n> p;
  repeat<mass_matrix_rows(K)>([&](auto k) {
    Nodal<Basis> M_k;  // M_i,i+k
    repeat<batches>([&](auto b) { M_k[b] = load_mass_matrix<Basis, k, b>(M); });
    repeat<n>([&](auto j) {
      const auto w_k = rotated<K, k>(w[j]);
      repeat<batches>([&](auto b) { p[j][b] = k == 0 ? M_k[b] * w_k[b] : fma(M_k[b], w_k[b], p[j][b]); });
      if constexpr (k > 0 && 2 * k != K) {  // and M_i,i−k
        Nodal<Basis> Mw;
        repeat<batches>([&](auto b) { Mw[b] = M_k[b] * w[j][b]; });
        const auto from_behind = rotated<K, K - k>(Mw);
        repeat<batches>([&](auto b) { p[j][b] += from_behind[b]; });
      }
    });
  });
  momentum_to_accumulators<Basis, accumulator_size<n>, 0>(p, accumulator, momentum);
}

/// The same for all components of the nodes' Motion at once, side by side: what schemes with P need.
template <class Basis>
inline void add_products(const double* M, const NodeRows<Basis>& rows, const int* accumulator, double* products) {
  constexpr int K = Basis::nodes, n = 2 * Basis::dim, size = row_size<n>;
  static_assert(size == accumulator_size<n>);
  using T = typename Row<n>::value_type;
  repeat<size / lanes_of<T>>([&](auto b) {
    const auto w = make_array<K>([&](auto i) { return T::load_aligned(rows[i] + b * lanes_of<T>); });
    repeat<K>([&](auto i) {
      T p = T(M[mass_matrix_place<Basis>(i, i)]) * w[i];
      repeat<K - 1>([&](auto k) {
        constexpr int j = (i + k + 1) % K;
        p = fma(T(M[mass_matrix_place<Basis>(i, j)]), w[j], p);
      });
      double* to = products + static_cast<std::size_t>(accumulator[i]) * size + b * lanes_of<T>;
      (T::load_unaligned(to) + p).store_unaligned(to);
    });
  });
}

/// n components w for an element that does not keep M_ij: Σ_p m_p N_i Σ_j N_j w_j, through its points. Accumulators
/// have `size` numbers, which this adds to from number `first` on.
template <class Basis, int n, int size, int first>
inline void add_momentum(const typename Basis::Cell& cell, const Points<Basis::dim>& points, const PointRange& range,
                         const NodeRows<Basis>& rows, const int* accumulator, double* momentum) {
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
  momentum_to_accumulators<Basis, size, first>(totals<Basis>(sums), accumulator, momentum);
}

}  // namespace scarp::transfer
