// On which side of a line a point lies, without round-off.
#pragma once

#include "scarp/base/vec.hpp"

namespace scarp {

/// +1 where x lies to the left of the line from a to b, -1 to its right, 0 on it: the sign of the exact determinant, so
/// that what is decided for neighbouring triangles fits together.
int side_of_line(const Vec<2>& a, const Vec<2>& b, const Vec<2>& x);

}  // namespace scarp
