// Shape functions at the points of an element with a local node in each lane: sums over points then need no sums over
// lanes, lie side by side or not, and take any number of points.
#pragma once

#include <array>

#include "scarp/mesh/basis.hpp"
#include "scarp/mesh/grid_bases.hpp"
#include "scarp/transfer/local.hpp"
#include "scarp/transfer/simd/fields.hpp"
#include "scarp/transfer/simd/node_lanes.hpp"
#include "scarp/transfer/simd/spline_functions.hpp"

namespace scarp::transfer {

/// N_i and B_i at one point, or at each of two.
template <class Basis>
struct Shapes {
  WideNodal<Basis> N;
  std::array<WideNodal<Basis>, Basis::dim> B;
};

/// What a basis needs once per element; with(points, p, f) then calls f(at) for the points of some lanes, where at(l)
/// are the Shapes of point l (and l + 1). In general: with a point in each lane, and rotated.
template <class Basis>
class ShapesAtPoints {
  static constexpr int Dim = Basis::dim, K = Basis::nodes;
  using T = PointBatch<Dim>;

 public:
  explicit ShapesAtPoints(const typename Basis::Cell& cell) : cell_(cell) {}

  const typename Basis::Cell& cell() const { return cell_; }

  template <class Lanes, class F>
  void with(const Points<Dim>& points, const Lanes& p, F&& f) const {
    std::array<T, K> N;
    std::array<std::array<T, Dim>, K> B;
    cell_.gradients(local_coordinates<Basis>(cell_, points, p), N, B);
    Transposed all;
    to_lanes_of_nodes([&](int i) { return N[i]; }, all.N);
    for (int d = 0; d < Dim; ++d) to_lanes_of_nodes([&](int i) { return B[i][d]; }, all.B[d]);
    f(all);
  }

 private:
  using OfEach = std::array<Nodal<Basis>, lanes_of<T>>;
  struct Transposed {
    OfEach N;
    std::array<OfEach, Dim> B;

    Shapes<Basis> operator()(int l) const {
      constexpr int next = points_at_once<Basis> - 1;
      Shapes<Basis> at;
      repeat<nodal_batches<Basis>>([&](auto b) {
        at.N[b] = for_each_point<Basis>(N[l][b], N[l + next][b]);
        repeat<Dim>([&](auto d) { at.B[d][b] = for_each_point<Basis>(B[d][l][b], B[d][l + next][b]); });
      });
      return at;
    }
  };

  template <class From>
  static void to_lanes_of_nodes(From&& from, OfEach& to) {
    constexpr int W = lanes_of<T>;
    static_assert(lanes_of<Lane<Basis>> == W);
    for (int b = 0; b < nodal_batches<Basis>; ++b) {
      std::array<T, T::size> rows;
      for (int l = 0; l < W; ++l) {
        const int i = b * W + l;
        rows[l] = i < K ? from(i < K ? i : 0) : T(0.0);
      }
      transpose(rows);
      for (int l = 0; l < W; ++l) to[l][b] = rows[l];
    }
  }

  const typename Basis::Cell& cell_;
};

namespace detail {

/// Multilinear functions in the lanes of their nodes: N_i = Π (a_di + b_di s_d), with 1 − s_d or s_d as factors.
template <class Basis>
struct Factors {
  static constexpr int Dim = Basis::dim;
  std::array<WideNodal<Basis>, Dim> a, b;

  Factors() {
    repeat<Dim>([&](auto d) {
      a[d] = for_each_point<Basis>(
          nodal<Basis>([](int i) { return scarp::detail::far_side(i, decltype(d)::value) ? 0.0 : 1.0; }));
      b[d] = for_each_point<Basis>(
          nodal<Basis>([](int i) { return scarp::detail::far_side(i, decltype(d)::value) ? 1.0 : -1.0; }));
    });
  }
};

}  // namespace detail

template <int Dim>
class ShapesAtPoints<GridLinear<Dim>> {
  using Basis = GridLinear<Dim>;
  using W = Wide<Basis>;

 public:
  explicit ShapesAtPoints(const typename Basis::Cell& cell) : cell_(cell) {
    repeat<Dim>([&](auto d) {
      repeat<nodal_batches<Basis>>([&](auto b) { slope_[d][b] = factor_.b[d][b] * W(cell.inverse()[d]); });
    });
  }

  const typename Basis::Cell& cell() const { return cell_; }

  template <class Lanes, class F>
  void with(const Points<Dim>& points, const Lanes& p, F&& f) const {
    const auto x = make_array<Dim>([&](auto d) { return of_points<Basis>(p, points.x[d]); });
    f([&](int l) {
      std::array<W, Dim> offset;
      repeat<Dim>([&](auto d) { offset[d] = x[d].of(l) - W(cell_.low()[d]); });
      Shapes<Basis> at;
      repeat<nodal_batches<Basis>>([&](auto b) {
        std::array<W, Dim> factor, others;
        repeat<Dim>([&](auto d) { factor[d] = fma(slope_[d][b], offset[d], factor_.a[d][b]); });
        at.N[b] = products(factor, others);
        repeat<Dim>([&](auto d) { at.B[d][b] = slope_[d][b] * others[d]; });
      });
      return at;
    });
  }

 private:
  const typename Basis::Cell& cell_;
  detail::Factors<Basis> factor_;
  std::array<WideNodal<Basis>, Dim> slope_;
};

/// Quadrilaterals and hexahedra of any shape: (dx/ds)⁻¹ with a point in each lane.
template <class Basis>
requires std::is_same_v<Basis, Linear<Q4>> || std::is_same_v<Basis, Linear<H8>>
class ShapesAtPoints<Basis> {
  static constexpr int Dim = Basis::dim;
  using W = Wide<Basis>;

 public:
  explicit ShapesAtPoints(const typename Basis::Cell& cell) : place_(cell) {}

  template <class Lanes, class F>
  void with(const Points<Dim>& points, const Lanes& p, F&& f) const {
    const auto unit = Basis::Cell::unit(local_coordinates<Basis>(place_.cell(), points, p));
    const auto inverse = place_.inverse_jacobian(unit);
    const auto s_of = make_array<Dim>([&](auto d) { return OfPoints<Basis>(unit[d]); });
    const auto I_of = make_array<Dim * Dim>([&](auto i) { return OfPoints<Basis>(inverse[i / Dim][i % Dim]); });
    f([&](int l) {
      const auto s = make_array<Dim>([&](auto d) { return s_of[d].of(l); });
      const auto I = make_array<Dim * Dim>([&](auto i) { return I_of[i].of(l); });
      Shapes<Basis> at;
      repeat<nodal_batches<Basis>>([&](auto b) {
        std::array<W, Dim> factor, others;
        repeat<Dim>([&](auto d) { factor[d] = fma(factor_.b[d][b], s[d], factor_.a[d][b]); });
        at.N[b] = products(factor, others);
        repeat<Dim>([&](auto d) { others[d] *= factor_.b[d][b]; });  // dN_i/ds_d
        repeat<Dim>([&](auto j) {
          at.B[j][b] = others[0] * I[j];
          repeat<Dim - 1>([&](auto d) { at.B[j][b] = fma(others[d + 1], I[(d + 1) * Dim + j], at.B[j][b]); });
        });
      });
      return at;
    });
  }

 private:
  BoxPlace<Basis> place_;
  detail::Factors<Basis> factor_;
};

/// N_i = N_i(x_0) + B_i (x − x_0)
template <class Basis>
requires(Basis::nodes == Basis::dim + 1) class ShapesAtPoints<Basis> {
  static constexpr int Dim = Basis::dim;
  using W = Wide<Basis>;

 public:
  explicit ShapesAtPoints(const typename Basis::Cell& cell) : cell_(cell) {
    const auto& B = cell.constant_gradients();
    first_ = for_each_point<Basis>(nodal<Basis>([](int i) { return i == 0 ? 1.0 : 0.0; }));
    repeat<Dim>([&](auto d) { B_[d] = for_each_point<Basis>(nodal<Basis>([&](int i) { return B[i][d]; })); });
  }

  template <class Lanes, class F>
  void with(const Points<Dim>& points, const Lanes& p, F&& f) const {
    const auto x = make_array<Dim>([&](auto d) { return of_points<Basis>(p, points.x[d]); });
    f([&](int l) {
      Shapes<Basis> at{first_, B_};
      repeat<Dim>([&](auto d) {
        const W offset = x[d].of(l) - W(cell_.low()[d]);
        repeat<nodal_batches<Basis>>([&](auto b) { at.N[b] = fma(offset, at.B[d][b], at.N[b]); });
      });
      return at;
    });
  }

 private:
  const typename Basis::Cell& cell_;
  WideNodal<Basis> first_;
  std::array<WideNodal<Basis>, Dim> B_;
};

template <int Dim>
requires(SplineFunctions<GridSpline<Dim>, Wide<GridSpline<Dim>>>::possible) class ShapesAtPoints<GridSpline<Dim>> {
  using Basis = GridSpline<Dim>;
  using W = Wide<Basis>;

 public:
  explicit ShapesAtPoints(const typename Basis::Cell& cell)
      : cell_(cell), along_(make_array<Dim>([&](auto d) { return SplineFunctions<Basis, W>(cell, d); })) {}

  template <class Lanes, class F>
  void with(const Points<Dim>& points, const Lanes& p, F&& f) const {
    const auto s = cell_.local(load_all(points.x, p));
    const auto s_of = make_array<Dim>([&](auto d) { return OfPoints<Basis>(s[d]); });
    f([&](int l) {
      std::array<W, Dim> value, slope;
      repeat<Dim>([&](auto d) { along_[d].at(s_of[d].of(l), value[d], slope[d]); });
      Shapes<Basis> at;
      repeat<nodal_batches<Basis>>([&](auto b) {
        std::array<W, Dim> factor, others;
        repeat<Dim>([&](auto d) { factor[d] = of_nodes<Basis, d, b>(value[d]); });
        at.N[b] = products(factor, others);
        repeat<Dim>([&](auto d) { at.B[d][b] = of_nodes<Basis, d, b>(slope[d]) * others[d]; });
      });
      return at;
    });
  }

 private:
  const typename Basis::Cell& cell_;
  std::array<SplineFunctions<Basis, W>, Dim> along_;
};

}  // namespace scarp::transfer
