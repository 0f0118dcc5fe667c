// Local coordinates of a few points in their element.
#pragma once

#include "scarp/mesh/basis.hpp"
#include "scarp/points/lanes.hpp"
#include "scarp/points/points.hpp"

namespace scarp::transfer {

template <class Basis, class T>
inline std::array<T, Basis::dim> local_coordinates(const typename Basis::Cell& cell, const Points<Basis::dim>& points,
                                                   const Lanes<T>& lanes) {
  std::array<T, Basis::dim> at;
  const auto& columns = Basis::stores_local ? points.xi : points.x;
  for (int j = 0; j < Basis::dim; ++j) at[j] = lanes.load(columns[j]);
  if constexpr (Basis::stores_local) {
    return at;
  } else {
    return cell.local(at);
  }
}

/// Place of component (j, k) of a symmetric tensor among its Mandel components.
constexpr int mandel(int j, int k) {
  return j == k ? j : j + k == 1 ? 3 : j + k == 3 ? 4 : 5;
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

}  // namespace scarp::transfer
