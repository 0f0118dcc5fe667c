// The nodes that a boundary of a case holds.
#pragma once

#include <vector>

#include "scarp/input/case.hpp"
#include "scarp/mesh/mesh.hpp"

namespace scarp::run {

constexpr double round_off = 1e-9;  ///< of a mesh's largest coordinate: nodes this far from a place are there

/// The nodes of a boundary, ascending. Throws InputError for a set that the mesh does not have, and for a place without
/// nodes.
template <int Dim>
std::vector<int> boundary_nodes(const Mesh<Dim>& mesh, const input::BoundaryInput& input);

/// Throws InputError where boundary_nodes() does, and for a line (in space, a flat box) that passes through elements:
/// between its nodes it would hold nothing. To be asked once: it looks at the elements of the mesh.
template <int Dim>
void check_boundary(const Mesh<Dim>& mesh, const input::BoundaryInput& input);

/// A line of text for each boundary: where it is, how many nodes it has and what it does to them.
template <int Dim>
std::vector<std::string> describe_boundaries(const Mesh<Dim>& mesh,
                                             const std::vector<input::BoundaryInput>& boundaries);

}  // namespace scarp::run
