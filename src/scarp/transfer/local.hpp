// Local coordinates of a few points in their element.
#pragma once

#include <array>
#include <type_traits>

#include "scarp/mesh/basis.hpp"
#include "scarp/points/lanes.hpp"
#include "scarp/points/points.hpp"

namespace scarp::transfer {

/// Half the edge of a square or cube of the volume that a point started with: the domain of a point of uniform GIMP.
template <class T>
inline T half_edge(const T& volume, std::integral_constant<int, 2>) {
  return T(0.5) * sqrt(volume);
}
template <class T>
inline T half_edge(const T& volume, std::integral_constant<int, 3>) {
  return T(0.5) * cbrt(volume);
}

/// What the cell's shape() and gradients() take of these points.
template <class Basis, class T>
inline auto local_coordinates(const typename Basis::Cell& cell, const Points<Basis::dim>& points,
                              const Lanes<T>& lanes) {
  std::array<T, Basis::dim> at;
  const auto& columns = Basis::stores_local ? points.xi : points.x;
  for (int j = 0; j < Basis::dim; ++j) at[j] = lanes.load(columns[j]);
  if constexpr (Basis::stores_local) {
    return at;
  } else if constexpr (Basis::has_domains) {
    const T volume = lanes.load(points.initial_volume);
    return cell.local(at, half_edge(volume, std::integral_constant<int, Basis::dim>{}));
  } else {
    return cell.local(at);
  }
}

/// Place of component (j, k) of a symmetric tensor among its Mandel components.
constexpr int mandel(int j, int k) {
  return j == k ? j : j + k == 1 ? 3 : j + k == 3 ? 4 : 5;
}

}  // namespace scarp::transfer
