// Shape functions at the points of an element with a local node in each lane: sums over points then need no sums over
// lanes, lie side by side or not, and take any number of points.
#pragma once

#include <array>
#include <utility>

#include "scarp/mesh/basis.hpp"
#include "scarp/mesh/grid_bases.hpp"
#include "scarp/transfer/local.hpp"

namespace scarp::transfer {

template <class Basis>
using Lane = NodeBatch<Basis::dim, Basis::nodes>;

/// A number of each local node of a basis.
template <class Basis>
using Nodal = AtNodes<Basis::dim, Basis::nodes>;

/// Number of batches of a Nodal, and of doubles, lanes behind the last node included.
template <class Basis>
inline constexpr int nodal_batches = static_cast<int>(std::tuple_size_v<Nodal<Basis>>);
template <class Basis>
inline constexpr int nodal_size = nodal_batches<Basis>* lanes_of<Lane<Basis>>;

/// f(i) of local node i in its lane; zero behind the last node.
template <class Basis, class F>
inline Nodal<Basis> nodal(F&& f) {
  using T = Lane<Basis>;
  const auto one = [&](int i) { return i < Basis::nodes ? f(i < Basis::nodes ? i : 0) : 0.0; };
  Nodal<Basis> all;
  repeat<nodal_batches<Basis>>(
      [&](auto b) { all[b] = from_lanes<T>([&](int l) { return one(b * lanes_of<T> + l); }); });
  return all;
}

template <class Basis>
inline void store_nodal(const Nodal<Basis>& all, double* to) {
  repeat<nodal_batches<Basis>>([&](auto b) { all[b].store_unaligned(to + b * lanes_of<Lane<Basis>>); });
}

/// N_i and B_i at one point.
template <class Basis>
struct Shapes {
  Nodal<Basis> N;
  std::array<Nodal<Basis>, Basis::dim> B;
};

/// What a basis needs once per element, and f(i, shapes) for its points i. In general: a point in each lane, and
/// turned.
template <class Basis>
class ShapesAtPoints {
  static constexpr int Dim = Basis::dim, K = Basis::nodes;
  using T = PointBatch<Dim>;

 public:
  explicit ShapesAtPoints(const typename Basis::Cell& cell) : cell_(cell) {}

  template <class F>
  void for_each(const Points<Dim>& points, const PointRange& range, F&& f) const {
    for_each_batch_of_element<T>(range, [&](const auto& p, int) {
      std::array<T, K> N;
      std::array<std::array<T, Dim>, K> B;
      cell_.gradients(local_coordinates<Basis>(cell_, points, p), N, B);
      std::array<Shapes<Basis>, T::size> shapes;
      turn([&](int i) { return N[i]; }, [&](int l) -> auto& { return shapes[l].N; });
      for (int d = 0; d < Dim; ++d) {
        turn([&](int i) { return B[i][d]; }, [&](int l) -> auto& { return shapes[l].B[d]; });
      }
      for (int l = 0; l < p.count(); ++l) f(p.point(l), shapes[l]);
    });
  }

 private:
  template <class From, class To>
  static void turn(From&& from, To&& to) {
    static_assert(lanes_of<Lane<Basis>> == lanes_of<T>);
    for (int b = 0; b < nodal_batches<Basis>; ++b) {
      std::array<T, T::size> rows;
      for (int l = 0; l < lanes_of<T>; ++l) {
        const int i = b * lanes_of<T> + l;
        rows[l] = i < K ? from(i < K ? i : 0) : T(0.0);
      }
      transpose(rows);
      for (int l = 0; l < lanes_of<T>; ++l) to(l)[b] = rows[l];
    }
  }

  const typename Basis::Cell& cell_;
};

/// N_i = Π (1 − s_d) or s_d: factors a + b s_d with a, b of each node.
template <int Dim>
class ShapesAtPoints<GridLinear<Dim>> {
  using Basis = GridLinear<Dim>;
  using T = Lane<Basis>;
  static constexpr int batches = nodal_batches<Basis>;

 public:
  explicit ShapesAtPoints(const typename Basis::Cell& cell) : cell_(cell) {
    repeat<Dim>([&](auto d) {
      a_[d] = nodal<Basis>([](int i) { return detail::far_side(i, decltype(d)::value) ? 0.0 : 1.0; });
      b_[d] = nodal<Basis>([](int i) { return detail::far_side(i, decltype(d)::value) ? 1.0 : -1.0; });
      repeat<batches>([&](auto b) { dN_[d][b] = b_[d][b] * T(cell.inverse()[d]); });
    });
  }

  template <class F>
  void for_each(const Points<Dim>& points, const PointRange& range, F&& f) const {
    for (int k = 0; k < range.count; ++k) {
      const int i = range.order[k];
      std::array<T, Dim> s;
      repeat<Dim>([&](auto d) { s[d] = (T(points.x[d][i]) - T(cell_.low()[d])) * T(cell_.inverse()[d]); });
      Shapes<Basis> at;
      repeat<batches>([&](auto b) {
        std::array<T, Dim> factor;
        repeat<Dim>([&](auto d) { factor[d] = fma(b_[d][b], s[d], a_[d][b]); });
        if constexpr (Dim == 2) {
          at.N[b] = factor[0] * factor[1];
          at.B[0][b] = dN_[0][b] * factor[1];
          at.B[1][b] = dN_[1][b] * factor[0];
        } else {
          const T xy = factor[0] * factor[1];
          at.N[b] = xy * factor[2];
          at.B[0][b] = dN_[0][b] * (factor[1] * factor[2]);
          at.B[1][b] = dN_[1][b] * (factor[0] * factor[2]);
          at.B[2][b] = dN_[2][b] * xy;
        }
      });
      f(i, at);
    }
  }

 private:
  const typename Basis::Cell& cell_;
  std::array<Nodal<Basis>, Dim> a_, b_, dN_;
};

/// N_i = N_i(x_0) + B_i (x − x_0)
template <class Basis>
requires(Basis::nodes == Basis::dim + 1) class ShapesAtPoints<Basis> {
  static constexpr int Dim = Basis::dim;
  using T = Lane<Basis>;
  static constexpr int batches = nodal_batches<Basis>;

 public:
  explicit ShapesAtPoints(const typename Basis::Cell& cell) : cell_(cell) {
    first_ = nodal<Basis>([](int i) { return i == 0 ? 1.0 : 0.0; });
    const auto& B = cell.constant_gradients();
    for (int d = 0; d < Dim; ++d) at_.B[d] = nodal<Basis>([&, d](int i) { return B[i][d]; });
  }

  template <class F>
  void for_each(const Points<Dim>& points, const PointRange& range, F&& f) const {
    Shapes<Basis> at = at_;
    for (int k = 0; k < range.count; ++k) {
      const int i = range.order[k];
      at.N = first_;
      repeat<Dim>([&](auto d) {
        const T offset = T(points.x[d][i]) - T(cell_.low()[d]);
        repeat<batches>([&](auto b) { at.N[b] = fma(offset, at.B[d][b], at.N[b]); });
      });
      f(i, at);
    }
  }

 private:
  const typename Basis::Cell& cell_;
  Nodal<Basis> first_;
  Shapes<Basis> at_;
};

}  // namespace scarp::transfer
