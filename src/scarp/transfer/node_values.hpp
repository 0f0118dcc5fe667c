// What a node has for the points of its elements, as numbers beside each other.
#pragma once

#include <array>
#include <bit>

#include "scarp/transfer/simd/batches.hpp"

namespace scarp::transfer {

/// What moves the points, of each node: c_i, by which their velocity changes (eq. 6; step.cpp), and du_i = v_i dt
/// (eq. 16), beside each other. Whole rows, so that they may be loaded as such.
template <int Dim>
struct alignas(8 * std::bit_ceil(unsigned{row_size<2 * Dim>})) Motion {
  std::array<double, row_size<2 * Dim>> row{};

  double& dv(int j) { return row[j]; }
  double& du(int j) { return row[Dim + j]; }
  double dv(int j) const { return row[j]; }
  double du(int j) const { return row[Dim + j]; }
};

/// Numbers side by side for n components of a node in the accumulators of the assembly: 2, 4 or 8.
template <int n>
inline constexpr int accumulator_size = static_cast<int>(std::bit_ceil(unsigned{n}));
/// The most that a step puts there: changes of velocity of two kinds.
template <int Dim>
inline constexpr int momentum_size = accumulator_size<2 * Dim>;

/// n components of each local node of an element: where their rows are. A row may be read to its whole row_size<n>.
template <class Basis>
using NodeRows = std::array<const double*, Basis::nodes>;

}  // namespace scarp::transfer
