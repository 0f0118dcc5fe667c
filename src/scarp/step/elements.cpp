// Steps 1, 4 to 11 element by element.
#include <algorithm>
#include <bit>
#include <cmath>

#include "scarp/exec/parallel.hpp"
#include "scarp/mesh/with_basis.hpp"
#include "scarp/step/phases.hpp"
#include "scarp/transfer/transfer.hpp"

namespace scarp::step {
namespace {

/// f(first, last, part) for chunks of the active elements.
template <int Dim, class F>
void for_each_chunk(Body<Dim>& body, int chunk, StepBooks<Dim>& books, F&& f) {
  exec::sum_over_chunks(body.active.size(), chunk, body.buffers.books, books, f);
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

template <class Basis>
SCARP_FLATTEN void sum_points(Body<Basis::dim>& body, Quadrature choice, int slot, int e) {
  const typename Basis::Cell cell(*body.mesh, e);
  const transfer::ShapesAtPoints<Basis> shapes(cell);
  transfer::ElementSums<Basis> sums;
  for (const auto& block : body.blocks) {
    transfer::points_to_nodes<Basis>(shapes, block.points, points_of(block, slot), sums);
  }
  auto& buffers = body.buffers;
  transfer::Quadrature<Basis> quadrature;
  if constexpr (Basis::corrects) {
    if (choice == Quadrature::corrected && buffers.inside[slot]) {
      quadrature =
          transfer::full_element<Basis>(cell, xsimd::hadd(sums.Omega), sums.shift, transfer::totals<Basis>(sums.hoop));
    }
  }
  buffers.weight[slot] = quadrature.weight;
  quadrature.shift.store(buffers.shift.data() + slot * buffers.shift_row);
  if constexpr (is_axisymmetric<Basis>) {
    transfer::store_nodal<Basis>(quadrature.hoop_shift[0],
                                 buffers.hoop_shift.data() + slot * padded_row(body.assembly.row()));
  }
  if constexpr (transfer::keeps_mass_matrix<Basis>) {
    transfer::store_mass_matrix(sums, buffers.mass_matrix.data() + slot * mass_matrix_row(body.assembly.row()));
  }
  transfer::add_to_nodes<Basis>(sums, transfer::internal_force<Basis>(sums, quadrature), body.assembly.places_of(slot),
                                buffers.sums.data());
}

/// The Motion of the local nodes of an element.
template <class Basis>
transfer::NodeRows<Basis> motion_of_nodes(const Body<Basis::dim>& body, int e) {
  const int* n = body.mesh->element_nodes(e).data();
  transfer::NodeRows<Basis> rows;
  for (int i = 0; i < Basis::nodes; ++i) rows[i] = body.buffers.motion[n[i]].row.data();
  return rows;
}

template <class Basis>
SCARP_FLATTEN void add_momentum(Body<Basis::dim>& body, int slot, int e) {
  const auto motion = motion_of_nodes<Basis>(body, e);
  const int* places = body.assembly.places_of(slot);
  double* momentum = body.buffers.momentum.data();
  if constexpr (transfer::keeps_mass_matrix<Basis>) {
    transfer::add_momentum<Basis>(body.buffers.mass_matrix.data() + slot * mass_matrix_row(body.assembly.row()), motion,
                                  places, momentum);
  } else {
    const typename Basis::Cell cell(*body.mesh, e);
    for (const auto& block : body.blocks) {
      transfer::add_momentum<Basis>(cell, block.points, points_of(block, slot), motion, places, momentum);
    }
  }
}

/// Zero in the places of the elements from slot `first` on, n numbers each.
template <int Dim>
void clear_places(const Body<Dim>& body, int first, Column& numbers, int n) {
  const int chunk = first / body.assembly.chunk();
  std::fill(numbers.begin() + static_cast<std::ptrdiff_t>(body.assembly.first_place(chunk)) * n,
            numbers.begin() + static_cast<std::ptrdiff_t>(body.assembly.last_place(chunk)) * n, 0.0);
}

template <int Dim>
void book(const transfer::MotionSums<Dim>& sums, StepBooks<Dim>& books) {
  books.mass += xsimd::hadd(sums.mass);
  books.kinetic_energy += 0.5 * xsimd::hadd(sums.kinetic_energy);
  books.dissipation_pic += 0.5 * xsimd::hadd(sums.taken);
  for (int j = 0; j < Dim; ++j) books.momentum[j] += xsimd::hadd(sums.momentum[j]);
  double fastest2 = 0;
  for (std::size_t l = 0; l < sums.fastest2.size; ++l) fastest2 = std::max(fastest2, sums.fastest2.get(l));
  books.max_velocity = std::max(books.max_velocity, std::sqrt(fastest2));
}

/// Which of a few points, at x now, are still in their element, as bits of lanes; the local coordinates of these are
/// kept where the basis stores them.
template <class Basis, class Lanes, class T, class Before>
unsigned still_inside(const typename Basis::Cell& cell, const Lanes& p, const std::array<T, Basis::dim>& x,
                      const Before& before, double tolerance, Points<Basis::dim>& points) {
  const unsigned present = first_bits(p.count());
  if constexpr (Basis::stores_local) {
    std::array<T, Basis::dim> xi;
    auto found = before.follow(x, xi);
    if ((bits_of(found) & present) != present) [[unlikely]] {
      for (int j = 0; j < Basis::dim; ++j) xi[j] = p.load(points.xi[j]);
      found = cell.follow(x, xi, [&](const auto& good) { return (bits_of(good) & present) == present; });
    }
    for (int j = 0; j < Basis::dim; ++j) p.store(xi[j], points.xi[j]);  // those not inside get theirs later
    return bits_of(found && cell.inside(xi, tolerance)) & present;
  } else {
    return bits_of(cell.inside(cell.local(x), tolerance)) & present;
  }
}

/// Step 11 for those of a few points that are not `inside` element e any more.
template <int Dim, class Lanes>
[[gnu::noinline]] void find_new_elements(const Locator<Dim>& locator, int e, const Lanes& p, unsigned inside,
                                         Points<Dim>& points, StepBooks<Dim>& books) {
  for (int l = 0; l < p.count(); ++l) {
    if (inside >> l & 1u) continue;
    const int i = p.point(l);
    const auto place = locator.find(position_of(points, i), e, books.search);
    books.changed_element += place.element != e;
    books.left_mesh += place.element < 0;
    points.element[i] = place.element;
    for (int j = 0; j < Dim && !points.xi[j].empty(); ++j) points.xi[j][i] = place.xi[j];
  }
}

/// What the sweep of steps 4 and 6 to 11 adds up over a chunk.
template <int Dim>
struct MotionBooks {
  transfer::MotionSums<Dim> sums;
  std::int64_t stayed = 0;  ///< points that did not leave their element
};

/// Steps 4, 6, 8, 9, 10 and 11 for the points of a block in an element.
template <bool pic, class Basis>
SCARP_FLATTEN void move_points(Body<Basis::dim>& body, Block<Basis::dim>& block, int slot, int e, double flip,
                               Strains<Basis::dim>& strains, int at, MotionBooks<Basis::dim>& motion,
                               StepBooks<Basis::dim>& books) {
  const typename Basis::Cell cell(*body.mesh, e);
  transfer::ElementMotion<Basis> element{motion_of_nodes<Basis>(body, e),
                                         {},
                                         body.buffers.shift.data() + slot * body.buffers.shift_row,
                                         body.buffers.weight[slot],
                                         body.mesh->size[e],
                                         nullptr};
  if constexpr (is_axisymmetric<Basis>) {
    element.hoop_shift = body.buffers.hoop_shift.data() + slot * padded_row(body.assembly.row());
  }
  if constexpr (pic) {
    const int* n = body.mesh->element_nodes(e).data();
    for (int i = 0; i < Basis::nodes; ++i) element.a_dt[i] = body.buffers.a_dt[n[i]].data();
  }
  transfer::nodes_to_points<pic, Basis>(cell, element, flip, block.points, points_of(block, slot), strains, at,
                                        motion.sums, [&](const auto& p, const auto& x, const auto& before) {
                                          const unsigned inside = still_inside<Basis>(
                                              cell, p, x, before, body.locator.tolerance(), block.points);
                                          motion.stayed += std::popcount(inside);
                                          if (inside != first_bits(p.count())) [[unlikely]]
                                            find_new_elements(body.locator, e, p, inside, block.points, books);
                                        });
}

template <bool pic, int Dim>
void strain_and_move(Body<Dim>& body, Block<Dim>& block, int first, int last, double flip, Strains<Dim>& strains,
                     StepBooks<Dim>& books) {
  MotionBooks<Dim> motion;
  for_each_element(body, first, last, [&]<class Basis>(Basis, int slot, int e) {
    move_points<pic, Basis>(body, block, slot, e, flip, strains, block.begin[slot] - block.begin[first], motion, books);
  });
  book(motion.sums, books);
  books.search.own += motion.stayed;
  books.search.elements_examined += motion.stayed;
  if (motion.stayed > 0) books.search.most_examined = std::max<std::int64_t>(books.search.most_examined, 1);
}

}  // namespace

template <int Dim>
void map_points_to_elements(Body<Dim>& body, Quadrature choice, StepBooks<Dim>& books) {
  for_each_chunk(body, body.assembly.chunk(), books, [&](int first, int last, StepBooks<Dim>&) {
    clear_places(body, first, body.buffers.sums, transfer::node_sums<Dim>);
    for_each_element(body, first, last,
                     [&]<class Basis>(Basis, int slot, int e) { sum_points<Basis>(body, choice, slot, e); });
  });
}

template <int Dim>
void change_momentum(Body<Dim>& body, StepBooks<Dim>& books) {
  for_each_chunk(body, body.assembly.chunk(), books, [&](int first, int last, StepBooks<Dim>&) {
    clear_places(body, first, body.buffers.momentum, transfer::momentum_size<Dim>);
    for_each_element(body, first, last,
                     [&]<class Basis>(Basis, int slot, int e) { add_momentum<Basis>(body, slot, e); });
  });
}

template <int Dim>
void strain_stress_and_motion(Body<Dim>& body, double dt, const StepSettings& settings, StepBooks<Dim>& books) {
  for_each_chunk(body, element_chunk, books, [&](int first, int last, StepBooks<Dim>& part) {
    Strains<Dim>& strains = body.buffers.strains[exec::thread_number()];
    for (auto& block : body.blocks) {
      {
        const Stopwatch<Dim> watch(settings.profile, part, Phase::strain_and_move);
        if (settings.flip == 1) {
          strain_and_move<false>(body, block, first, last, settings.flip, strains, part);
        } else {
          strain_and_move<true>(body, block, first, last, settings.flip, strains, part);
        }
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
template void change_momentum<2>(Body<2>&, StepBooks<2>&);
template void change_momentum<3>(Body<3>&, StepBooks<3>&);
template void strain_stress_and_motion<2>(Body<2>&, double, const StepSettings&, StepBooks<2>&);
template void strain_stress_and_motion<3>(Body<3>&, double, const StepSettings&, StepBooks<3>&);

}  // namespace scarp::step
