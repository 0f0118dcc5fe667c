// Quadratic B-splines in the lanes of their nodes.
#pragma once

#include <array>

#include "scarp/mesh/grid_bases.hpp"
#include "scarp/transfer/simd/node_lanes.hpp"

namespace scarp::transfer {

namespace detail {

/// The three functions of a cell along an axis as c_0 + c_1 s + c_2 s² (mesh/grid_bases.hpp), side by side in each four
/// of eight lanes: of a cell inside, the first, the last, and the only one.
struct SplineTable {
  using Coefficient = std::array<double, 8>;
  std::array<std::array<Coefficient, 3>, 4> of{};

  constexpr SplineTable() {
    for (int cell = 0; cell < 4; ++cell) {
      const double a = cell & 1 ? 1.0 : 0.5, b = cell & 2 ? 1.0 : 0.5;
      const double c[3][3] = {{a, 1 - a, 0}, {-2 * a, 2 * a, 0}, {a, -a - b, b}};
      for (int k = 0; k < 3; ++k) {
        for (int lane = 0; lane < 8; ++lane) of[cell][k][lane] = lane % 4 < 3 ? c[k][lane % 4] : 0;
      }
    }
  }
};
alignas(64) inline constexpr SplineTable spline_table;

}  // namespace detail

/// The factors of the functions of a cell's nodes along axis d. T has the nodes of one point in its lanes, or of two;
/// it has four lanes at least.
template <class Basis, class T>
class SplineFunctions {
 public:
  static constexpr bool possible = lanes_of<T> >= 4;

  SplineFunctions(const typename Basis::Cell& cell, int d)
      : c_(detail::spline_table.of[cell.first(d) | cell.last(d) << 1].data()), per_spacing_(cell.inverse()[d]) {}

  /// At s; and their derivatives [1/m].
  void at(const T& s, T& value, T& slope) const {
    const T c1 = c(1), c2s = c(2) * s;
    value = fma(c1 + c2s, s, c(0));
    slope = fma(T(2.0), c2s, c1) * T(per_spacing_);
  }
  /// Their means over the cell.
  void mean(T& value, T& slope) const {
    value = fma(T(1.0 / 3), c(2), fma(T(1.0 / 2), c(1), c(0)));
    slope = (c(1) + c(2)) * T(per_spacing_);
  }

 private:
  T c(int k) const { return T::load_aligned(c_[k].data()); }

  const detail::SplineTable::Coefficient* c_;
  double per_spacing_;
};

/// From the functions along axis d, three in each four lanes, to batch b of the nodes' lanes.
template <class Basis, int d, int b, class T>
inline T of_nodes(const T& along) {
  constexpr int W = lanes_of<Lane<Basis>>;
  constexpr auto from = [](int lane) { return (b * W + lane) / scarp::detail::power(Basis::each, d) % Basis::each; };
  [[maybe_unused]] constexpr int four = from(0) | from(1) << 2 | from(2) << 4 | from(3) << 6;
#if defined(__AVX512F__)
  if constexpr (W == 8) {
    return T(_mm512_permutexvar_pd(
        _mm512_set_epi64(from(7), from(6), from(5), from(4), from(3), from(2), from(1), from(0)), along));
  } else if constexpr (T::size == 8) {
    return T(_mm512_permutex_pd(along, four));
  }
#endif
#if defined(__AVX2__)
  if constexpr (T::size == 4) return T(_mm256_permute4x64_pd(along, four));
#endif
  return from_lanes<T>([&](int lane) { return along.get(static_cast<std::size_t>(from(lane))); });
}

}  // namespace scarp::transfer
