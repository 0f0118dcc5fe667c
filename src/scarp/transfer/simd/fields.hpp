// Fields of nodal values at points (transfer/field.hpp) in forms that cost less than a sum over the nodes: of
// multilinear functions, triangles and tetrahedra, and B-splines.
#pragma once

#include <array>

#include "scarp/mesh/basis.hpp"
#include "scarp/mesh/grid_bases.hpp"
#include "scarp/transfer/field.hpp"

namespace scarp::transfer {

/// A product of linear functions on the unit box, from its values at the corners in the order of an element's nodes: as
/// Σ c_m Π s_d over the axes d in the bits of m.
template <int Dim, int n, Rows rows = Rows::padded>
class Multilinear {
  static constexpr int K = 1 << Dim;

 public:
  explicit Multilinear(const std::array<const double*, K>& u) {
    using T = typename Row<n>::value_type;
    repeat<row_size<n> / lanes_of<T>>([&](auto b) {
      std::array<T, K> c;
      repeat<K>([&](auto i) { c[corner(i)] = load_row<n, rows, b>(u[i]); });
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

template <int Dim, int n, Rows rows>
class Field<GridLinear<Dim>, n, rows> {
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
  Multilinear<Dim, n, rows> u_;
};

/// A quadrilateral or hexahedron of any shape: x is multilinear in s.
template <class Basis>
class BoxPlace {
  static constexpr int Dim = Basis::dim;

 public:
  explicit BoxPlace(const typename Basis::Cell& cell)
      : cell_(cell), x_(make_array<Basis::nodes>([&](auto i) { return cell.corner(i); })) {}

  const typename Basis::Cell& cell() const { return cell_; }

  /// x less the position at s
  template <class T>
  std::array<T, Dim> offset(const std::array<T, Dim>& x, const std::array<T, Dim>& s) const {
    return make_array<Dim>([&](auto j) { return x[j] - x_.value(s, j); });
  }

  /// (dx/ds)⁻¹
  template <class T>
  std::array<std::array<T, Dim>, Dim> inverse_jacobian(const std::array<T, Dim>& s) const {
    std::array<std::array<T, Dim>, Dim> J, I;
    repeat<Dim>([&](auto j) { repeat<Dim>([&](auto k) { J[j][k] = x_.template derivative<k>(s, j); }); });
    scarp::detail::inverse(J, I);
    return I;
  }

 private:
  const typename Basis::Cell& cell_;
  Multilinear<Dim, Dim, Rows::just> x_;
};

/// There both x and the field are multilinear in s, and so du/dx = du/ds (dx/ds)⁻¹.
template <class Basis, int n, Rows rows>
requires(Basis::stores_local&& Basis::nodes == 1 << Basis::dim) class Field<Basis, n, rows> {
  static constexpr int Dim = Basis::dim;

 public:
  Field(const typename Basis::Cell& cell, const NodeRows<Basis>& u) : place_(cell), u_(u) {}

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

    /// Local coordinates of the points at x, not far from here; where that worked. Newton's method with the Jacobian of
    /// here: the error after a step is less than that step times the first one.
    Mask<T> follow(const std::array<T, Dim>& x, std::array<T, Dim>& local) const {
      std::array<T, Dim> now = s;
      T first(0.0);
      Mask<T> good = s[0] != s[0];
      for (int iteration = 0; iteration < 3 && !all(good); ++iteration) {
        const auto off = field.place_.offset(x, now);
        T largest(0.0);
        repeat<Dim>([&](auto k) {
          T step = I[k][0] * off[0];
          repeat<Dim - 1>([&](auto j) { step = fma(I[k][j + 1], off[j + 1], step); });
          now[k] += step;
          largest = max(largest, abs(step));
        });
        if (iteration == 0) first = largest;
        good = largest * first < T(1e-13);
      }
      repeat<Dim>([&](auto k) { local[k] = T(2.0) * now[k] - T(1.0); });
      return good;
    }
  };

  template <class T>
  At<T> at(const std::array<T, Dim>& local) const {
    const auto s = Basis::Cell::unit(local);
    return {*this, s, place_.inverse_jacobian(s)};
  }

 private:
  BoxPlace<Basis> place_;
  Multilinear<Dim, n, rows> u_;
};

/// Triangles and tetrahedra: u_0 + Σ (u_k − u_0) ξ_k, of one gradient.
template <class Basis, int n, Rows rows>
requires(Basis::nodes == Basis::dim + 1) class Field<Basis, n, rows> {
  static constexpr int Dim = Basis::dim;
  using OfNode = std::array<double, row_size<n>>;

 public:
  Field(const typename Basis::Cell& cell, const NodeRows<Basis>& u) {
    using R = typename Row<n>::value_type;
    const auto& B = cell.constant_gradients();
    repeat<row_size<n> / lanes_of<R>>([&](auto b) {
      const auto to = [&](const R& x, OfNode& row) { x.store_aligned(row.data() + b * lanes_of<R>); };
      const auto u_i = make_array<Basis::nodes>([&](auto i) { return load_row<n, rows, b>(u[i]); });
      to(u_i[0], first_);
      repeat<Dim>([&](auto k) { to(u_i[k + 1] - u_i[0], more_[k]); });
      repeat<Dim>([&](auto d) {
        R slope = (u_i[1] - u_i[0]) * R(B[1][d]);
        repeat<Dim - 1>([&](auto k) { slope = fma(u_i[k + 2] - u_i[0], R(B[k + 2][d]), slope); });
        to(slope, slope_[d]);
      });
    });
  }

  template <class T>
  struct At {
    const Field& field;
    const std::array<T, Dim>& xi;

    T value(int c) const {
      T sum(field.first_[c]);
      repeat<Dim>([&](auto k) { sum = fma(xi[k], T(field.more_[k][c]), sum); });
      return sum;
    }
    template <int d>
    T derivative(int c) const {
      return T(field.slope_[d][c]);
    }
  };

  /// `local` must outlive the result.
  template <class T>
  At<T> at(const std::array<T, Dim>& local) const {
    return {*this, local};
  }

 private:
  alignas(64) OfNode first_;
  std::array<OfNode, Dim> more_, slope_;  ///< u_k − u_0, and du/dx_d
};

/// B-splines: first along x in each line of nodes, then along y, and z.
template <int Dim, int n, Rows rows>
class Field<GridSpline<Dim>, n, rows> {
  using Basis = GridSpline<Dim>;
  static constexpr int each = Basis::each;

 public:
  Field(const typename Basis::Cell& cell, const NodeRows<Basis>& u) : cell_(cell), u_(u) {}

  template <class T>
  class At {
   public:
    At(const Field& field, const std::array<T, Dim>& s) : u_(field.u_) { field.cell_.along_axes(s, f_, g_); }

    T value(int c) const { return sum<-1>(c); }
    template <int d>
    T derivative(int c) const {
      return sum<d>(c);
    }

   private:
    template <int d>
    T sum(int c) const {
      return along<Dim - 1, d>(0, c);
    }

    /// Over the nodes from `first` on in axes 0 to `axis`, with derivatives in axis d.
    template <int axis, int d>
    T along(int first, int c) const {
      if constexpr (axis < 0) {
        return T(u_[first][c]);
      } else {
        const auto& f = axis == d ? g_[axis] : f_[axis];
        constexpr int stride = scarp::detail::power(each, axis);
        T sum = f[0] * along<axis - 1, d>(first, c);
        repeat<each - 1>([&](auto k) { sum = fma(f[k + 1], along<axis - 1, d>(first + (k + 1) * stride, c), sum); });
        return sum;
      }
    }

    const NodeRows<Basis>& u_;
    std::array<std::array<T, each>, Dim> f_, g_;  ///< the functions along each axis and their slopes
  };

  template <class T>
  At<T> at(const std::array<T, Dim>& local) const {
    return {*this, local};
  }

 private:
  const typename Basis::Cell& cell_;
  NodeRows<Basis> u_;
};

}  // namespace scarp::transfer
