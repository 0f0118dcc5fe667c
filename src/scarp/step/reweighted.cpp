#include "scarp/step/reweighted.hpp"

#include "scarp/exec/elastic_energy.hpp"
#include "scarp/mesh/with_basis.hpp"
#include "scarp/step/element.hpp"
#include "scarp/transfer/quadrature.hpp"

namespace scarp::step {
namespace {

template <int Dim>
void note(Buffers<Dim>& buffers, int e) {
  if (buffers.is_changed[e]) return;
  buffers.is_changed[e] = 1;
  buffers.changed.push_back(e);
}

template <int Dim>
void note_around(Body<Dim>& body, VelocityField<Dim>& field, int e) {
  for (const int other : body.mesh->elements_around(e)) note(field.buffers, other);
}

/// w of an active element, for points of this volume.
template <class Basis>
double weight(const Body<Basis::dim>& body, const VelocityField<Basis::dim>& field, const StepSettings& settings,
              int slot, int e, double volume) {
  if constexpr (Basis::corrects) {
    if (settings.quadrature == QuadratureRule::corrected && field.buffers.inside[slot]) {
      const transfer::Means<Basis> mean(typename Basis::Cell(*body.mesh, e));
      if (transfer::fills(volume, mean)) return mean.V / volume;
    }
  }
  return 1;
}

}  // namespace

template <int Dim>
void find_changed_elements(Body<Dim>& body, VelocityField<Dim>& field) {
  auto& buffers = field.buffers;
  for (const int e : buffers.changed) buffers.is_changed[e] = 0;
  buffers.changed.clear();
  for (int slot = 0; slot < field.active.size(); ++slot) {
    if (!buffers.left[slot]) continue;
    buffers.left[slot] = 0;
    const int e = field.active.element[slot];
    note(buffers, e);
    bool emptied = true;
    for (const auto& block : field.blocks) {
      const auto range = points_of(block, slot);
      for (int k = 0; k < range.count; ++k) {
        const int now = block.points.element[range.order[k]];
        if (now == e) emptied = false;
        if (now == e || now < 0) continue;
        note(buffers, now);
        if (field.active.slot[now] < 0) note_around(body, field, now);
      }
    }
    if (emptied) note_around(body, field, e);
  }
}

template <int Dim>
void record_energy_of_changed_elements(const Body<Dim>& body, VelocityField<Dim>& field, const StepSettings& settings,
                                       double sign) {
  auto& totals = field.buffers.totals.front();
  const auto& changed = field.buffers.changed;
  with_basis<Dim>(*body.mesh, changed.data(), 0, static_cast<int>(changed.size()), [&]<class Basis>(Basis, int, int e) {
    const int slot = field.active.slot[e];
    if (slot < 0) return;
    double volume = 0, of_points = 0;
    for (const auto& block : field.blocks) {
      const auto range = points_of(block, slot);
      for (int k = 0; k < range.count; ++k) volume += block.points.volume[range.order[k]];
      of_points += exec::elastic_energy(block, range);
    }
    totals.part().energy_reweighted = sign * weight<Basis>(body, field, settings, slot, e, volume) * of_points;
    totals.close_part();
  });
}

template void find_changed_elements<2>(Body<2>&, VelocityField<2>&);
template void find_changed_elements<3>(Body<3>&, VelocityField<3>&);
template void record_energy_of_changed_elements<2>(const Body<2>&, VelocityField<2>&, const StepSettings&, double);
template void record_energy_of_changed_elements<3>(const Body<3>&, VelocityField<3>&, const StepSettings&, double);

}  // namespace scarp::step
