// Steps 1, 4 to 11 element by element.
#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "scarp/mesh/with_basis.hpp"
#include "scarp/step/chunks.hpp"
#include "scarp/step/element_motion.hpp"
#include "scarp/step/patches.hpp"
#include "scarp/step/phases.hpp"
#include "scarp/step/sweep.hpp"
#include "scarp/transfer/mass_matrix.hpp"
#include "scarp/transfer/nodes_to_points.hpp"
#include "scarp/transfer/points_to_nodes.hpp"

namespace scarp::step {
namespace {

/// What the mean stress of an element acts on: B̄_i of its own, or those of a patch, to which it then goes.
template <class Basis>
void use_means(Buffers<Basis::dim>& buffers, int slot, const transfer::ElementSums<Basis>& sums,
               transfer::Means<Basis>& means, transfer::Quadrature<Basis>& quadrature) {
  if constexpr (is_simplex<Basis>) {
    buffers.patch_share[slot] = {means.V, xsimd::hadd(sums.Omega_mean) / xsimd::hadd(sums.Omega), 0};
  } else {
    if constexpr (transfer::keeps_means<Basis>) {
      const transfer::Lane<Basis> per_volume(1 / std::max(1e-300, xsimd::hadd(sums.Omega_share)));
      means.gradient = transfer::totals<Basis>(sums.Omega_B);
      for (auto& component : means.gradient) {
        for (auto& batch : component) batch *= per_volume;
      }
      means.store(buffers.mean_gradient.data() + slot * transfer::Means<Basis>::size);
    }
    quadrature.means = &means;
  }
}

/// Step 1 in an element; adds Σ m_p |v_p|² of its points to m_v2. With `averaged` the volume strain of its points is a
/// mean; where it turns out not to be full, nothing has been added and the answer is false.
template <class Basis, class Places, class Averaged>
SCARP_FLATTEN bool sum_points(Body<Basis::dim>& body, VelocityField<Basis::dim>& field, const Places& places,
                              const StepSettings& settings, int slot, int e, Averaged averaged,
                              PointBatch<Basis::dim>& m_v2) {
  auto& buffers = field.buffers;
  const typename Basis::Cell cell(*body.mesh, e);
  const transfer::ShapesAtPoints<Basis> shapes(cell);
  std::optional<transfer::Means<Basis>> means;  // of an element inside the soil
  if constexpr (Basis::corrects || !std::is_same_v<Averaged, std::false_type>) {
    if (settings.quadrature == QuadratureRule::corrected && buffers.inside[slot]) means.emplace(cell);
  }
  transfer::ElementSums<Basis> sums;
  for (const auto& block : field.blocks) {
    transfer::points_to_nodes<Basis>(shapes, places, block.points, points_of(block, slot), averaged, sums);
  }
  if (averaged && !transfer::fills(xsimd::hadd(sums.Omega), *means)) [[unlikely]]
    return false;
  m_v2 += sums.m_v2;
  transfer::Quadrature<Basis> quadrature;
  if constexpr (Basis::corrects) {
    const double volume = xsimd::hadd(sums.Omega);
    if (means && transfer::fills(volume, *means)) {
      quadrature =
          transfer::full_element<Basis>(cell, *means, volume, sums.correction, transfer::totals<Basis>(sums.hoop));
    }
  }
  if (averaged) use_means<Basis>(buffers, slot, sums, *means, quadrature);
  buffers.weight[slot] = quadrature.weight;
  if (!buffers.bounds.filled.empty()) buffers.bounds.filled[slot] = quadrature.weight * xsimd::hadd(sums.Omega);
  buffers.mean_dilatation[slot] = averaged;
  quadrature.correction.store(buffers.correction.data() + slot * buffers.correction_row);
  if constexpr (is_axisymmetric<Basis>) {
    transfer::store_nodal<Basis>(quadrature.hoop_correction[0],
                                 buffers.hoop_correction.data() + slot * padded_row(field.assembly.row()));
  }
  if constexpr (transfer::keeps_mass_matrix<Basis>) {
    transfer::store_mass_matrix<Basis>(sums.M,
                                       buffers.mass_matrix.data() + slot * mass_matrix_row(field.assembly.row()));
  }
  transfer::add_to_nodes<Basis>(sums, transfer::internal_force<Basis>(sums, quadrature),
                                field.assembly.accumulators_of(slot), buffers.sums.data());
  return true;
}

/// Step 1 in an element; adds Σ m_p |v_p|² of its points to m_v2.
template <class Basis, class Places>
void sum_points(Body<Basis::dim>& body, VelocityField<Basis::dim>& field, const Places& places,
                const StepSettings& settings, int slot, int e, PointBatch<Basis::dim>& m_v2) {
  const bool averaged =
      settings.scheme.mean_dilatation && settings.quadrature == QuadratureRule::corrected && field.buffers.inside[slot];
  bool done = false;
  const auto sum = [&](auto means) { done = sum_points<Basis>(body, field, places, settings, slot, e, means, m_v2); };
  transfer::with_means<Basis>(averaged, sum);
  if (!done) transfer::with_means<Basis>(false, sum);  // few elements inside the soil are not full
}

/// Σ_j M_ij w_j of the first n components w of the nodes' Motion, of all of them those from `from` on, in an element
/// that does not keep M_ij.
template <class Basis, int n>
SCARP_FLATTEN void add_momentum_of_points(Body<Basis::dim>& body, VelocityField<Basis::dim>& field, int slot, int e,
                                          int from) {
  constexpr int Dim = Basis::dim, size = transfer::accumulator_size<n>;
  const typename Basis::Cell cell(*body.mesh, e);
  const int* accumulators = field.assembly.accumulators_of(slot);
  double* momentum = field.buffers.momentum.data();
  const auto rows = motion_of_nodes<Basis>(field, slot, from);
  for (const auto& block : field.blocks) {
    const PointRange range = points_of(block, slot);
    if (from == 0) {
      transfer::add_momentum<Basis, n, size, 0>(cell, block.points, range, rows, accumulators, momentum);
    } else {
      transfer::add_momentum<Basis, Dim, size, n - Dim>(cell, block.points, range, rows, accumulators, momentum);
    }
  }
}

template <int Dim>
void record(const transfer::MotionSums<Dim>& sums, StepTotals<Dim>& totals) {
  totals.mass += xsimd::hadd(sums.mass);
  totals.kinetic_energy += 0.5 * xsimd::hadd(sums.kinetic_energy);
  totals.dissipation_pic += 0.5 * xsimd::hadd(sums.taken);
  for (int j = 0; j < Dim; ++j) totals.momentum[j] += xsimd::hadd(sums.momentum[j]);
  double fastest2 = 0;
  for (std::size_t l = 0; l < sums.fastest2.size; ++l) fastest2 = std::max(fastest2, sums.fastest2.get(l));
  totals.max_velocity = std::max(totals.max_velocity, std::sqrt(fastest2));
  totals.chunks_without_volume += xsimd::any(sums.no_volume);
}

/// Which of a few points, at x now, are still in their element, as bits of lanes; the local coordinates of these are
/// kept where the basis stores them. `beyond(xi, inside)` says which of the others stay in it all the same.
template <class Basis, class Lanes, class T, class Before, class Beyond>
unsigned still_inside(const typename Basis::Cell& cell, const Lanes& p, const std::array<T, Basis::dim>& x,
                      const Before& before, double tolerance, Points<Basis::dim>& points, Beyond&& beyond) {
  const unsigned present = first_bits(p.count());
  unsigned inside;
  if constexpr (Basis::stores_local) {
    std::array<T, Basis::dim> xi;
    auto found = before.follow(x, xi);
    if ((bits_of(found) & present) != present) [[unlikely]] {
      for (int j = 0; j < Basis::dim; ++j) xi[j] = p.load(points.xi[j]);
      found = cell.follow(x, xi, [&](const auto& good) { return (bits_of(good) & present) == present; });
    }
    for (int j = 0; j < Basis::dim; ++j) p.store(xi[j], points.xi[j]);  // those not inside get theirs later
    inside = bits_of(found && cell.inside(xi, tolerance)) & present;
    if (inside != present) [[unlikely]]
      inside |= beyond(xi) & bits_of(found) & present;
  } else {
    const auto xi = cell.local(x);
    inside = bits_of(cell.inside(xi, tolerance)) & present;
    if (inside != present) [[unlikely]]
      inside |= beyond(xi) & present;
  }
  return inside;
}

/// Have the nodes of an element masses that differ by no more than a factor of five, in simplices over those of a full
/// mesh? A last point that lingers beyond a free edge would leave a node with next to no mass, or less than none.
template <class Basis>
bool nodes_are_full(const Body<Basis::dim>& body, const VelocityField<Basis::dim>& field, int slot) {
  double least = std::numeric_limits<double>::infinity(), most = 0;
  const int* nodes = field.assembly.nodes_of(slot);
  for (int i = 0; i < Basis::nodes; ++i) {
    double m = field.nodes.node[nodes[i]].m;
    if constexpr (is_simplex<Basis>) m /= body.full_volume[field.assembly.node(nodes[i])];
    least = std::min(least, m);
    most = std::max(most, m);
  }
  return least >= 0.2 * most;
}

/// Step 11, late: points that are beyond their element by no more than `lateness` parts of it stay there, wherever the
/// mesh goes on. Each change of element weights the stored energy of two elements anew; points that lie on a line
/// between elements and cross it to and fro would bring in more with each vibration (docs/theory.md, "Late leaving").
template <class Basis, class T>
unsigned linger(const Body<Basis::dim>& body, const VelocityField<Basis::dim>& field, const typename Basis::Cell& cell,
                int slot, const std::array<T, Basis::dim>& xi, double lateness) {
  if constexpr (Basis::has_domains) return 0;  // its functions are continuous, and hold within the cell only
  if (lateness == 0 || !nodes_are_full<Basis>(body, field, slot)) return 0;
  const int e = field.active.element[slot];
  std::array<double, Basis::sides> tolerance;
  for (int side = 0; side < Basis::sides; ++side)
    tolerance[side] = body.locator.ends_at(e, side) ? body.locator.tolerance() : lateness;
  return bits_of(cell.inside(xi, tolerance));
}

/// Step 11 for those of a few points that are not `inside` element e any more.
template <int Dim, class Lanes>
[[gnu::noinline]] void find_new_elements(const Locator<Dim>& locator, int e, const Lanes& p, unsigned inside,
                                         Points<Dim>& points, StepTotals<Dim>& totals) {
  for (int l = 0; l < p.count(); ++l) {
    if (inside >> l & 1u) continue;
    const int i = p.point(l);
    const auto place = locator.find(position_of(points, i), e, totals.search);
    totals.changed_element += place.element != e;
    totals.left_mesh += place.element < 0;
    points.element[i] = place.element;
    for (int j = 0; j < Dim && !points.xi[j].empty(); ++j) points.xi[j][i] = place.xi[j];
  }
}

/// What the sweep of steps 4 and 6 to 11 adds up over a chunk.
template <int Dim>
struct MotionTotals {
  transfer::MotionSums<Dim> sums;
  std::int64_t stayed = 0;  ///< points that did not leave their element
};

/// Steps 4, 6, 8, 9, 10 and 11 for the points of a block in an element.
template <bool pic, class Basis, class Averaged>
SCARP_FLATTEN void move_points(Body<Basis::dim>& body, VelocityField<Basis::dim>& field, Block<Basis::dim>& block,
                               int slot, int e, const MoveRules& rules, PointIncrements<Basis::dim>& increments, int at,
                               Averaged averaged, MotionTotals<Basis::dim>& motion, StepTotals<Basis::dim>& totals) {
  const typename Basis::Cell cell(*body.mesh, e);
  transfer::Motion<Basis::dim> mean_motion;
  const auto element = element_motion<Basis>(body, field, slot, cell, rules.mends_massless, averaged, mean_motion);
  const auto a_dt = flip_changes<pic, Basis>(field, slot);
  const std::int64_t changed = totals.changed_element;
  transfer::nodes_to_points<pic, Basis>(
      cell, element, a_dt, rules.motion, block.points, points_of(block, slot), increments, at, averaged, motion.sums,
      [&](const auto& p, const auto& x, const auto& before) {
        const unsigned inside = still_inside<Basis>(
            cell, p, x, before, body.locator.tolerance(), block.points,
            [&](const auto& xi) { return linger<Basis>(body, field, cell, slot, xi, rules.lateness); });
        motion.stayed += std::popcount(inside);
        if (inside != first_bits(p.count()) && !rules.stay_there) [[unlikely]]
          find_new_elements(body.locator, e, p, inside, block.points, totals);
      });
  if (totals.changed_element != changed) [[unlikely]]
    field.buffers.left[slot] = 1;
}

/// Of a chunk of elements. Inlined it has not all registers.
template <bool pic, int Dim>
[[gnu::noinline]] void strain_and_move_points(Body<Dim>& body, VelocityField<Dim>& field, Block<Dim>& block,
                                              const exec::Chunk& chunk, const MoveRules& rules,
                                              PointIncrements<Dim>& increments, exec::GapSharing<Dim>* sharing,
                                              StepTotals<Dim>& totals) {
  MotionTotals<Dim> motion;
  for_each_element(body, field, chunk, [&]<class Basis>(Basis, int slot, int e) {
    const int at = block.begin[slot] - block.begin[chunk.slots.first];
    transfer::with_means<Basis>(field.buffers.mean_dilatation[slot] != 0, [&](auto averaged) {
      move_points<pic, Basis>(body, field, block, slot, e, rules, increments, at, averaged, motion, totals);
    });
    if (sharing) sharing->in_element(points_of(block, slot), field.buffers.size[slot], at);
  });
  record(motion.sums, totals);
  totals.search.own += motion.stayed;
  totals.search.elements_examined += motion.stayed;
  if (motion.stayed > 0) totals.search.most_examined = std::max<std::int64_t>(totals.search.most_examined, 1);
}

/// The columns that only some schemes have; σ* starts as the stress it is, and C_p as nothing.
template <int Dim>
void prepare_columns(Body<Dim>& body, VelocityField<Dim>& field, const Scheme& scheme) {
  for (auto& block : field.blocks) {
    auto& points = block.points;
    const bool ahead = scheme::waves(scheme, is_elastic(block.model)).damped();
    for (int c = 0; c < sym_size<Dim>; ++c) {
      const bool works = Dim == 3 || c != 2 || body.mesh->axisymmetric;  // σ_zz does no work in plane strain
      auto& column = points.sigma_ahead[c];
      if (ahead && works && column.empty()) column = points.sigma[c];
      if (!ahead && !column.empty()) column = {};
    }
    for (auto& column : points.C) {
      if (scheme.affine && column.empty()) column.resize(points.mass.size(), 0.0);
      if (!scheme.affine && !column.empty()) column = {};
    }
  }
}

}  // namespace

template <int Dim>
void map_points_to_elements(Body<Dim>& body, VelocityField<Dim>& field, const StepSettings& settings) {
  prepare_columns(body, field, settings.scheme);
  for_each_chunk(field, field.buffers.totals, [&](const exec::Chunk& chunk, StepTotals<Dim>& part) {
    PointBatch<Dim> m_v2(0.0);
    clear_accumulators(chunk, field.buffers.sums, transfer::node_sums<Dim>);
    for_each_element(body, field, chunk, [&]<class Basis>(Basis, int slot, int e) {
      if constexpr (is_simplex<Basis>) field.buffers.patch_share[slot] = {};
      if (settings.scheme.affine) {
        sum_points<Basis>(body, field, transfer::NodePlaces<Basis>(*body.mesh, e), settings, slot, e, m_v2);
      } else {
        sum_points<Basis>(body, field, transfer::NoPlaces{}, settings, slot, e, m_v2);
      }
    });
    part.kinetic_energy_before = 0.5 * xsimd::hadd(m_v2);
  });
  if (uses_patches(body, settings)) add_mean_stresses(body, field);
  gather<transfer::node_sums<Dim>>(field, field.buffers.sums);
}

template <int n, int Dim>
void sum_with_mass_matrix(Body<Dim>& body, VelocityField<Dim>& field, int from) {
  for_each_chunk(field, [&](const exec::Chunk& chunk) {
    clear_accumulators(chunk, field.buffers.momentum, transfer::accumulator_size<n>);
    const transfer::Motion<Dim>* motion = field.nodes.motion.data();
    const double* matrices = field.buffers.mass_matrix.data();
    const int *accumulators = field.assembly.accumulators_of(0), *nodes = field.assembly.nodes_of(0),
              row = field.assembly.row();
    const std::size_t size = mass_matrix_row(row);
    double* momentum = field.buffers.momentum.data();
    for_each_element(body, field, chunk, [&]<class Basis>(Basis, int slot, int e) {
      if constexpr (transfer::keeps_mass_matrix<Basis>) {
        const double* M = matrices + slot * size;
        const int* k_i = nodes + slot * row;
        const auto w = make_array<Basis::nodes>([&](auto i) { return motion[k_i[i]].row.data(); });
        if constexpr (n == Dim) {
          transfer::add_momentum<Basis, n>(M, w, accumulators + slot * row, momentum);
        } else {
          transfer::add_products<Basis>(M, w, accumulators + slot * row, momentum);
        }
      } else {
        add_momentum_of_points<Basis, n>(body, field, slot, e, from);
      }
    });
  });
  gather<transfer::accumulator_size<n>>(field, field.buffers.momentum);
}

template <int Dim>
void strain_and_move(Body<Dim>& body, VelocityField<Dim>& field, Block<Dim>& block, const exec::Chunk& chunk,
                     const MoveRules& rules, PointIncrements<Dim>& increments, exec::GapSharing<Dim>* sharing,
                     StepTotals<Dim>& totals) {
  if (rules.records_pic) {
    strain_and_move_points<true>(body, field, block, chunk, rules, increments, sharing, totals);
  } else {
    strain_and_move_points<false>(body, field, block, chunk, rules, increments, sharing, totals);
  }
}

template <int Dim>
void strain_stress_and_motion(Body<Dim>& body, VelocityField<Dim>& field, double dt, const StepSettings& settings) {
  const auto& scheme = settings.scheme;
  const MoveRules rules = move_rules(scheme, dt, counted(field, &StepTotals<Dim>::massless_nodes) > 0);
  for_each_chunk(field, field.buffers.totals, [&](const exec::Chunk& chunk, StepTotals<Dim>& part) {
    PointIncrements<Dim>& increments = field.buffers.increments[exec::thread_number()];
    for (auto& block : field.blocks) {
      exec::GapSharing<Dim> gaps(block, block.points.volume, increments, body.mesh->axisymmetric ? 3 : Dim, dt);
      auto* sharing = scheme.shares_gaps && gaps.active() ? &gaps : nullptr;
      {
        const Stopwatch<Dim> watch(settings.profile, part, Phase::strain_and_move);
        strain_and_move(body, field, block, chunk, rules, increments, sharing, part);
      }
      const Stopwatch<Dim> watch(settings.profile, part, Phase::stress);
      auto& failed = part.stress.first_failed;
      const auto failed_before = std::exchange(failed, {});
      exec::update_stresses(block, points_of(block, chunk), increments, 0, dt, settings.integration, part.stress,
                            scheme::waves(scheme, is_elastic(block.model), settings.damping));
      failed.region = static_cast<int>(&block - field.blocks.data());
      failed.keep_first(failed_before);
      if (sharing) part.stress.work -= sharing->work(exec::UpdatedColumns<Dim>(block));
    }
  });
  field.changed_element = counted(field, &StepTotals<Dim>::changed_element);
}

template void map_points_to_elements<2>(Body<2>&, VelocityField<2>&, const StepSettings&);
template void map_points_to_elements<3>(Body<3>&, VelocityField<3>&, const StepSettings&);
template void sum_with_mass_matrix<2>(Body<2>&, VelocityField<2>&, int);
template void sum_with_mass_matrix<4>(Body<2>&, VelocityField<2>&, int);
template void sum_with_mass_matrix<3>(Body<3>&, VelocityField<3>&, int);
template void sum_with_mass_matrix<6>(Body<3>&, VelocityField<3>&, int);
template void strain_and_move<2>(Body<2>&, VelocityField<2>&, Block<2>&, const exec::Chunk&, const MoveRules&,
                                 PointIncrements<2>&, exec::GapSharing<2>*, StepTotals<2>&);
template void strain_and_move<3>(Body<3>&, VelocityField<3>&, Block<3>&, const exec::Chunk&, const MoveRules&,
                                 PointIncrements<3>&, exec::GapSharing<3>*, StepTotals<3>&);
template void strain_stress_and_motion<2>(Body<2>&, VelocityField<2>&, double, const StepSettings&);
template void strain_stress_and_motion<3>(Body<3>&, VelocityField<3>&, double, const StepSettings&);

}  // namespace scarp::step
