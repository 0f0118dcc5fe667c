// What a step makes of the stress and state of points, apart from the points themselves: an explicit step writes it
// over what they have, an implicit one forms it again and again from the state at t^n and commits the last.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "scarp/base/column.hpp"
#include "scarp/points/points.hpp"

namespace scarp::exec {

/// Stress, state and volume of the points of a block at t^n + dt, in their order; tension positive, as in Points.
template <int Dim>
struct TrialState {
  std::array<Column, sym_size<Dim>> sigma, sigma_ahead;  ///< σ* only where the points have it
  std::vector<Column> state;
  Column eps_q, volume;
  std::vector<std::uint8_t> flags, substeps;
};

/// Room for the points of a block; allocates nothing where it has been of this size.
template <int Dim>
void prepare(TrialState<Dim>& trial, const Block<Dim>& block);

/// The points take the trial, and the trial what they had: committed once more, it takes the step back.
template <int Dim>
void commit(Block<Dim>& block, TrialState<Dim>& trial);

/// The columns that a stress update writes: a block's own, or those of a trial.
template <int Dim>
struct UpdatedColumns {
  std::array<Column, sym_size<Dim>>&sigma, &sigma_ahead;
  std::vector<Column>& state;
  Column& eps_q;
  std::vector<std::uint8_t>&flags, &substeps;

  explicit UpdatedColumns(Block<Dim>& block)
      : sigma(block.points.sigma),
        sigma_ahead(block.points.sigma_ahead),
        state(block.state),
        eps_q(block.points.eps_q),
        flags(block.points.flags),
        substeps(block.points.substeps) {}
  explicit UpdatedColumns(TrialState<Dim>& trial)
      : sigma(trial.sigma),
        sigma_ahead(trial.sigma_ahead),
        state(trial.state),
        eps_q(trial.eps_q),
        flags(trial.flags),
        substeps(trial.substeps) {}
};

}  // namespace scarp::exec
