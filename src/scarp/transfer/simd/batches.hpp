// Batches of what belongs to the nodes of an element: a node in each lane, or the components of a node side by side.
#pragma once

#include <array>
#include <cstddef>

#include <type_traits>
#include <utility>

#include "scarp/tensor/batch.hpp"

/// Before a function: all that it calls becomes part of it, so that what it works on stays in registers. Sanitizers
/// would make of that more code than a compiler takes in minutes.
#if defined(__SANITIZE_ADDRESS__)
#define SCARP_FLATTEN
#else
#define SCARP_FLATTEN [[gnu::flatten]]
#endif

namespace scarp {

/// f(0), ..., f(n − 1), with numbers known when compiling: what is indexed by them may live in registers (g++ places
/// arrays before it unrolls loops).
template <int n, class F>
inline void repeat(F&& f) {
  [&]<int... i>(std::integer_sequence<int, i...>) {
    (f(std::integral_constant<int, i>{}), ...);
  }
  (std::make_integer_sequence<int, n>());
}

/// {f(0), ..., f(n − 1)}, likewise.
template <int n, class F>
inline auto make_array(F&& f) {
  return [&]<int... i>(std::integer_sequence<int, i...>) {
    return std::array<decltype(f(std::integral_constant<int, 0>{})), n>{f(std::integral_constant<int, i>{})...};
  }
  (std::make_integer_sequence<int, n>());
}

/// n doubles side by side as numbers of one kind, in as many batches as it takes: the components of a node's vectors.
template <int n>
using Row = std::array<typename detail::SizedBatch<(n <= 4 ? 4 : 8)>::type,
                       (n + detail::SizedBatch<(n <= 4 ? 4 : 8)>::type::size - 1) /
                           detail::SizedBatch<(n <= 4 ? 4 : 8)>::type::size>;

/// Number of doubles of a Row, those behind the last of the n included.
template <int n>
inline constexpr int row_size = static_cast<int>(sizeof(Row<n>) / sizeof(double));

/// A batch for numbers of an element's K local nodes, a node in each lane.
template <int Dim, int K>
using NodeBatch = typename detail::SizedBatch<(K <= 4 ? 4 : 1 << Dim)>::type;

/// A number of each of K local nodes, in as many batches as it takes; what is in lanes behind the last node counts for
/// nothing.
template <int Dim, int K>
using AtNodes = std::array<NodeBatch<Dim, K>, (K + NodeBatch<Dim, K>::size - 1) / NodeBatch<Dim, K>::size>;

/// f(l) in lane l. Not through memory, where what is stored piece by piece cannot be loaded at once before it has all
/// reached the cache.
template <class T, class F>
inline T from_lanes(F&& f) {
#if defined(__AVX512F__)
  if constexpr (T::size == 8) return T(_mm512_set_pd(f(7), f(6), f(5), f(4), f(3), f(2), f(1), f(0)));
#endif
#if defined(__AVX__)
  if constexpr (T::size == 4) return T(_mm256_set_pd(f(3), f(2), f(1), f(0)));
#endif
  double lanes[T::size];
  for (int l = 0; l < static_cast<int>(T::size); ++l) lanes[l] = f(l);
  return T::load_unaligned(lanes);
}

/// Lane j of rows[i] becomes lane i of rows[j].
template <class T>
inline void transpose(std::array<T, T::size>& rows) {
#if defined(__AVX512F__)
  if constexpr (T::size == 8) {
    std::array<T, 8> pair;  // lanes of two rows in turn: even ones, odd ones
    for (std::size_t i = 0; i < 8; i += 2) {
      pair[i] = T(_mm512_unpacklo_pd(rows[i], rows[i + 1]));
      pair[i + 1] = T(_mm512_unpackhi_pd(rows[i], rows[i + 1]));
    }
    for (std::size_t odd = 0; odd < 2; ++odd) {
      const __m512d a = _mm512_shuffle_f64x2(pair[odd], pair[odd + 2], 0x88),
                    b = _mm512_shuffle_f64x2(pair[odd], pair[odd + 2], 0xdd),
                    c = _mm512_shuffle_f64x2(pair[odd + 4], pair[odd + 6], 0x88),
                    d = _mm512_shuffle_f64x2(pair[odd + 4], pair[odd + 6], 0xdd);
      rows[odd] = T(_mm512_shuffle_f64x2(a, c, 0x88));
      rows[odd + 2] = T(_mm512_shuffle_f64x2(b, d, 0x88));
      rows[odd + 4] = T(_mm512_shuffle_f64x2(a, c, 0xdd));
      rows[odd + 6] = T(_mm512_shuffle_f64x2(b, d, 0xdd));
    }
    return;
  }
#endif
#if defined(__AVX__)
  if constexpr (T::size == 4) {
    const __m256d a = _mm256_unpacklo_pd(rows[0], rows[1]), b = _mm256_unpackhi_pd(rows[0], rows[1]),
                  c = _mm256_unpacklo_pd(rows[2], rows[3]), d = _mm256_unpackhi_pd(rows[2], rows[3]);
    rows[0] = T(_mm256_permute2f128_pd(a, c, 0x20));
    rows[1] = T(_mm256_permute2f128_pd(b, d, 0x20));
    rows[2] = T(_mm256_permute2f128_pd(a, c, 0x31));
    rows[3] = T(_mm256_permute2f128_pd(b, d, 0x31));
    return;
  }
#endif
  double lanes[T::size][T::size];
  for (std::size_t i = 0; i < T::size; ++i) rows[i].store_unaligned(lanes[i]);
  for (std::size_t i = 0; i < T::size; ++i) {
    double rotated[T::size];
    for (std::size_t j = 0; j < T::size; ++j) rotated[j] = lanes[j][i];
    rows[i] = T::load_unaligned(rotated);
  }
}

/// sums[accumulator[l] * n + q] += lane l of values[q], for the first `count` lanes l and each q < n.
template <int count, class T, std::size_t n>
inline void add_to_accumulators(const std::array<T, n>& values, const int* accumulator, double* sums) {
  constexpr int W = static_cast<int>(T::size), N = static_cast<int>(n);
  const auto at = [&](int l) { return sums + static_cast<std::size_t>(accumulator[l]) * n; };
#if defined(__AVX512F__)
  if constexpr (W == 8 && N == 4) {  // as two halves
    using Half = typename detail::SizedBatch<4>::type;
    std::array<Half, n> low, high;
    repeat<N>([&](auto q) {
      low[q] = Half(_mm512_castpd512_pd256(values[q]));
      high[q] = Half(_mm512_extractf64x4_pd(values[q], 1));
    });
    add_to_accumulators<(count < 4 ? count : 4)>(low, accumulator, sums);
    add_to_accumulators<(count < 4 ? 0 : count - 4)>(high, accumulator + 4, sums);
    return;
  }
#endif
#if defined(__AVX__)
  if constexpr (W == 4 && N == 2) {
    const __m256d even = _mm256_unpacklo_pd(values[0], values[1]), odd = _mm256_unpackhi_pd(values[0], values[1]);
    const auto add = [&](int l, const __m128d& pair) { _mm_storeu_pd(at(l), _mm_add_pd(_mm_loadu_pd(at(l)), pair)); };
    if constexpr (count > 0) add(0, _mm256_castpd256_pd128(even));
    if constexpr (count > 1) add(1, _mm256_castpd256_pd128(odd));
    if constexpr (count > 2) add(2, _mm256_extractf128_pd(even, 1));
    if constexpr (count > 3) add(3, _mm256_extractf128_pd(odd, 1));
    return;
  }
#endif
  constexpr int whole = N / W * W;
  repeat<N / W>([&](auto group) {
    std::array<T, T::size> rows;
    repeat<W>([&](auto q) { rows[q] = values[group * W + q]; });
    transpose(rows);
    repeat<count>([&](auto l) {
      double* to = at(l) + group * W;
      (T::load_unaligned(to) + rows[l]).store_unaligned(to);
    });
  });
  for (int q = whole; q < N; ++q) {
    double lanes[T::size];
    values[q].store_unaligned(lanes);
    for (int l = 0; l < count; ++l) at(l)[q] += lanes[l];
  }
}

}  // namespace scarp
