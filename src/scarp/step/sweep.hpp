// The sweep of steps 4 and 6 to 11 over a chunk of elements, for the step itself (elements.cpp) and its trial
// (trial.cpp). Not for use outside step/.
#pragma once

#include "scarp/exec/gap_sharing.hpp"
#include "scarp/step/step.hpp"
#include "scarp/transfer/nodes_to_points.hpp"

namespace scarp::step {

/// What the scheme says of the sweep.
struct MoveRules {
  transfer::MotionRules motion;
  double lateness;
  bool mends_massless;      ///< and there are such nodes
  bool records_pic;         ///< points book what PIC takes, or keep C_p
  bool stay_there = false;  ///< points keep their element, wherever they go: of a trial
};

inline MoveRules move_rules(const Scheme& scheme, double dt, bool massless_nodes) {
  const double phi = scheme.kept(dt);
  return {{phi, scheme.middle, scheme.affine, dt},
          scheme.lateness,
          scheme.mends_massless && massless_nodes,
          phi != 1 && !scheme.two_terms};
}

/// Steps 4, 6, 8, 9, 10 and 11 for the points of a block in the elements of a chunk, and the sharing of gaps where
/// that is asked for: their increments, from the place of the first on, for the stress update that is to follow.
/// `block` may be another than the body's, with its points in the same order.
template <int Dim>
void strain_and_move(Body<Dim>& body, VelocityField<Dim>& field, Block<Dim>& block, const exec::Chunk& chunk,
                     const MoveRules& rules, PointIncrements<Dim>& increments, exec::GapSharing<Dim>* sharing,
                     StepTotals<Dim>& totals);

}  // namespace scarp::step
