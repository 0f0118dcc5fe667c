// A step's strain and stress without the step: what explicit steps write over the state of points, apart from it. An
// implicit step asks for it with every guess of the nodes' displacements, and commits once. The sweep is the explicit
// step's own (sweep.hpp) on a copy of what it moves, for the same text compiled once more would round otherwise:
// compilers fuse products into sums by what else is done with them.
#pragma once

#include <vector>

#include "scarp/exec/stress_update.hpp"
#include "scarp/step/step.hpp"

namespace scarp {

/// What the points of a velocity field have at t^n + dt, if its nodes move as they are said to.
template <int Dim>
struct FieldTrial {
  std::vector<exec::TrialState<Dim>> blocks;  ///< stress, state and volume; in the order of the field's blocks
  std::vector<Block<Dim>> moved;  ///< x, v (and ξ, C) at t^n + dt by eqs 6 and 16 to 19, in the points' order; no more
};
template <int Dim>
struct BodyTrial {
  std::vector<FieldTrial<Dim>> fields;
  std::vector<BodyTotals<Dim>> totals;  ///< scratch, of each thread
  exec::StressTotals stress;            ///< of all fields
};

/// Steps 6 to 9 (eqs 9 to 15, and the law of section 3) from the state at t^n and the displacements du_i [m] that the
/// nodes have in each field's nodes.motion; those of conditions are up to the caller. Elements are the quadrature that
/// the last step 1 has made of them. Points, their blocks' columns, and nodes are left as they are, so that the same
/// du_i give the same trial, to the last bit, as often as they are asked for and on any number of threads, and that of
/// advance() for its du_i. `trial` may be one of an earlier call, whose memory is then used again.
template <int Dim>
void form_trial(Body<Dim>& body, double dt, const StepSettings& settings, BodyTrial<Dim>& trial);

/// The points take stress, state and volume of a trial, and the trial what they had: committed once more, it takes them
/// back. Places, velocities and elements are no part of it.
template <int Dim>
void commit(Body<Dim>& body, BodyTrial<Dim>& trial);

}  // namespace scarp
