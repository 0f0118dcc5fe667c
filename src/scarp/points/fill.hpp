// Filling regions with material points, before and independent of any mesh: the report's first contribution.
#pragma once

#include <optional>
#include <vector>

#include "scarp/base/polygon.hpp"

namespace scarp {

/// Material points of a region: positions [m] and volumes [m3 per metre of thickness].
struct Filling {
  std::vector<Vec<2>> position;
  std::vector<double> volume;
};

/// A cell with less than this share of its full area gives its soil to a neighbouring cell's point.
inline constexpr double least_cell_share = 0.3;

/// Fills a simple polygon with points `spacing` apart [m]: a lattice divides its bounding box evenly, as near to the
/// spacing as whole numbers allow; each lattice cell that meets the polygon gives a point at the centroid of what it
/// shares with the polygon, with that area as its volume. The volumes add up to the polygon's area and their first
/// moments to its centroid, to round-off. Small shares join the point of a neighbouring cell. Row by row from the
/// bottom; at least one point, whatever the spacing.
Filling fill(const Polygon& polygon, double spacing);

/// A point of another region's filling that lies inside `polygon`, further from its edges than round-off; if any.
std::optional<Vec<2>> overlap(const Polygon& polygon, const Filling& other);

}  // namespace scarp
