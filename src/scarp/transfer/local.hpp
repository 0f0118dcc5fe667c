// Local coordinates of a few points in their element.
#pragma once

#include "scarp/mesh/basis.hpp"
#include "scarp/points/lanes.hpp"
#include "scarp/points/points.hpp"
#include "scarp/transfer/simd/batches.hpp"

namespace scarp::transfer {

/// Half the edge of a square or cube of the volume that a point started with: the domain of a point of uniform GIMP.
template <int Dim, class T>
inline T half_edge(const T& volume) {
  if constexpr (Dim == 2) {
    return T(0.5) * sqrt(volume);
  } else {
    return T(0.5) * cbrt(volume);
  }
}

/// The components of a vector of some points.
template <std::size_t n, class Lanes>
inline auto load_all(const std::array<Column, n>& columns, const Lanes& lanes) {
  return make_array<static_cast<int>(n)>([&](auto j) { return lanes.load(columns[j]); });
}

/// What the cell's shape() and gradients() take of these points.
template <class Basis, class Points, class Lanes>
inline auto local_coordinates(const typename Basis::Cell& cell, const Points& points, const Lanes& lanes) {
  const auto at = load_all(Basis::stores_local ? points.xi : points.x, lanes);
  if constexpr (Basis::stores_local) {
    return at;
  } else if constexpr (Basis::has_domains) {
    return cell.local(at, half_edge<Basis::dim>(lanes.load(points.initial_volume)));
  } else {
    return cell.local(at);
  }
}

/// Place of component (j, k) of a symmetric tensor among its Mandel components.
constexpr int mandel(int j, int k) {
  return j == k ? j : j + k == 1 ? 3 : j + k == 3 ? 4 : 5;
}

}  // namespace scarp::transfer
