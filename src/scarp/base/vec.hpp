// A point or vector in Dim-dimensional space, and boxes along its axes.
#pragma once

#include <array>

namespace scarp {

template <int Dim>
using Vec = std::array<double, Dim>;

/// The box between two opposite corners.
template <int Dim>
struct BoxOf {
  Vec<Dim> low, high;
};
using Box = BoxOf<2>;

}  // namespace scarp
