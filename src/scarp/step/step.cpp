#include "scarp/step/step.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "scarp/base/error.hpp"
#include "scarp/comm/alone.hpp"
#include "scarp/exec/arrange.hpp"
#include "scarp/step/chunks.hpp"
#include "scarp/step/node_rates.hpp"
#include "scarp/step/patches.hpp"
#include "scarp/step/phases.hpp"
#include "scarp/step/reweighted.hpp"
#include "scarp/step/soundness.hpp"

namespace scarp {
namespace {

/// Of a point of a region, the field's block b, that is not in the mesh any more.
template <int Dim>
comm::Failure failure_of_lost(const VelocityField<Dim>& field, int b, int i) {
  const auto& block = field.blocks[b];
  const auto& points = block.points;
  Vec<Dim> x, v;
  for (int j = 0; j < Dim; ++j) {
    x[j] = points.x[j][i];
    v[j] = points.v[j][i];
  }
  return {b, points.id[i],
          RunError(fmt::format("point {} of region \"{}\" has left the mesh", points.id[i], block.name),
                   fmt::format("({:.6g}), with velocity ({:.4g})", fmt::join(x, ", "), fmt::join(v, ", ")),
                   fmt::format("extend the mesh{}, or let such points be removed with leaving = \"remove\" in [method]",
                               field.outside.sides.active() ? ", or where an absorbing side gave way take a smaller "
                                                              "thickness or a larger impedance for it"
                                                            : ""))};
}

/// Throws where a point of a field has left the mesh: for the first by region and id.
template <int Dim>
void refuse_to_lose(const VelocityField<Dim>& field) {
  std::optional<comm::Failure> first;
  for (int b = 0; b < static_cast<int>(field.blocks.size()) && !first; ++b) {
    const auto& points = field.blocks[b].points;
    int lost = -1;
    for (int i = 0; i < points.size(); ++i) {
      if (points.element[i] < 0 && (lost < 0 || points.id[i] < points.id[lost])) lost = i;
    }
    if (lost >= 0) first = failure_of_lost(field, b, lost);
  }
  comm::agree(first);
}

/// Takes out the points of a field that have left the mesh.
template <int Dim>
void remove_lost(VelocityField<Dim>& field) {
  auto& totals = field.buffers.totals.front();
  for (auto& block : field.blocks) {
    const auto& points = block.points;
    std::vector<std::uint8_t> gone(points.element.size());
    for (int i = 0; i < block.size(); ++i) {
      gone[i] = points.element[i] < 0;
      if (!gone[i]) continue;
      ++totals.part().removed;
      totals.part().removed_mass = points.mass[i];
      totals.part().removed_energy = kinetic_energy_of(points, i);
      totals.close_part();
    }
    remove_points(block, gone);
  }
}

/// Points in the order of their new elements; their arrays are put in order when it pays.
template <int Dim>
void order_points(const Body<Dim>& body, VelocityField<Dim>& field) {
  reorder(body, field);
  // Sweeps by element reach out of order for these points; a tenth of them is where putting all in order again pays.
  field.out_of_place += field.changed_element;
  if (10 * field.out_of_place > field.point_count()) {
    exec::arrange_in_order(field.blocks);
    field.out_of_place = 0;
  }
}

/// Step 11, end: the points of all fields in their new elements.
template <int Dim>
void order_points(Body<Dim>& body, const StepSettings& settings) {
  for (auto& field : body.fields) {
    if (field.changed_element == 0) continue;
    const bool some_left = step::counted(field, &StepTotals<Dim>::left_mesh) > 0;
    if (some_left) step::refuse_nowhere(field);
    step::find_changed_elements(body, field);
    step::record_energy_of_changed_elements(body, field, settings, -1);
    if (some_left) {
      if (!settings.remove_leaving) refuse_to_lose(field);
      remove_lost(field);
    }
    order_points(body, field);
    step::record_energy_of_changed_elements(body, field, settings, 1);
  }
}

}  // namespace

template <int Dim>
void record_motion(const Body<Dim>& body, StepTotals<Dim>& totals) {
  std::vector<BodyTotals<Dim>> of_threads(static_cast<std::size_t>(exec::thread_count()));
  for (const auto& field : body.fields) {
    step::for_each_chunk(field, of_threads, [&](const exec::Chunk& chunk, StepTotals<Dim>& part) {
      for (const auto& block : field.blocks) {
        const auto& points = block.points;
        for (int k = block.begin[chunk.slots.first]; k < block.begin[chunk.slots.last]; ++k) {
          const int i = block.order[k];
          for (int j = 0; j < Dim; ++j) part.momentum[j] += points.mass[i] * points.v[j][i];
          part.mass += points.mass[i];
          part.kinetic_energy += kinetic_energy_of(points, i);
          part.max_velocity = std::max(part.max_velocity, std::sqrt(speed2_of(points, i)));
        }
      }
    });
  }
  const auto total = step::total_of(of_threads);
  totals.mass = total.mass;
  totals.momentum = total.momentum;
  totals.kinetic_energy = total.kinetic_energy;
  totals.max_velocity = total.max_velocity;
}

namespace step {

template <int Dim>
StepTotals<Dim> close_totals(Body<Dim>& body, double dt, const StepSettings& settings) {
  BodyTotals<Dim> all;
  for (const auto& field : body.fields) {
    for (const auto& of_thread : field.buffers.totals) all += of_thread;
  }
  auto totals = all.total();
  if (scheme::records_pic_at_nodes(settings.scheme, dt)) {
    totals.dissipation_pic += totals.kinetic_energy_before - totals.kinetic_energy;
  }
  totals.work_stress = totals.stress.work;
  totals.dissipation_waves = totals.stress.damping;
  if (totals.left_mesh > 0) record_motion(body, totals);
  return totals;
}

template StepTotals<2> close_totals<2>(Body<2>&, double, const StepSettings&);
template StepTotals<3> close_totals<3>(Body<3>&, double, const StepSettings&);

}  // namespace step

/// Steps 4 and 5 ask for the points' velocities (eq. 6, with a PIC share 1 − φ) only to form momentum of them again
/// (eq. 7). Both are linear: with c_j the change of velocity at the nodes (scheme.hpp)
///     v_p^{t+dt} = φ v_p + Σ_j c_j N_j,
///     p_i^{t+dt} = Σ_p m_p v_p^{t+dt} N_i = φ p_i + Σ_j M_ij c_j,   M_ij = Σ_p m_p N_i N_j,
/// so that step 5 needs M_ij, summed up in step 1, and no points; these take their v_p^{t+dt} with the sweep that moves
/// them.
template <int Dim>
StepTotals<Dim> advance(Body<Dim>& body, double dt, const StepSettings& settings) {
  const auto timed = [&](Phase phase, auto&& f) {
    const Stopwatch<Dim> watch(settings.profile, body.fields.front().buffers.totals.front().part(), phase);
    f();
  };
  const auto each = [&](Phase phase, auto&& f) {
    timed(phase, [&] {
      for (auto& field : body.fields) f(field);
    });
  };
  using Field = VelocityField<Dim>;
  using P = Phase;
  const Scheme& scheme = settings.scheme;
  for (auto& field : body.fields) {
    prepare_threads(field);
    std::fill(field.buffers.totals.begin(), field.buffers.totals.end(), BodyTotals<Dim>());
  }
  each(P::points_to_nodes, [&](Field& f) { step::map_points_to_elements(body, f, settings); });  // 1, eqs 1–4
  each(P::nodes, [&](Field& f) { step::accelerate_nodes(body, f, dt, settings); });              // 2, 3, eq. 5
  if (!body.interactions.empty()) timed(P::nodes, [&] { step::interact(body, dt, settings); });  // 3, end
  if (scheme.two_terms) {
    each(P::velocities, [&](Field& f) { step::sum_with_mass_matrix<2 * Dim>(body, f, 0); });
    each(P::nodes, [&](Field& f) { step::filter_changes(f, dt, settings); });                 // 4: c = P c
    each(P::velocities, [&](Field& f) { step::sum_with_mass_matrix<2 * Dim>(body, f, 0); });  // 4, 5, eqs 6, 7
  } else {
    each(P::velocities, [&](Field& f) { step::sum_with_mass_matrix<Dim>(body, f, 0); });  // 4, 5, eqs 6, 7
  }
  each(P::nodes, [&](Field& f) { step::velocities_of_nodes(body, f, dt, settings); });  // 5, eq. 8
  if (scheme.filters_motion()) {
    each(P::velocities, [&](Field& f) { step::sum_with_mass_matrix<2 * Dim>(body, f, Dim); });
    each(P::nodes, [&](Field& f) { step::filter_displacements(body, f, settings); });  // 5: du = P v dt
  }
  if (step::uses_patches(body, settings)) {
    each(P::velocities, [&](Field& f) { step::find_dilations(body, f, settings); });
  }
  if (step::bounds_by_nodes(body, scheme)) {
    each(P::velocities, [&](Field& f) { step::bound_by_nodes_when_due(body, f); });
  }
  for (auto& f : body.fields) {
    step::strain_stress_and_motion(body, f, dt, settings);  // 4, 6 to 11, eqs 6, 9–19 and section 3
  }
  timed(P::order, [&] { order_points(body, settings); });  // 11
  if (step::softens_over_length(body)) timed(P::averages, [&] { step::average_softening(body, dt); });
  const auto totals = step::close_totals(body, dt, settings);
  step::refuse_nonsense(body, dt, totals);
  return totals;
}

namespace {

/// What bounds the time step by nodes, of points as they are.
template <int Dim>
void find_bound_by_nodes(Body<Dim>& body, VelocityField<Dim>& field, const Scheme& scheme) {
  StepSettings settings;
  settings.scheme = scheme;
  prepare_threads(field);
  step::map_points_to_elements(body, field, settings);
  for (int k = 0; k < field.assembly.size(); ++k) {
    const double m = step::gathered_sums(field, k).mass();
    field.nodes.node[k].per_mass = m < field.least_mass ? 0 : 1 / m;
  }
  step::bound_by_nodes(body, field, step::Bounded::all);
}

}  // namespace

template <int Dim>
double critical_time_step(Body<Dim>& body, const Scheme& scheme, double local_damping) {
  double dt = std::numeric_limits<double>::infinity();
  for (auto& field : body.fields) {
    if (step::bounds_by_nodes(body, scheme)) find_bound_by_nodes(body, field, scheme);
    for (const auto& block : field.blocks) {
      dt = std::min(dt, exec::critical_time_step(block, *body.mesh, field.active, field.buffers.weight,
                                                 field.buffers.bounds.least_per_mass,
                                                 scheme::waves(scheme, is_elastic(block.model), local_damping)));
    }
  }
  return comm::least_of_all(dt);
}

template StepTotals<2> advance<2>(Body<2>&, double, const StepSettings&);
template StepTotals<3> advance<3>(Body<3>&, double, const StepSettings&);
template double critical_time_step<2>(Body<2>&, const Scheme&, double);
template double critical_time_step<3>(Body<3>&, const Scheme&, double);
template void record_motion<2>(const Body<2>&, StepTotals<2>&);
template void record_motion<3>(const Body<3>&, StepTotals<3>&);

}  // namespace scarp
