// The order of elements and nodes in memory.
#pragma once

#include "scarp/mesh/mesh.hpp"

namespace scarp {

/// Renumbers elements along a Hilbert curve through their centres, and nodes by their first use in that order, so that
/// what is near in space is near in memory, whatever order a mesh maker wrote. Node sets follow; neighbours, sizes and
/// sides must not be set yet.
template <int Dim>
void order_along_curve(Mesh<Dim>& mesh);

}  // namespace scarp
