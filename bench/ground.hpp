// Ground for the benchmarks of whole steps: a body of soil on each kind of mesh, all full elements, fixed at the
// bottom.
#pragma once

#include <string>

#include "scarp/input/case.hpp"
#include "scarp/material/models.hpp"
#include "scarp/step/step.hpp"

namespace scarp::bench {

/// A grid of n elements of 1 m along each axis with soil in [2, n − 2] (each horizontal axis) × [0, n − 2], under a
/// uniform stress of 100 kPa vertically and 50 kPa horizontally, four points to an element in two dimensions, eight in
/// three; n so that there are about `points` of them. In two dimensions 158 makes 96,096.
template <int Dim>
input::CaseOf<Dim> grid_case(int points, const AnyModel& model);

enum class ElementShape { quadrilaterals, triangles };

/// The same soil in two dimensions on an unstructured mesh: the grid with its inner nodes moved at random by up to a
/// fifth of an element, its cells whole with four points each, or cut into two triangles with three points each.
Body<2> mesh_body(int points, const AnyModel& model, ElementShape shape);

/// Velocities that compress the ground vertically at this rate [1/s], so that the law has work at every point.
template <int Dim>
void compress(Body<Dim>& body, double rate);

}  // namespace scarp::bench
