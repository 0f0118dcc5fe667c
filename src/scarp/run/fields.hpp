// The arrays of an output frame, from the body and what its models declare of themselves.
#pragma once

#include <string>
#include <vector>

#include "scarp/io/vtu.hpp"
#include "scarp/step/body.hpp"

namespace scarp::run {

/// Positions, three coordinates a point, in the order of the points' numbers.
template <int Dim>
std::vector<double> frame_positions(const Body<Dim>& body);

/// All fields of a frame in the same order, compression positive: motion, stress, strain, the models' state and derived
/// quantities (NaN where a point's model does not have one), flags and counts. Tensors have VTK's six components XX YY
/// ZZ XY YZ XZ.
template <int Dim>
std::vector<io::Field> frame_fields(const Body<Dim>& body);

}  // namespace scarp::run
