// What a case will take of the machine's memory, before any of it is taken.
#pragma once

#include "scarp/input/case.hpp"

namespace scarp::run {

/// How many points will fill a region, about.
template <int Dim>
double expected_points(const input::RegionInputOf<Dim>& region);

/// [bytes]
struct MemoryNeed {
  double grid = 0;        ///< of the grid: its lines, and what its sides hold
  double points = 0;      ///< of all points, with their state, and what a step keeps for their elements
  double checkpoint = 0;  ///< of the copy of the state that is on its way to the disk
  double addresses = 0;   ///< beside these: what only elements and nodes with soil will use of the arrays of all
};

/// Of a case on a grid; of one on a mesh from a file the points only, for the mesh is there when its size is known.
/// Measured sizes of `scarp check` and of a step agree to a quarter (tests/regression/memory_test.py).
template <int Dim>
MemoryNeed memory_need(const input::CaseOf<Dim>& input);

/// Throws InputError where there is less.
template <int Dim>
void check_memory(const input::CaseOf<Dim>& input);

}  // namespace scarp::run
