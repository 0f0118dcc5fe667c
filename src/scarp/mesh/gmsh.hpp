// Background meshes made by Gmsh.
#pragma once

#include <string>

#include "scarp/mesh/mesh.hpp"

namespace scarp {

/// Reads a plane mesh of 3-node triangles and 4-node quadrilaterals (also mixed) from a Gmsh file of version 2.2
/// or 4.1, ASCII or binary, at z = 0, in metres.
///
/// Elements are turned anticlockwise and numbered along a space-filling curve, nodes by their first use (those that no
/// element uses are dropped), so a mesh has the same numbers from every format. Physical groups of points and lines
/// become node sets under the group's name (or its number, when it has none); "left", "right", "bottom" and "top" are
/// the sides of the bounding box unless a group has that name. Physical surfaces are not kept.
///
/// Throws InputError, with the line of an ASCII file or the byte of a binary one, when the file is missing, cut short
/// or damaged, holds other elements, or elements that have no area, are not convex or overlap their neighbours.
Mesh<2> read_gmsh(const std::string& path);

/// The same from the bytes of such a file; `name` stands for it in errors.
Mesh<2> parse_gmsh(const std::string& name, std::string bytes);

}  // namespace scarp
