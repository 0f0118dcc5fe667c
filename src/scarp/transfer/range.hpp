// The points of one block in one element.
#pragma once

#include "scarp/mesh/shapes.hpp"
#include "scarp/points/points.hpp"

namespace scarp::transfer {

/// The points order[0] ... order[count - 1] of a block, all in one element.
struct Range {
  const int* order;
  int count;
};

}  // namespace scarp::transfer
