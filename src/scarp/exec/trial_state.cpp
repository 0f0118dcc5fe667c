#include "scarp/exec/trial_state.hpp"

#include <utility>

namespace scarp::exec {

template <int Dim>
void prepare(TrialState<Dim>& trial, const Block<Dim>& block) {
  const auto& points = block.points;
  const auto as = [](const auto& column, auto& of_trial) { of_trial.resize(column.size()); };
  for (int c = 0; c < sym_size<Dim>; ++c) {
    as(points.sigma[c], trial.sigma[c]);
    as(points.sigma_ahead[c], trial.sigma_ahead[c]);
  }
  trial.state.resize(block.state.size());
  for (std::size_t c = 0; c < block.state.size(); ++c) as(block.state[c], trial.state[c]);
  as(points.eps_q, trial.eps_q);
  as(points.volume, trial.volume);
  as(points.flags, trial.flags);
  as(points.substeps, trial.substeps);
}

template <int Dim>
void commit(Block<Dim>& block, TrialState<Dim>& trial) {
  auto& points = block.points;
  std::swap(points.sigma, trial.sigma);
  std::swap(points.sigma_ahead, trial.sigma_ahead);
  std::swap(block.state, trial.state);
  std::swap(points.eps_q, trial.eps_q);
  std::swap(points.volume, trial.volume);
  std::swap(points.flags, trial.flags);
  std::swap(points.substeps, trial.substeps);
}

template void prepare<2>(TrialState<2>&, const Block<2>&);
template void prepare<3>(TrialState<3>&, const Block<3>&);
template void commit<2>(Block<2>&, TrialState<2>&);
template void commit<3>(Block<3>&, TrialState<3>&);

}  // namespace scarp::exec
