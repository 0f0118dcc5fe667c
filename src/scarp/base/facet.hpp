// Pieces of a triangle cut along planes of the axes, and integrals over their projection on the horizontal plane: what
// the exact share of a surface's solid in a box is made of.
#pragma once

#include <array>

#include "scarp/base/vec.hpp"

namespace scarp {

using Triangle = std::array<Vec<3>, 3>;

/// A convex plane polygon in space. A triangle cut to a box has at most 9 corners.
struct Facet {
  std::array<Vec<3>, 10> corner;
  int size = 0;

  Facet() = default;
  explicit Facet(const Triangle& triangle) : size(3) {
    for (int i = 0; i < 3; ++i) corner[i] = triangle[i];
  }
};

/// Cuts `whole` along the plane x[axis] = at; one that lies in the plane is `below`. Facets that share an edge get the
/// same new corner on it to the last bit, so a closed surface stays closed.
void cut(const Facet& whole, int axis, double at, Facet& below, Facet& above);

/// Integrals over the projection of a facet on the plane of x and y, with the sign of its upward normal; x, y and z
/// count from the origin given.
struct FacetMoments {
  double area = 0, x = 0, y = 0;              ///< of 1, x, y
  double z = 0, xz = 0, yz = 0, half_zz = 0;  ///< of z, x z, y z, z²/2: volume and first moments of what is below it
};

/// Exact: the integrands have degree two, as the rule has.
FacetMoments moments(const Facet& facet, const Vec<3>& origin);

}  // namespace scarp
