// Background meshes made by Gmsh.
#pragma once

#include <string>

#include "scarp/mesh/mesh.hpp"

namespace scarp {

/// Reads a mesh from a Gmsh file of version 2.2 or 4.1, ASCII or binary, in metres: of 3-node triangles and 4-node
/// quadrilaterals (also mixed) at z = 0 in the plane, of 4-node tetrahedra and 8-node hexahedra in space. These may be
/// mixed too, where they do not meet across a face.
///
/// Elements are turned anticlockwise (to a positive volume) and numbered along a space-filling curve, nodes by their
/// first use (those that no element uses are dropped), so a mesh has the same numbers from every format. Physical
/// groups of points and lines (and surfaces, in space) become node sets under the group's name (or its number, when it
/// has none); the sides of the bounding box (add_side_sets) are added unless a group has that name. Physical groups of
/// the mesh's own elements are not kept.
///
/// Throws InputError, with the line of an ASCII file or the byte of a binary one, when the file is missing, cut short
/// or damaged, holds other elements, elements of volumes where a plane mesh is asked for or none where one of space is,
/// or elements that have no area or volume, are not convex, are twisted, overlap, or meet without sharing nodes.
template <int Dim = 2>
Mesh<Dim> read_gmsh(const std::string& path);

/// The same from the bytes of such a file; `name` stands for it in errors.
template <int Dim = 2>
Mesh<Dim> parse_gmsh(const std::string& name, std::string bytes);

}  // namespace scarp
