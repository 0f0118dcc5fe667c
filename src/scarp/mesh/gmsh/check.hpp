// Elements as a file gives them: turned the right way, of usable shape, and side by side.
#pragma once

#include <vector>

#include "scarp/mesh/gmsh/contents.hpp"

namespace scarp::gmsh {

/// Turns an element of these nodes round when it is turned inside out as a whole. Throws when it is flat, not convex
/// or twisted: det dx/dxi is positive throughout an element that passes.
template <int Dim>
void check_shape(const Scanner& file, const Element& element, const Mesh<Dim>& mesh, std::vector<int>& nodes);

/// Throws when two elements lie on the same side of one that they share, when a tetrahedron meets a hexahedron
/// across a part of a face, where the displacements of the two would differ, or when elements meet without sharing
/// nodes (check_joints). Elements as in the mesh.
template <int Dim>
void check_sides(const Scanner& file, const std::vector<Element>& elements, const Mesh<Dim>& mesh);

}  // namespace scarp::gmsh
