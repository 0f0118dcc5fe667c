// Lines and planes that pass through elements in place of along their edges and faces.
#pragma once

#include <array>
#include <optional>

#include "scarp/mesh/mesh.hpp"

namespace scarp::run {

/// How near to a segment [m] a node lies on it, and an element's edge along it.
double nearness(const Mesh<2>& mesh, const std::array<Vec<2>, 2>& segment);

/// A place where the segment between two points lies within an element, by more than round-off from its edges; if any.
std::optional<Vec<2>> cut_element(const Mesh<2>& mesh, const std::array<Vec<2>, 2>& segment);

/// A place where a flat box (of two opposite corners, across an axis) passes through an element; if any. Never of a box
/// that has a thickness, or none in two directions, and of a grid, whose nodes lie on planes across the axes.
std::optional<Vec<3>> cut_element(const Mesh<3>& mesh, const std::array<Vec<3>, 2>& box);

}  // namespace scarp::run
