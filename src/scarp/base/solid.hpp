// Solids in three dimensions: extruded polygons and the insides of closed surfaces; and regions, which are polygons in
// two dimensions and solids in three, under the same names. z points up in three dimensions, y in two.
#pragma once

#include <array>
#include <type_traits>
#include <variant>
#include <vector>

#include "scarp/base/polygon.hpp"
#include "scarp/base/surface.hpp"

namespace scarp {

/// A polygon extruded along one axis. The corners' two coordinates are those of the other axes, in the order x, y, z.
struct Prism {
  Polygon section;
  int axis = 2;
  double low = 0, high = 0;  ///< along the axis; low < high
};

/// The box between two opposite corners: a rectangle of x and y, extruded along z.
Prism make_box(const Vec<3>& low, const Vec<3>& high);

/// The axes of a prism's section.
constexpr std::array<int, 2> section_axes(int axis) {
  return {axis == 0 ? 1 : 0, axis == 2 ? 1 : 2};
}

using Solid = std::variant<Prism, Surface>;

template <int Dim>
using Region = std::conditional_t<Dim == 2, Polygon, Solid>;

BoxOf<3> bounds(const Solid& solid);

/// Inside or on the surface, within round-off?
bool contains(const Solid& solid, const Vec<3>& x);

/// Volume and centroid, exact to round-off.
SolidMoments moments(const Solid& solid);

/// Volume of a region; its area in two dimensions, the volume per metre of thickness.
double volume(const Polygon& polygon);
double volume(const Solid& solid);

/// No further from the boundary of the region than round-off, 1e-9 of its largest length?
bool near_boundary(const Polygon& polygon, const Vec<2>& x);
bool near_boundary(const Solid& solid, const Vec<3>& x);

/// The stretches inside the region of the vertical line through x: ascending pairs [low, high] of heights. Lines along
/// vertical faces belong to the region on one side only.
std::vector<std::array<double, 2>> cuts_through(const Polygon& polygon, const Vec<2>& x);
std::vector<std::array<double, 2>> cuts_through(const Solid& solid, const Vec<3>& x);

}  // namespace scarp
