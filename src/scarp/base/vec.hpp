// A point or vector in Dim-dimensional space.
#pragma once

#include <array>

namespace scarp {

template <int Dim>
using Vec = std::array<double, Dim>;

}  // namespace scarp
