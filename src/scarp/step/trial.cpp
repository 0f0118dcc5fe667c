#include "scarp/step/trial.hpp"

#include <algorithm>

#include "scarp/exec/gap_sharing.hpp"
#include "scarp/exec/parallel.hpp"
#include "scarp/mesh/with_basis.hpp"
#include "scarp/step/element_motion.hpp"
#include "scarp/step/patches.hpp"

namespace scarp {
namespace {

template <int Dim>
std::int64_t count_massless(const Body<Dim>& body) {
  std::int64_t count = 0;
  for (int k = 0; k < body.assembly.size(); ++k) count += body.buffers.node[k].m == 0;
  return count;
}

/// Steps 6, 8 and 9 for the points of a block in an element.
template <class Basis, class Averaged>
SCARP_FLATTEN void strain_points(const Body<Basis::dim>& body, const Block<Basis::dim>& block, int slot, int e,
                                 const Scheme& scheme, bool mends_massless, Averaged averaged, Column& volume,
                                 PointIncrements<Basis::dim>& increments, int at) {
  const typename Basis::Cell cell(*body.mesh, e);
  transfer::Motion<Basis::dim> mean_motion;
  const auto element = step::element_motion<Basis>(body, slot, cell, mends_massless, averaged, mean_motion);
  transfer::increments_at_points<Basis>(cell, element, scheme.middle, block.points, step::points_of(block, slot),
                                        averaged, volume, increments, at);
}

}  // namespace

template <int Dim>
void form_trial(Body<Dim>& body, double dt, const StepSettings& settings, BodyTrial<Dim>& trial) {
  const Scheme& scheme = settings.scheme;
  prepare_threads(body);
  trial.blocks.resize(body.blocks.size());
  for (std::size_t b = 0; b < body.blocks.size(); ++b) exec::prepare(trial.blocks[b], body.blocks[b]);
  StepBooks<Dim> books;
  books.massless_nodes = count_massless(body);
  const bool mends_massless = scheme.mends_massless && books.massless_nodes > 0;
  if (step::uses_patches(body, settings)) step::find_dilations(body, settings, books);
  exec::sum_over_chunks(
      body.active.size(), element_chunk, body.buffers.books, books, [&](int first, int last, StepBooks<Dim>& part) {
        auto& increments = body.buffers.increments[exec::thread_number()];
        for (std::size_t b = 0; b < body.blocks.size(); ++b) {
          const Block<Dim>& block = body.blocks[b];
          exec::TrialState<Dim>& to = trial.blocks[b];
          exec::GapSharing<Dim> gaps(block, to.volume, increments, body.mesh->axisymmetric ? 3 : Dim, dt);
          const bool shares = scheme.shares_gaps && gaps.active();
          with_basis<Dim>(*body.mesh, body.active.element.data(), first, last,
                          [&]<class Basis>(Basis, int slot, int e) {
                            const int at = block.begin[slot] - block.begin[first];
                            transfer::with_means<Basis>(body.buffers.mean_dilatation[slot] != 0, [&](auto averaged) {
                              strain_points<Basis>(body, block, slot, e, scheme, mends_massless, averaged, to.volume,
                                                   increments, at);
                            });
                            if (shares) gaps.in_element(step::points_of(block, slot), body.mesh->size[e], at);
                          });
          const PointRange range{block.order.data() + block.begin[first], block.begin[last] - block.begin[first]};
          exec::trial_stresses(block, to, range, increments, 0, dt, settings.integration, part.stress,
                               scheme::waves(scheme, is_elastic(block.model), settings.damping));
          if (shares) part.stress.work -= gaps.work(exec::UpdatedColumns<Dim>(to));
        }
      });
  trial.stress = books.stress;
}

template <int Dim>
void commit(Body<Dim>& body, BodyTrial<Dim>& trial) {
  for (std::size_t b = 0; b < body.blocks.size(); ++b) exec::commit(body.blocks[b], trial.blocks[b]);
}

template void form_trial<2>(Body<2>&, double, const StepSettings&, BodyTrial<2>&);
template void form_trial<3>(Body<3>&, double, const StepSettings&, BodyTrial<3>&);
template void commit<2>(Body<2>&, BodyTrial<2>&);
template void commit<3>(Body<3>&, BodyTrial<3>&);

}  // namespace scarp
