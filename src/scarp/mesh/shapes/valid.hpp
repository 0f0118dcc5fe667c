// Whether the trilinear map of a hexahedron is one to one.
#pragma once

#include "scarp/mesh/shapes.hpp"

namespace scarp {

/// Is det dx/dxi positive throughout the hexahedron, not at its corners only, by 1e-6 of the cube of half its longest
/// edge? The determinant is of second degree in each local coordinate; its 27 Bernstein coefficients bound it from both
/// sides, on parts of the element that are halved until they decide (Johnen, Remacle and Geuzaine, Geometrical validity
/// of curvilinear finite elements, J. Comput. Phys. 233 (2013) 359). What five halvings leave open counts as not
/// positive.
bool positive_throughout(const NodePositions<H8>& x_nodes);

}  // namespace scarp
