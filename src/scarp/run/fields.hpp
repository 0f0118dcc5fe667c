// The arrays of an output frame, from the body and what its models declare of themselves.
#pragma once

#include <cstddef>
#include <vector>

#include "scarp/io/vtu.hpp"
#include "scarp/step/body.hpp"

namespace scarp::run {

/// Reads the body when it is written: the body must stay as it is until then.
struct Frame {
  std::size_t count;              ///< of the points
  io::Field positions;            ///< three coordinates
  std::vector<io::Field> fields;  ///< see frame_of()
};

/// The points in the order of their numbers with all their fields, compression positive: motion, stress, strain, the
/// models' state and derived quantities (NaN where a point's model does not have one), flags and counts. Tensors have
/// VTK's six components XX YY ZZ XY YZ XZ.
template <int Dim>
Frame frame_of(const Body<Dim>& body);

}  // namespace scarp::run
