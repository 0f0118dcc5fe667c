// What a node receives from the points in step 1.
#pragma once

#include <array>
#include <cstddef>

namespace scarp::transfer {

/// m_i (eq. 1) [Mg], p_i (eq. 2) [Mg m/s] and F_int (eq. 4) [kN] of a node, as numbers beside each other; in space one
/// more that is not used.
template <int Dim>
struct NodeSums {
  static constexpr int mass_at = 0, momentum_at = 1, internal_force_at = 1 + Dim;
  static constexpr int size = Dim == 2 ? 5 : 8;

  std::array<double, size> row{};

  double mass() const { return row[mass_at]; }
  double momentum(int j) const { return row[static_cast<std::size_t>(momentum_at + j)]; }
  double internal_force(int j) const { return row[static_cast<std::size_t>(internal_force_at + j)]; }
};

template <int Dim>
inline constexpr int node_sums = NodeSums<Dim>::size;

}  // namespace scarp::transfer
