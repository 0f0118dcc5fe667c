// Local coordinates of a few points in their element.
#pragma once

#include "scarp/mesh/basis.hpp"
#include "scarp/points/lanes.hpp"
#include "scarp/points/points.hpp"
#include "scarp/transfer/batches.hpp"

namespace scarp::transfer {

template <class Basis, class Points, class Lanes>
inline auto local_coordinates(const typename Basis::Cell& cell, const Points& points, const Lanes& lanes) {
  const auto& columns = Basis::stores_local ? points.xi : points.x;
  std::array<decltype(lanes.load(columns[0])), Basis::dim> at;
  repeat<Basis::dim>([&](auto j) { at[j] = lanes.load(columns[j]); });
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

}  // namespace scarp::transfer
