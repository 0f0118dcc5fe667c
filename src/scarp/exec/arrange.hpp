// The arrays of the points in the order of their elements, so that sweeps over elements stream through memory.
#pragma once

#include <vector>

#include "scarp/points/points.hpp"

namespace scarp::exec {

/// Puts the arrays of every block into the order of sort_by_element(), where they are not.
template <int Dim>
void arrange_in_order(std::vector<Block<Dim>>& blocks);

/// The same in new memory, of which each thread first writes the part that it works on afterwards: where the processors
/// of a machine have memories of their own, that puts it into the right one.
template <int Dim>
void arrange_in_new_memory(std::vector<Block<Dim>>& blocks);

}  // namespace scarp::exec
