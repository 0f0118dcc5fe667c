// What two regions have in common.
#pragma once

#include <optional>

#include "scarp/base/solid.hpp"

namespace scarp {

template <int Dim>
struct Shared {
  Vec<Dim> at{};      ///< a place in both
  double volume = 0;  ///< in common; an area in two dimensions
  double depth = 0;   ///< the volume over the largest extent (in space: the largest face of the box) of what is shared:
                      ///< how far the one reaches into the other, where that is the same all along
};

/// Exact to round-off of polygons: between neighbouring corners and crossings both are stripes with straight ends.
std::optional<Shared<2>> shared_by(const Polygon& a, const Polygon& b);

/// Of solids from 100 × 100 vertical lines through the box that their boxes share.
std::optional<Shared<3>> shared_by(const Solid& a, const Solid& b);

}  // namespace scarp
