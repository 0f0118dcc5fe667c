// The local nodes of a point in the lanes of a batch, or of two points where the registers hold as many: what sums over
// points work on.
#pragma once

#include <array>
#include <tuple>

#include "scarp/mesh/basis.hpp"
#include "scarp/points/lanes.hpp"
#include "scarp/points/points.hpp"
#include "scarp/transfer/simd/batches.hpp"

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

/// How many points have their nodes in one batch: two where their lanes are half of a register.
template <class Basis>
inline constexpr int points_at_once = batch_lanes == 8 && lanes_of<Lane<Basis>> == 4 ? 2 : 1;

/// The lanes of so many points: those of the first point's nodes, then those of the second's.
template <class Basis>
using Wide = std::conditional_t<points_at_once<Basis> == 2, Batch, Lane<Basis>>;
template <class Basis>
using WideNodal = std::array<Wide<Basis>, static_cast<std::size_t>(nodal_batches<Basis>)>;

/// Sets sums to zero.
template <class Basis>
inline void clear(WideNodal<Basis>& sum) {
  repeat<nodal_batches<Basis>>([&](auto b) { sum[b] = Wide<Basis>(0.0); });
}

/// The points' parts added up.
template <class Basis>
inline Lane<Basis> folded(const Wide<Basis>& x) {
  if constexpr (points_at_once<Basis> == 2) {
#if defined(__AVX512F__)
    return Lane<Basis>(_mm512_castpd512_pd256(x)) + Lane<Basis>(_mm512_extractf64x4_pd(x, 1));
#endif
  } else {
    return x;
  }
}

/// The same for both points.
template <class Basis>
inline Wide<Basis> for_each_point(const Lane<Basis>& first, [[maybe_unused]] const Lane<Basis>& second) {
  if constexpr (points_at_once<Basis> == 2) {
#if defined(__AVX512F__)
    return Wide<Basis>(_mm512_insertf64x4(_mm512_castpd256_pd512(first), second, 1));
#endif
  } else {
    return first;
  }
}
template <class Basis>
inline Wide<Basis> for_each_point(const Lane<Basis>& both) {
  return for_each_point<Basis>(both, both);
}

template <class Basis>
inline WideNodal<Basis> for_each_point(const Nodal<Basis>& both) {
  return make_array<nodal_batches<Basis>>([&](auto b) { return for_each_point<Basis>(both[b]); });
}

/// The parts of all points added up.
template <class Basis>
inline Nodal<Basis> total(const WideNodal<Basis>& sum) {
  Nodal<Basis> all;
  repeat<nodal_batches<Basis>>([&](auto b) { all[b] = folded<Basis>(sum[b]); });
  return all;
}
template <class Basis, std::size_t n>
inline std::array<Nodal<Basis>, n> totals(const std::array<WideNodal<Basis>, n>& sums) {
  std::array<Nodal<Basis>, n> all;
  repeat<static_cast<int>(n)>([&](auto j) { all[j] = total<Basis>(sums[j]); });
  return all;
}

/// A number of each point of a batch, to be had in the lanes of these points' nodes: of(l) for point l (and l + 1).
template <class Basis>
class OfPoints {
  using T = PointBatch<Basis::dim>;
  static constexpr bool in_register = points_at_once<Basis> == 2;

 public:
  explicit OfPoints(const T& all) {
    if constexpr (in_register) {
      all_ = all;
    } else {
      all.store_aligned(all_.data());
    }
  }

  Wide<Basis> of(int l) const {
    if constexpr (in_register) {
#if defined(__AVX512F__)
      const __m512i from = _mm512_add_epi64(_mm512_set1_epi64(l), _mm512_set_epi64(1, 1, 1, 1, 0, 0, 0, 0));
      if constexpr (T::size == 4) return Batch(_mm512_permutexvar_pd(from, _mm512_castpd256_pd512(all_)));
      if constexpr (T::size == 8) return Batch(_mm512_permutexvar_pd(from, all_));
#endif
    } else {
      return Wide<Basis>(all_[l]);
    }
  }

 private:
  alignas(64) std::conditional_t<in_register, T, std::array<double, lanes_of<T>>> all_;
};

/// A column at the points of some lanes, left where it is.
template <class Basis, class Lanes>
class InColumn {
 public:
  InColumn(const Lanes& p, const Column& column) : p_(p), column_(column) {}
  Wide<Basis> of(int l) const { return Wide<Basis>(column_[p_.point(l)]); }

 private:
  const Lanes& p_;
  const Column& column_;
};

/// OfPoints of a column, loaded only where it may stay in a register.
template <class Basis, class Lanes>
inline auto of_points(const Lanes& p, const Column& column) {
  if constexpr (points_at_once<Basis> == 2) {
    return OfPoints<Basis>(p.load(column));
  } else {
    return InColumn<Basis, Lanes>(p, column);
  }
}

/// f(l) for the points l of some lanes, as many at once as have their nodes in one batch.
template <class Basis, class Lanes, class F>
inline void for_each_group(const Lanes& p, F&& f) {
  for (int l = 0; l < p.count(); l += points_at_once<Basis>) f(l);
}

/// Π f_d, and for each axis the product of the others.
template <class T>
inline T products(const std::array<T, 2>& f, std::array<T, 2>& others) {
  others = {f[1], f[0]};
  return f[0] * f[1];
}
template <class T>
inline T products(const std::array<T, 3>& f, std::array<T, 3>& others) {
  const T xy = f[0] * f[1];
  others = {f[1] * f[2], f[0] * f[2], xy};
  return xy * f[2];
}

/// The number of local node (i + k) mod K in the place of node i, for every node i of each point; 0 ≤ k < K.
template <int K, int k, class T, std::size_t n>
inline std::array<T, n> rotated(const std::array<T, n>& x) {
  constexpr int W = lanes_of<T>;
  if constexpr (k == 0) return x;
  [[maybe_unused]] constexpr int four = k % 4 | (1 + k) % 4 << 2 | (2 + k) % 4 << 4 | (3 + k) % 4 << 6,
                                 three = k % 3 | (1 + k) % 3 << 2 | (2 + k) % 3 << 4 | 3 << 6;
#if defined(__AVX512F__)
  if constexpr (W == 8 && K <= 4) return {T(_mm512_permutex_pd(x[0], K == 3 ? three : four))};
  if constexpr (W == 8 && K == 8) {
    const __m512i from = _mm512_set_epi64((7 + k) % 8, (6 + k) % 8, (5 + k) % 8, (4 + k) % 8, (3 + k) % 8, (2 + k) % 8,
                                          (1 + k) % 8, k % 8);
    return {T(_mm512_permutexvar_pd(from, x[0]))};
  }
#endif
#if defined(__AVX2__)
  if constexpr (W == 4 && K <= 4) return {T(_mm256_permute4x64_pd(x[0], K == 3 ? three : four))};
  if constexpr (W == 4 && K == 8) {  // each four from two batches: the first k mod 4 of the one behind, and the others
    const auto part = [&](int b) {
      return T(_mm256_permute4x64_pd(_mm256_blend_pd(x[b], x[1 - b], (1 << k % 4) - 1), four));
    };
    return {part(k / 4), part(1 - k / 4)};
  }
#endif
  double lanes[n * T::size], moved[n * T::size] = {};
  for (std::size_t b = 0; b < n; ++b) x[b].store_unaligned(lanes + b * W);
  for (int i = 0; i < K; ++i) moved[i] = lanes[(i + k) % K];
  std::array<T, n> y;
  for (std::size_t b = 0; b < n; ++b) y[b] = T::load_unaligned(moved + b * W);
  return y;
}

}  // namespace scarp::transfer
