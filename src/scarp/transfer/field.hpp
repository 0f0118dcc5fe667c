// Fields of nodal values at points, a point in each lane: Σ N_i u_i and Σ u_i ⊗ B_i (eqs 6, 9, 16).
#pragma once

#include <array>

#include "scarp/mesh/basis.hpp"
#include "scarp/mesh/grid_bases.hpp"
#include "scarp/transfer/local.hpp"

namespace scarp::transfer {

/// n components of each local node of an element: where their rows are. A row may be read to its whole row_size<n>.
template <class Basis>
using NodeRows = std::array<const double*, Basis::nodes>;

/// The field of n components for one element. at(local) is the field at a few points: value(c) and derivative<d>(c),
/// dc/dx_d. This one is for any basis, and sums over the nodes.
template <class Basis, int n>
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

/// A product of linear functions on the unit box, from its values at the corners in the order of an element's nodes: as
/// Σ c_m Π s_d over the axes d in the bits of m.
template <int Dim, int n>
class Multilinear {
  static constexpr int K = 1 << Dim;

 public:
  explicit Multilinear(const std::array<const double*, K>& u) {
    using T = typename Row<n>::value_type;
    repeat<row_size<n> / lanes_of<T>>([&](auto b) {
      std::array<T, K> c;
      repeat<K>([&](auto i) { c[corner(i)] = T::load_unaligned(u[i] + b * lanes_of<T>); });
      repeat<Dim>([&](auto d) {
        repeat<K>([&](auto m) {
          if constexpr ((m >> d & 1) != 0) c[m] = c[m] - c[m ^ 1 << d];
        });
      });
      repeat<K>([&](auto m) { c[m].store_unaligned(c_[m].data() + b * lanes_of<T>); });
    });
  }

  template <class T>
  T value(const std::array<T, Dim>& s, int c) const {
    if constexpr (Dim == 2) {
      return fma(s[1], along(2, s[0], c), along(0, s[0], c));
    } else {
      return fma(s[2], fma(s[1], along(6, s[0], c), along(4, s[0], c)),
                 fma(s[1], along(2, s[0], c), along(0, s[0], c)));
    }
  }

  /// Derivative along axis d of the box.
  template <int d, class T>
  T derivative(const std::array<T, Dim>& s, int c) const {
    const auto k = [&](int m) { return T(c_[m][c]); };
    if constexpr (Dim == 2) {
      if constexpr (d == 0) return fma(s[1], k(3), k(1));
      if constexpr (d == 1) return along(2, s[0], c);
    } else {
      if constexpr (d == 0) return fma(s[2], fma(s[1], k(7), k(5)), fma(s[1], k(3), k(1)));
      if constexpr (d == 1) return fma(s[2], along(6, s[0], c), along(2, s[0], c));
      if constexpr (d == 2) return fma(s[1], along(6, s[0], c), along(4, s[0], c));
    }
  }

 private:
  /// The axes along which local node i is on the far side, as bits.
  static constexpr int corner(int i) {
    int m = 0;
    for (int d = 0; d < Dim; ++d) m |= detail::far_side(i, d) << d;
    return m;
  }

  /// c_m + c_{m+1} s_0
  template <class T>
  T along(int m, const T& s, int c) const {
    return fma(s, T(c_[m + 1][c]), T(c_[m][c]));
  }

  alignas(64) std::array<std::array<double, row_size<n>>, K> c_;
};

template <int Dim, int n>
class Field<GridLinear<Dim>, n> {
  using Basis = GridLinear<Dim>;

 public:
  Field(const typename Basis::Cell& cell, const NodeRows<Basis>& u) : cell_(cell), u_(u) {}

  template <class T>
  struct At {
    const Field& field;
    const std::array<T, Dim>& s;

    T value(int c) const { return field.u_.value(s, c); }
    template <int d>
    T derivative(int c) const {
      return field.u_.template derivative<d>(s, c) * T(field.cell_.inverse()[d]);
    }
  };

  /// `local` must outlive the result.
  template <class T>
  At<T> at(const std::array<T, Dim>& local) const {
    return {*this, local};
  }

 private:
  const typename Basis::Cell& cell_;
  Multilinear<Dim, n> u_;
};

/// Quadrilaterals and hexahedra of any shape: both the field and x are multilinear in s, and so du/dx = du/ds
/// (dx/ds)⁻¹.
template <class Basis, int n>
requires(Basis::stores_local&& Basis::nodes == 1 << Basis::dim) class Field<Basis, n> {
  static constexpr int Dim = Basis::dim, K = Basis::nodes;
  using Positions = std::array<std::array<double, row_size<Dim>>, K>;

 public:
  Field(const typename Basis::Cell& cell, const NodeRows<Basis>& u) : x_(rows(padded(cell))), u_(u) {}

  template <class T>
  struct At {
    const Field& field;
    std::array<T, Dim> s;
    std::array<std::array<T, Dim>, Dim> I;  ///< ds/dx

    T value(int c) const { return field.u_.value(s, c); }
    template <int d>
    T derivative(int c) const {
      T sum = field.u_.template derivative<0>(s, c) * I[0][d];
      repeat<Dim - 1>([&](auto k) { sum = fma(field.u_.template derivative<k + 1>(s, c), I[k + 1][d], sum); });
      return sum;
    }
  };

  template <class T>
  At<T> at(const std::array<T, Dim>& local) const {
    At<T> at{*this, Basis::Cell::unit(local), {}};
    std::array<std::array<T, Dim>, Dim> J;
    repeat<Dim>([&](auto j) { repeat<Dim>([&](auto k) { J[j][k] = x_.template derivative<k>(at.s, j); }); });
    detail::inverse(J, at.I);
    return at;
  }

 private:
  static Positions padded(const typename Basis::Cell& cell) {
    Positions x{};
    repeat<K>([&](auto i) { repeat<Dim>([&](auto j) { x[i][j] = cell.positions()[i][j]; }); });
    return x;
  }
  static NodeRows<Basis> rows(const Positions& x) {
    NodeRows<Basis> rows;
    repeat<K>([&](auto i) { rows[i] = x[i].data(); });
    return rows;
  }

  Multilinear<Dim, Dim> x_;
  Multilinear<Dim, n> u_;
};

}  // namespace scarp::transfer
