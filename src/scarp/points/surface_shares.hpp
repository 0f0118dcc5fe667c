// What the cells of a lattice share with the solid inside a surface.
#pragma once

#include "scarp/base/surface.hpp"
#include "scarp/points/lattice.hpp"

namespace scarp {

/// Shares below this part of a cell are round-off.
inline constexpr double negligible_share = 1e-13;

/// Sets the share of every cell of a lattice over the surface's bounding box.
///
/// Over a point (x, y) of the plan, the solid's length between the heights a and b is the sum, over the surface's
/// crossings of the vertical there, of ±(min(max(z, a), b) - a), + where the surface faces up. So each triangle is cut
/// along the lattice's planes, and each piece gives the volume below it to its own cell, with the sign of its upward
/// normal, and its area in plan times the height of the cell to every cell below. Only the pieces are looked at, not
/// the cells; no face has to be closed and no side decided. What pieces give to neighbouring cells cancels or adds up
/// to round-off, and the sum over all cells is the divergence theorem for the whole solid.
///
/// Throws InputError where a cell's share is not between nothing and the whole cell: the surface passes through itself.
void find_shares(const Surface& surface, Lattice<3>& lattice);

}  // namespace scarp
