// Fields of nodal values at points, a point in each lane: Σ N_i u_i and Σ u_i ⊗ B_i (eqs 6, 9, 16).
#pragma once

#include <algorithm>
#include <array>

#include "scarp/mesh/basis.hpp"
#include "scarp/transfer/node_values.hpp"

namespace scarp::transfer {

/// Whether rows of nodal values may be read beyond their last number, to whole batches.
enum class Rows { padded, just };

/// Batch b of a row of n numbers.
template <int n, Rows rows, int b>
inline auto load_row(const double* row) {
  using T = typename Row<n>::value_type;
  constexpr int W = lanes_of<T>, count = std::min(W, n - b * W);
  if constexpr (rows == Rows::padded || count == W) return T::load_unaligned(row + b * W);
  return load_first<T>(row + b * W, count);
}

/// The field of n components for one element. at(local) is the field at a few points: value(c) and derivative<d>(c),
/// dc/dx_d. This one is for any basis, and sums over the nodes.
template <class Basis, int n, Rows rows = Rows::padded>
class Field {
  static constexpr int Dim = Basis::dim, K = Basis::nodes;

 public:
  Field(const typename Basis::Cell& cell, const NodeRows<Basis>& u) : cell_(cell), u_(u) {}

  template <class T>
  struct At {
    const NodeRows<Basis>& u;
    std::array<T, K> N;
    std::array<std::array<T, Dim>, K> B;

    T value(int c) const {
      T sum = N[0] * T(u[0][c]);
      for (int i = 1; i < K; ++i) sum = fma(N[i], T(u[i][c]), sum);
      return sum;
    }
    template <int d>
    T derivative(int c) const {
      T sum = B[0][d] * T(u[0][c]);
      for (int i = 1; i < K; ++i) sum = fma(B[i][d], T(u[i][c]), sum);
      return sum;
    }
  };

  template <class Local>
  auto at(const Local& local) const {
    At<typename Local::value_type> at{u_, {}, {}};
    cell_.gradients(local, at.N, at.B);
    return at;
  }

 private:
  const typename Basis::Cell& cell_;
  NodeRows<Basis> u_;
};

}  // namespace scarp::transfer
