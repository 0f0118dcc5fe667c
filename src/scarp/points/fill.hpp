// Filling regions with material points, before and independent of any mesh: the report's first contribution.
#pragma once

#include <optional>
#include <vector>

#include "scarp/base/polygon.hpp"
#include "scarp/base/solid.hpp"

namespace scarp {

/// Material points of a region: positions [m] and volumes [m3; in two dimensions per metre of thickness].
template <int Dim>
struct FillingOf {
  std::vector<Vec<Dim>> position;
  std::vector<double> volume;
};
using Filling = FillingOf<2>;

/// A cell with less than this share of its full area or volume gives its soil to a neighbouring cell's point.
inline constexpr double least_cell_share = 0.3;

/// Fills a simple polygon with points `spacing` apart [m]: a lattice divides its bounding box evenly, as near to the
/// spacing as whole numbers allow; each lattice cell that meets the polygon gives a point at the centroid of what it
/// shares with the polygon, with that area as its volume. The volumes add up to the polygon's area and their first
/// moments to its centroid, to round-off. Small shares join the point of a neighbouring cell. Row by row from the
/// bottom; at least one point, whatever the spacing.
Filling fill(const Polygon& polygon, double spacing);

/// The same for a solid. The points of an extruded polygon are those of the polygon, repeated in each layer along its
/// axis. Inside a surface the cells' shares are exact, too: none is sampled. Throws InputError for a surface that
/// passes through itself unnoticed, where a cell would hold less than nothing or more than itself.
FillingOf<3> fill(const Solid& solid, double spacing);

/// A point of another region's filling that lies inside `region`, further from its boundary than round-off; if any.
template <int Dim>
std::optional<Vec<Dim>> overlap(const Region<Dim>& region, const FillingOf<Dim>& other);

}  // namespace scarp
