#include "scarp/step/trial.hpp"

#include <algorithm>
#include <utility>

#include "scarp/step/chunks.hpp"
#include "scarp/step/element.hpp"
#include "scarp/step/patches.hpp"
#include "scarp/step/sweep.hpp"

namespace scarp {
namespace {

template <int Dim>
std::int64_t count_massless(const VelocityField<Dim>& field) {
  std::int64_t count = 0;
  for (int k = 0; k < field.assembly.size(); ++k) count += field.nodes.node[k].m == 0;
  return count;
}

/// What the sweep reads of the points, and moves.
template <int Dim>
void copy_moved(const Block<Dim>& from, Block<Dim>& to) {
  to.order = from.order;
  to.begin = from.begin;
  for (auto column : {&Points<Dim>::mass, &Points<Dim>::volume, &Points<Dim>::initial_volume})
    to.points.*column = from.points.*column;
  for (auto vector : {&Points<Dim>::x, &Points<Dim>::v, &Points<Dim>::xi}) to.points.*vector = from.points.*vector;
  to.points.C = from.points.C;
}

template <int Dim>
void prepare(FieldTrial<Dim>& trial, const VelocityField<Dim>& field) {
  const std::size_t blocks = field.blocks.size();
  trial.blocks.resize(blocks);
  while (trial.moved.size() > blocks) trial.moved.pop_back();
  for (std::size_t b = trial.moved.size(); b < blocks; ++b)
    trial.moved.emplace_back(field.blocks[b].name, field.blocks[b].model);
  for (std::size_t b = 0; b < blocks; ++b) {
    exec::prepare(trial.blocks[b], field.blocks[b]);
    copy_moved(field.blocks[b], trial.moved[b]);
  }
}

/// Its stress updates go to the books of the threads.
template <int Dim>
void form_trial(Body<Dim>& body, VelocityField<Dim>& field, double dt, const StepSettings& settings,
                FieldTrial<Dim>& trial, std::vector<BodyTotals<Dim>>& of_threads) {
  const Scheme& scheme = settings.scheme;
  prepare_threads(field);
  prepare(trial, field);
  step::MoveRules rules = step::move_rules(scheme, dt, count_massless(field) > 0);
  rules.stay_there = true;
  if (step::uses_patches(body, settings)) step::find_dilations(body, field, settings);
  const auto trial_of_block = [&](std::size_t b, const exec::Chunk& chunk, StepTotals<Dim>& part) {
    const Block<Dim>& block = field.blocks[b];
    Block<Dim>& moved = trial.moved[b];
    auto& increments = field.buffers.increments[exec::thread_number()];
    exec::GapSharing<Dim> gaps(block, moved.points.volume, increments, body.mesh->axisymmetric ? 3 : Dim, dt);
    auto* sharing = scheme.shares_gaps && gaps.active() ? &gaps : nullptr;
    step::strain_and_move(body, field, moved, chunk, rules, increments, sharing, part);
    exec::trial_stresses(block, trial.blocks[b], step::points_of(block, chunk), increments, 0, dt, settings.integration,
                         part.stress, scheme::waves(scheme, is_elastic(block.model), settings.damping));
    if (sharing) part.stress.work -= sharing->work(exec::UpdatedColumns<Dim>(trial.blocks[b]));
  };
  step::for_each_chunk(field, of_threads, [&](const exec::Chunk& chunk, StepTotals<Dim>& part) {
    for (std::size_t b = 0; b < field.blocks.size(); ++b) trial_of_block(b, chunk, part);
  });
  for (std::size_t b = 0; b < field.blocks.size(); ++b) std::swap(trial.moved[b].points.volume, trial.blocks[b].volume);
}

}  // namespace

template <int Dim>
void form_trial(Body<Dim>& body, double dt, const StepSettings& settings, BodyTrial<Dim>& trial) {
  trial.fields.resize(body.fields.size());
  trial.totals.assign(static_cast<std::size_t>(exec::thread_count()), {});
  for (std::size_t f = 0; f < body.fields.size(); ++f)
    form_trial(body, body.fields[f], dt, settings, trial.fields[f], trial.totals);
  trial.stress = step::total_of(trial.totals).stress;
}

template <int Dim>
void commit(Body<Dim>& body, BodyTrial<Dim>& trial) {
  for (std::size_t f = 0; f < body.fields.size(); ++f) {
    auto& blocks = body.fields[f].blocks;
    for (std::size_t b = 0; b < blocks.size(); ++b) exec::commit(blocks[b], trial.fields[f].blocks[b]);
  }
}

template void form_trial<2>(Body<2>&, double, const StepSettings&, BodyTrial<2>&);
template void form_trial<3>(Body<3>&, double, const StepSettings&, BodyTrial<3>&);
template void commit<2>(Body<2>&, BodyTrial<2>&);
template void commit<3>(Body<3>&, BodyTrial<3>&);

}  // namespace scarp
