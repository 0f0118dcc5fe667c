// Steps 1, 4 to 11 element by element.
#include <algorithm>
#include <bit>
#include <cmath>

#include "scarp/exec/parallel.hpp"
#include "scarp/step/phases.hpp"
#include "scarp/transfer/transfer.hpp"

namespace scarp::step {
namespace {

/// f(first, last, part) for chunks of the active elements.
template <int Dim, class F>
void for_each_chunk(Body<Dim>& body, StepBooks<Dim>& books, F&& f) {
  exec::sum_over_chunks(body.active.size(), element_chunk, body.buffers.books, books, f);
}

/// f(basis, slot, element) for the active elements in some slots.
template <int Dim, class F>
void for_each_element(const Body<Dim>& body, int first, int last, F&& f) {
  with_basis<Dim>(*body.mesh, body.active.element.data(), first, last, f);
}

template <int Dim>
PointRange points_of(const Block<Dim>& block, int slot) {
  return {block.order.data() + block.begin[slot], block.begin[slot + 1] - block.begin[slot]};
}

template <int Dim>
std::size_t row_of(const Body<Dim>& body, int slot) {
  return static_cast<std::size_t>(slot) * body.assembly.row();
}

template <class Basis>
void sum_points(Body<Basis::dim>& body, Quadrature choice, int slot, int e) {
  constexpr int Dim = Basis::dim, Q = transfer::node_sums<Dim>;
  const typename Basis::Cell cell(*body.mesh, e);
  transfer::ElementSums<Basis> sums;
  for (const auto& block : body.blocks) {
    transfer::points_to_nodes<Basis>(cell, block.points, points_of(block, slot), sums);
  }
  transfer::Quadrature<Dim, Basis::nodes> quadrature;
  if constexpr (Basis::corrects) {
    if (choice == Quadrature::corrected && body.buffers.inside[slot]) {
      quadrature = transfer::full_element<Basis>(cell, sums.volume(), sums.gradient());
      transfer::correct<Basis>(sums, quadrature);
    }
  }
  const auto row = row_of(body, slot);
  body.buffers.weight[slot] = quadrature.weight;
  std::copy_n(quadrature.shift.data(), Basis::nodes, body.buffers.shift.data() + row);
  std::copy_n(sums.node.data(), Basis::nodes * Q, body.buffers.sums.data() + row * Q);
}

template <class Basis>
void update_element(Body<Basis::dim>& body, double dt, double flip, int slot, int e,
                    transfer::MotionSums<Basis::dim>& sums) {
  constexpr int Dim = Basis::dim;
  const typename Basis::Cell cell(*body.mesh, e);
  const auto n = body.mesh->element_nodes(e);
  transfer::NodeMotion<Basis> motion;
  for (int i = 0; i < Basis::nodes; ++i) {
    const auto& node = body.buffers.node[n[i]];
    motion.a[i] = node.a;
    if (flip != 1) motion.v[i] = body.buffers.v_next[n[i]];
  }
  alignas(64) std::array<double, whole_batches<PointBatch<Dim>>(Basis::nodes * Dim)> momentum{};
  for (auto& block : body.blocks) {
    transfer::update_velocities<Basis>(cell, motion, dt, flip, block.points, points_of(block, slot), momentum.data(),
                                       sums);
  }
  std::copy_n(momentum.data(), Basis::nodes * Dim, body.buffers.momentum.data() + row_of(body, slot) * Dim);
}

template <int Dim>
void book(const transfer::MotionSums<Dim>& sums, StepBooks<Dim>& books) {
  books.mass = xsimd::hadd(sums.mass);
  books.kinetic_energy = xsimd::hadd(sums.kinetic_energy);
  books.dissipation_pic = xsimd::hadd(sums.taken);
  for (int j = 0; j < Dim; ++j) books.momentum[j] = xsimd::hadd(sums.momentum[j]);
  double fastest2 = 0;
  for (std::size_t l = 0; l < sums.fastest2.size; ++l) fastest2 = std::max(fastest2, sums.fastest2.get(l));
  books.max_velocity = std::sqrt(fastest2);
}

/// Which of a few points, at x now, are still in their element, as bits of lanes; the local coordinates of these are
/// kept where the basis stores them.
template <class Basis, class T>
unsigned still_inside(const typename Basis::Cell& cell, const Lanes<T>& p, const std::array<T, Basis::dim>& x,
                      double tolerance, Points<Basis::dim>& points) {
  const unsigned present = first_bits(p.count());
  if constexpr (Basis::stores_local) {
    std::array<T, Basis::dim> xi;
    for (int j = 0; j < Basis::dim; ++j) xi[j] = p.load(points.xi[j]);
    const auto found = cell.follow(x, xi, [&](const auto& good) { return (bits_of(good) & present) == present; });
    for (int j = 0; j < Basis::dim; ++j) p.store(xi[j], points.xi[j]);  // those not inside get theirs later
    return bits_of(found && cell.inside(xi, tolerance)) & present;
  } else {
    return bits_of(cell.inside(cell.local(x), tolerance)) & present;
  }
}

/// Step 11 for a few points that were in element e: most still are.
template <class Basis, class T>
void find_elements(const Locator<Basis::dim>& locator, const typename Basis::Cell& cell, int e, const Lanes<T>& p,
                   const std::array<T, Basis::dim>& x, Points<Basis::dim>& points, StepBooks<Basis::dim>& books) {
  const unsigned inside = still_inside<Basis>(cell, p, x, locator.tolerance(), points);
  const int count = std::popcount(inside);
  books.search.own += count;
  books.search.elements_examined += count;
  books.search.most_examined = std::max<std::int64_t>(books.search.most_examined, 1);
  if (count == p.count()) [[likely]]
    return;
  for (int l = 0; l < p.count(); ++l) {
    if (inside >> l & 1u) continue;
    const int i = p.point(l);
    Vec<Basis::dim> at;
    for (int j = 0; j < Basis::dim; ++j) at[j] = points.x[j][i];
    const auto place = locator.find(at, e, books.search);
    books.changed_element += place.element != e;
    books.left_mesh += place.element < 0;
    points.element[i] = place.element;
    for (int j = 0; j < Basis::dim && !points.xi[j].empty(); ++j) points.xi[j][i] = place.xi[j];
  }
}

/// Steps 6, 8, 9, 10 and 11 for the points of a block in some elements.
template <int Dim>
void strain_and_move(Body<Dim>& body, Block<Dim>& block, int first, int last, double dt, Strains<Dim>& strains,
                     StepBooks<Dim>& books) {
  for_each_element(body, first, last, [&]<class Basis>(Basis, int slot, int e) {
    const typename Basis::Cell cell(*body.mesh, e);
    const auto n = body.mesh->element_nodes(e);
    transfer::Quadrature<Dim, Basis::nodes> quadrature{body.buffers.weight[slot], {}};
    std::copy_n(body.buffers.shift.data() + row_of(body, slot), Basis::nodes, quadrature.shift.data());
    std::array<Vec<Dim>, Basis::nodes> du_i;
    for (int i = 0; i < Basis::nodes; ++i) {
      for (int j = 0; j < Dim; ++j) du_i[i][j] = body.buffers.node[n[i]].v[j] * dt;
    }
    transfer::nodes_to_points<Basis>(cell, quadrature, du_i, body.mesh->size[e], block.points, points_of(block, slot),
                                     strains, block.begin[slot] - block.begin[first],
                                     [&](const auto&, const auto& p, const auto& x) {
                                       find_elements<Basis>(body.locator, cell, e, p, x, block.points, books);
                                     });
  });
}

}  // namespace

template <int Dim>
void map_points_to_elements(Body<Dim>& body, Quadrature choice, StepBooks<Dim>& books) {
  for_each_chunk(body, books, [&](int first, int last, StepBooks<Dim>&) {
    for_each_element(body, first, last,
                     [&]<class Basis>(Basis, int slot, int e) { sum_points<Basis>(body, choice, slot, e); });
  });
}

template <int Dim>
void update_velocities(Body<Dim>& body, double dt, double flip, StepBooks<Dim>& books) {
  for_each_chunk(body, books, [&](int first, int last, StepBooks<Dim>& part) {
    transfer::MotionSums<Dim> sums;
    for_each_element(body, first, last, [&]<class Basis>(Basis, int slot, int e) {
      update_element<Basis>(body, dt, flip, slot, e, sums);
    });
    book(sums, part);
  });
}

template <int Dim>
void strain_stress_and_motion(Body<Dim>& body, double dt, const StepSettings& settings, StepBooks<Dim>& books) {
  for_each_chunk(body, books, [&](int first, int last, StepBooks<Dim>& part) {
    Strains<Dim>& strains = body.buffers.strains[exec::thread_number()];
    for (auto& block : body.blocks) {
      {
        const Stopwatch<Dim> watch(settings.profile, part, Phase::strain_and_move);
        strain_and_move(body, block, first, last, dt, strains, part);
      }
      const Stopwatch<Dim> watch(settings.profile, part, Phase::stress);
      const PointRange range{block.order.data() + block.begin[first], block.begin[last] - block.begin[first]};
      exec::update_stresses(block, range, strains, 0, dt, settings.integration, part.stress);
    }
  });
  books.work_stress = books.stress.work;
}

template void map_points_to_elements<2>(Body<2>&, Quadrature, StepBooks<2>&);
template void map_points_to_elements<3>(Body<3>&, Quadrature, StepBooks<3>&);
template void update_velocities<2>(Body<2>&, double, double, StepBooks<2>&);
template void update_velocities<3>(Body<3>&, double, double, StepBooks<3>&);
template void strain_stress_and_motion<2>(Body<2>&, double, const StepSettings&, StepBooks<2>&);
template void strain_stress_and_motion<3>(Body<3>&, double, const StepSettings&, StepBooks<3>&);

}  // namespace scarp::step
