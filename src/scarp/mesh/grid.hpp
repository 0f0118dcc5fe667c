// Structured grids of equal rectangles.
#pragma once

#include <array>

#include "scarp/mesh/mesh.hpp"

namespace scarp {

/// A grid of elements[0] x elements[1] four-node rectangles over the box of corner `origin` and lengths `size`
/// [m]; nodes and elements numbered x fastest, with node sets left, right, bottom, top and the grid descriptor.
/// Throws InputError when a length is not positive and finite, a count is below 1, or there are too many elements.
Mesh<2> make_grid(const Vec<2>& origin, const Vec<2>& size, const std::array<int, 2>& elements);

}  // namespace scarp
