// Elements that meet share the nodes of the line or face where they do: nothing else carries stress across it.
#pragma once

#include <vector>

#include "scarp/mesh/gmsh/contents.hpp"
#include "scarp/mesh/gmsh/sides.hpp"

namespace scarp::gmsh {

/// Throws where elements lie at an outer side of another one (a side of no second element): they meet there without
/// sharing its nodes, or overlap. Outer sides are what bounds the places where a mesh covers the plane (or space)
/// twice, and what two parts have between them that were never made one; so it is enough to look right outside and
/// inside of each at some places. "Right outside" is 1e-5 of the element's height from the middle of the side, and
/// less near its ends: slits that are open by more than this are none of it, nor is what meets in a corner only.
///
/// Sides as sorted_sides() gives them; elements as in the mesh. O(n log n).
template <int Dim>
void check_joints(const Scanner& file, const std::vector<Element>& elements, const Mesh<Dim>& mesh,
                  const std::vector<Side>& sides);

}  // namespace scarp::gmsh
