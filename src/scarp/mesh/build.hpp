// What a mesh of lists needs beside its nodes and connectivity: neighbours, sizes, sides. Shared by all that make one.
// And what any mesh says of itself as a whole.
#pragma once

#include <array>

#include "scarp/base/vec.hpp"

#include "scarp/mesh/mesh.hpp"

namespace scarp {

/// Fills around_offsets and around: for each element the others that share a node with it, ascending.
template <int Dim>
void build_around(Mesh<Dim>& mesh);

/// An element's least height [m]: the shortest way of a wave through it, for the critical time step.
/// Triangle: twice the area over the longest edge. Quadrilateral: the least, over its four corners, of the height of
/// the parallelogram spanned by the corner's two edges, |u x v| / max(|u|, |v|); a rectangle's shorter side.
/// Tetrahedron and hexahedron likewise: the least over the corners of the height of the parallelepiped spanned by the
/// corner's three edges on the largest of its faces; three volumes over the largest face, and a box's shortest side.
double element_size(const Mesh<2>& mesh, int e);
double element_size(const Mesh<3>& mesh, int e);

/// Area of one element [m^2]; negative when its nodes run clockwise.
double element_area(const Mesh<2>& mesh, int e);

/// Volume of one element [m^3], that of the trilinear map for a hexahedron; negative when it is turned inside out.
double element_volume(const Mesh<3>& mesh, int e);

/// Sum of the areas of all elements [m^2].
double mesh_area(const Mesh<2>& mesh);

/// Sum of the volumes of all elements [m^3].
double mesh_volume(const Mesh<3>& mesh);

/// The least Mesh::size_of of all elements [m].
template <int Dim>
double least_size(const Mesh<Dim>& mesh);

/// The box around all nodes.
template <int Dim>
BoxOf<Dim> bounds(const Mesh<Dim>& mesh);

/// The largest magnitude of a coordinate of a node [m].
template <int Dim>
double largest_coordinate(const Mesh<Dim>& mesh);

/// A side of the box around a mesh: the least along an axis, or the greatest.
struct BoxSide {
  const char* name;
  int axis;
  bool last;
};
template <int Dim>
inline constexpr std::array<BoxSide, 2 * Dim> sides_of_box;
template <>
inline constexpr std::array<BoxSide, 4> sides_of_box<2>{
    {{"left", 0, false}, {"right", 0, true}, {"bottom", 1, false}, {"top", 1, true}}};
template <>
inline constexpr std::array<BoxSide, 6> sides_of_box<3>{{{"left", 0, false},
                                                         {"right", 0, true},
                                                         {"bottom", 2, false},
                                                         {"top", 2, true},
                                                         {"front", 1, false},
                                                         {"back", 1, true}}};

/// Adds the node sets of the sides (nodes within 1e-9 of the extent of that side of the bounding box), except those
/// that exist already: "left" and "right" along x, "bottom" and "top" along the vertical (y in the plane, z in space),
/// and in space "front" (least) and "back" (greatest) along y.
template <int Dim>
void add_side_sets(Mesh<Dim>& mesh);

/// Neighbours, sizes and sides of a mesh of lists whose nodes, types, offsets and connectivity are set.
template <int Dim>
void complete(Mesh<Dim>& mesh);

}  // namespace scarp
