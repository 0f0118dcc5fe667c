// What every mesh needs beside its nodes and connectivity: neighbours, sizes, sides. Shared by all mesh makers.
#pragma once

#include "scarp/mesh/mesh.hpp"

namespace scarp {

/// Fills around_offsets and around: for each element the others that share a node with it, ascending.
template <int Dim>
void build_around(Mesh<Dim>& mesh);

/// An element's least height [m]: the shortest way of a wave through it, for the critical time step.
/// Triangle: twice the area over the longest edge. Quadrilateral: the least, over its four corners, of the height of
/// the parallelogram spanned by the corner's two edges, |u x v| / max(|u|, |v|); a rectangle's shorter side.
double element_size(const Mesh<2>& mesh, int e);

/// Area of one element [m^2]; negative when its nodes run clockwise.
double element_area(const Mesh<2>& mesh, int e);

/// Sum of the areas of all elements [m^2].
double mesh_area(const Mesh<2>& mesh);

/// Adds the node sets "left", "right", "bottom" and "top" (nodes within 1e-9 of the extent of that side of the
/// bounding box), except those that exist already.
void add_side_sets(Mesh<2>& mesh);

/// All of the above for a mesh whose nodes, types, offsets and connectivity are set.
void complete(Mesh<2>& mesh);

}  // namespace scarp
