// Sums over a filling, without the round-off of summing.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <type_traits>

#include "scarp/points/fill.hpp"

namespace scarp::test {

/// Neumaier's compensated sum: a test of round-off cannot have its own.
struct Sum {
  double sum = 0, rest = 0;
  void add(double x) {
    const double t = sum + x;
    rest += std::abs(sum) >= std::abs(x) ? (sum - t) + x : (x - t) + sum;
    sum = t;
  }
  double value() const { return sum + rest; }
};

template <int Dim>
struct Totals {
  double volume = 0;
  Vec<Dim> centroid{};
};

/// Volume, and centroid from first moments about `origin`.
template <int Dim>
Totals<Dim> totals(const FillingOf<Dim>& filling, const std::type_identity_t<Vec<Dim>>& origin) {
  Sum volume;
  std::array<Sum, Dim> first;
  for (std::size_t i = 0; i < filling.volume.size(); ++i) {
    volume.add(filling.volume[i]);
    for (int j = 0; j < Dim; ++j) first[j].add(filling.volume[i] * (filling.position[i][j] - origin[j]));
  }
  Totals<Dim> result{volume.value(), {}};
  for (int j = 0; j < Dim; ++j) result.centroid[j] = origin[j] + first[j].value() / result.volume;
  return result;
}

}  // namespace scarp::test
