// Plane polygons: area, centroid, containment, clipping, validity. No physics.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "scarp/base/vec.hpp"

namespace scarp {

/// Corners in order, not repeated at the end; either orientation.
using Polygon = std::vector<Vec<2>>;

struct Moments {
  double area = 0;  ///< positive for either orientation of the polygon
  Vec<2> centroid{};
};

/// Area and centroid; exact to round-off (coordinates are taken relative to the first corner).
Moments moments(std::span<const Vec<2>> polygon);

/// Is the point inside or on the edge (within round-off)?
bool contains(std::span<const Vec<2>> polygon, const Vec<2>& point);

/// Distance of a point, inside or outside, from the nearest edge.
double distance_from_edges(std::span<const Vec<2>> polygon, const Vec<2>& point);

/// The part of `polygon` (any simple polygon) inside the axis-aligned box low..high. Pieces may be joined by
/// edges of no width along the box, which change neither area nor centroid.
Polygon clip_to_box(std::span<const Vec<2>> polygon, const Vec<2>& low, const Vec<2>& high);

/// Two edges (numbered by their first corner) that cross or touch where they should not, if any; repeated corners
/// and edges that fold back count.
std::optional<std::pair<std::size_t, std::size_t>> self_crossing(std::span<const Vec<2>> polygon);

/// Heights at which the vertical line at x enters and leaves the polygon: ascending pairs [low, high].
std::vector<std::array<double, 2>> vertical_cuts(std::span<const Vec<2>> polygon, double x);

Box bounds(std::span<const Vec<2>> polygon);

}  // namespace scarp
