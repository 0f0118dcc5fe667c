// A SIMD batch of doubles: the scalar that laws and mappings run on in the material point method.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <xsimd/xsimd.hpp>

#include "scarp/tensor/scalar.hpp"

namespace scarp {

/// As many doubles as a vector register of the target processor holds.
using Batch = xsimd::batch<double>;
using xsimd::all;
using xsimd::any;

inline constexpr std::size_t batch_lanes = Batch::size;

namespace detail {
template <int Lanes>
struct SizedBatch {
  using type = xsimd::make_sized_batch_t<double, Lanes>;
};
template <int Lanes>
requires(Lanes >= static_cast<int>(batch_lanes)) struct SizedBatch<Lanes> {
  using type = Batch;
};
}  // namespace detail

/// A batch for the points of an element of 2^Dim nodes, which hold that many points as a rule: as many lanes as that,
/// or as the processor has.
template <int Dim>
using PointBatch = typename detail::SizedBatch<(1 << Dim)>::type;

template <class T>
inline constexpr int lanes_of = static_cast<int>(T::size);

/// a b + c
inline double fma(double a, double b, double c) {
  return a * b + c;
}
using xsimd::fma;

/// The bits of the first `count` lanes.
inline constexpr unsigned first_bits(int count) {
  return (1u << count) - 1u;
}

#if defined(__AVX__) && !defined(__AVX512VL__)
namespace detail {
/// All bits of the first `count` of four lanes.
inline __m256i first_lanes(int count) {
  alignas(32) static constexpr std::int64_t bits[8] = {-1, -1, -1, -1, 0, 0, 0, 0};
  return _mm256_loadu_si256(reinterpret_cast<const __m256i*>(bits + 4 - count));
}
}  // namespace detail
#endif

/// The first `count` of a batch's doubles from memory, zero in the others; nothing behind them is touched.
template <class T>
inline T load_first(const double* from, int count) {
  constexpr int W = lanes_of<T>;
#if defined(__AVX512VL__)
  const auto mask = static_cast<__mmask8>(first_bits(count));
  if constexpr (W == 8) return T(_mm512_maskz_loadu_pd(mask, from));
  if constexpr (W == 4) return T(_mm256_maskz_loadu_pd(mask, from));
#elif defined(__AVX__)
  if constexpr (W == 4) return T(_mm256_maskload_pd(from, detail::first_lanes(count)));
#endif
  double lanes[W] = {};
  for (int l = 0; l < count; ++l) lanes[l] = from[l];
  return T::load_unaligned(lanes);
}

/// The first `count` of a batch's doubles to memory.
template <class T>
inline void store_first(const T& value, double* to, int count) {
  constexpr int W = lanes_of<T>;
#if defined(__AVX512VL__)
  const auto mask = static_cast<__mmask8>(first_bits(count));
  if constexpr (W == 8) return _mm512_mask_storeu_pd(to, mask, value);
  if constexpr (W == 4) return _mm256_mask_storeu_pd(to, mask, value);
#elif defined(__AVX__)
  if constexpr (W == 4) return _mm256_maskstore_pd(to, detail::first_lanes(count), value);
#endif
  double lanes[W];
  value.store_unaligned(lanes);
  for (int l = 0; l < count; ++l) to[l] = lanes[l];
}

/// As many doubles as half of a batch has, in both halves.
template <class T>
inline T load_twice(const double* from) {
#if defined(__AVX512F__)
  if constexpr (T::size == 8) return T(_mm512_broadcast_f64x4(_mm256_loadu_pd(from)));
#endif
#if defined(__AVX__)
  if constexpr (T::size == 4) return T(_mm256_broadcast_pd(reinterpret_cast<const __m128d*>(from)));
#endif
  double lanes[T::size];
  for (std::size_t l = 0; l < T::size; ++l) lanes[l] = from[l % (T::size / 2)];
  return T::load_unaligned(lanes);
}

/// Bit l is set where lane l of the mask is.
template <class M>
inline unsigned bits_of(const M& mask) {
#if defined(__AVX512F__)
  if constexpr (M::size == 8) return mask.data;
#endif
#if defined(__AVX__)
  if constexpr (M::size == 4) return static_cast<unsigned>(_mm256_movemask_pd(mask));
#endif
  unsigned bits = 0;
  for (std::size_t l = 0; l < M::size; ++l) bits |= mask.get(l) ? 1u << l : 0u;
  return bits;
}

/// Adds the sum over the lanes of values[i] to out[i], for each i; out has room for whole batches.
template <class T, std::size_t n>
inline void add_lanes(std::array<T, n>& values, double* out) {
  constexpr std::size_t W = T::size;
  static_assert(n % W == 0);
  for (std::size_t i = 0; i < n; i += W)
    (xsimd::haddp(values.data() + i) + T::load_unaligned(out + i)).store_unaligned(out + i);
}

/// n rounded up to whole batches.
template <class T>
constexpr std::size_t whole_batches(int n) {
  return (static_cast<std::size_t>(n) + T::size - 1) / T::size * T::size;
}

}  // namespace scarp
