#include "scarp/step/body.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <limits>
#include <numeric>

#include "scarp/base/error.hpp"
#include "scarp/comm/alone.hpp"
#include "scarp/exec/arrange.hpp"
#include "scarp/exec/parallel.hpp"
#include "scarp/mesh/chunks.hpp"
#include "scarp/mesh/with_basis.hpp"
#include "scarp/transfer/quadrature.hpp"

namespace scarp {

namespace {

/// The most numbers that an element of the mesh stores of its quadrature's correction.
template <int Dim>
std::size_t largest_correction(const Mesh<Dim>& mesh) {
  std::vector<int> elements(mesh.grid ? 1 : static_cast<std::size_t>(mesh.element_count()));  // all are alike in a grid
  std::iota(elements.begin(), elements.end(), 0);
  int most = 0;
  with_basis<Dim>(mesh, elements.data(), 0, static_cast<int>(elements.size()), [&]<class Basis>(Basis, int, int) {
    most = std::max(most, transfer::GradientCorrection<Basis>::size);
  });
  return static_cast<std::size_t>(most);
}

/// B̄_i that a cell of GIMP keeps.
template <int Dim>
std::size_t mean_gradient_row(const Mesh<Dim>& mesh) {
  return mesh.grid && mesh.grid->functions == GridFunctions::gimp ? transfer::Means<GridGimp<Dim>>::size : 0;
}

/// Of each node, Σ V_e / K_e over the elements around it, which have K_e nodes.
template <int Dim>
Column volumes_of_nodes(const Mesh<Dim>& mesh) {
  Column volume(mesh.node_count(), 0.0);
  std::vector<int> elements(mesh.element_count());
  std::iota(elements.begin(), elements.end(), 0);
  with_basis<Dim>(mesh, elements.data(), 0, mesh.element_count(), [&]<class Basis>(Basis, int, int e) {
    const typename Basis::Cell cell(mesh, e);
    const double share = transfer::Means<Basis>(cell).V / Basis::nodes;
    for (const int n : mesh.element_nodes(e)) volume[n] += share;
  });
  return volume;
}

}  // namespace

template <int Dim>
Body<Dim>::Body(std::unique_ptr<const Mesh<Dim>> background, const Vec<Dim>& gravitational_acceleration)
    : mesh(std::move(background)),
      patches(*mesh),
      locator(*mesh),
      conditions(mesh->node_count()),
      gravity(gravitational_acceleration) {
  add_field("soil");
  if (!patches.empty()) full_volume = volumes_of_nodes(*mesh);
}

template <int Dim>
VelocityField<Dim>& Body<Dim>::add_field(std::string name) {
  auto& field = fields.emplace_back();
  field.name = std::move(name);
  field.buffers.correction_row = largest_correction(*mesh);
  return field;
}

template <int Dim>
int Body<Dim>::point_count() const {
  int count = 0;
  for (const auto& field : fields) count += field.point_count();
  return count;
}

namespace {

/// Soil that spreads allocates nothing in its steps: there is room for four times as many active elements. What is not
/// used costs no memory.
template <int Dim>
void make_room(const Body<Dim>& body, VelocityField<Dim>& field) {
  const auto elements = std::min(static_cast<std::size_t>(body.mesh->element_count()),
                                 4 * static_cast<std::size_t>(field.active.size()) + 1000);
  const auto row = static_cast<std::size_t>(field.assembly.row()), accumulators = elements * row;
  const auto padded = padded_row(field.assembly.row());
  for (auto& block : field.blocks) reserve_order(block, elements);
  field.active.reserve(elements);
  field.assembly.reserve(elements, row);
  auto& buffers = field.buffers;
  buffers.inside.reserve(elements);
  buffers.size.reserve(elements);
  buffers.weight.reserve(elements);
  buffers.mean_dilatation.reserve(elements);
  buffers.left.reserve(elements);
  buffers.mean_gradient.reserve(elements * mean_gradient_row(*body.mesh));
  if (!body.patches.empty()) {
    buffers.patch_share.reserve(elements);
    buffers.bounds.filled.reserve(elements);
    buffers.bounds.due.reserve(body.mesh->element_count());
  }
  buffers.changed.reserve(body.mesh->element_count());
  buffers.is_changed.resize(body.mesh->element_count());
  buffers.correction.reserve(elements * buffers.correction_row);
  if (body.mesh->axisymmetric) buffers.hoop_correction.reserve(elements * padded);
  buffers.mass_matrix.reserve(elements * mass_matrix_row(field.assembly.row()));
  buffers.sums.reserve(accumulators * transfer::node_sums<Dim>);
  buffers.momentum.reserve(accumulators * transfer::momentum_size<Dim>);
  const auto nodes = std::min(accumulators, static_cast<std::size_t>(body.mesh->node_count()));
  field.nodes.reserve(nodes);
  if (!body.patches.empty()) buffers.bounds.stiffness.reserve(nodes);
}

}  // namespace

namespace {

/// Points on a line between elements go to that with the most points inside: at the edge of a body to the element that
/// it fills, of which every node has mass.
template <int Dim>
void prefer_full_elements(const Body<Dim>& body, VelocityField<Dim>& field) {
  struct OnLine {
    Block<Dim>* block;
    int i;
    std::vector<int> elements;
  };
  std::vector<OnLine> on_line;
  ZeroPages<int> inside(body.mesh->element_count());
  for (auto& block : field.blocks) {
    for (int i = 0; i < block.size(); ++i) {
      const int e = block.points.element[i];
      auto elements = body.locator.elements_at(position_of(block.points, i), e);
      if (elements.size() == 1) {
        ++inside[e];
      } else {
        on_line.push_back({&block, i, std::move(elements)});
      }
    }
  }
  for (const auto& [block, i, elements] : on_line) {
    auto& points = block->points;
    points.element[i] = *std::max_element(elements.begin(), elements.end(),
                                          [&](int a, int b) { return inside[a] < inside[b]; });  // the first of equals
    if (points.xi[0].empty()) continue;
    SearchCounts unused;
    const auto found = body.locator.find(position_of(points, i), points.element[i], unused);
    for (int j = 0; j < Dim; ++j) points.xi[j][i] = found.xi[j];
  }
}

}  // namespace

namespace {

template <int Dim>
void locate_points(const Body<Dim>& body, VelocityField<Dim>& field, bool prefer_full) {
  double lightest = std::numeric_limits<double>::infinity();
  for (auto& block : field.blocks) {
    auto& points = block.points;
    if (!body.mesh->grid) {
      for (auto& column : points.xi) column.resize(block.size());
    }
    points.x_start = points.x;
    exec::for_each(block.size(), [&](int i) {
      Vec<Dim> x;
      for (int j = 0; j < Dim; ++j) x[j] = points.x[j][i];
      const auto found = body.locator.find_anywhere(x);
      points.element[i] = found.element;
      for (int j = 0; j < Dim && !body.mesh->grid; ++j) points.xi[j][i] = found.xi[j];
    });
    const auto lost = std::find(points.element.begin(), points.element.end(), -1);
    if (lost != points.element.end()) {
      Vec<Dim> x;
      for (int j = 0; j < Dim; ++j) x[j] = points.x[j][lost - points.element.begin()];
      throw InputError(fmt::format("the mesh does not hold the soil: region \"{}\" has a point outside it", block.name),
                       fmt::format("a point at ({:.6g})", fmt::join(x, ", ")),
                       "extend the mesh over the region, or move the region into the mesh");
    }
    for (const double m : points.mass) lightest = std::min(lightest, m);
  }
  if (prefer_full) prefer_full_elements(body, field);
  field.least_mass = 1e-12 * comm::least_of_all(lightest);
}

}  // namespace

template <int Dim>
void take_up_points(Body<Dim>& body) {
  for (auto& field : body.fields) {
    reorder(body, field);
    make_room(body, field);
    exec::arrange_in_new_memory(field.blocks);
    field.out_of_place = 0;
  }
}

template <int Dim>
void locate_points(Body<Dim>& body, bool prefer_full) {
  for (auto& field : body.fields) locate_points<Dim>(body, field, prefer_full);
  take_up_points(body);
}

namespace {

/// Marks the elements whose bound by nodes is to be found at once (NodeBounds).
template <int Dim>
void note_changes_around(const Body<Dim>& body, VelocityField<Dim>& field) {
  auto& bounds = field.buffers.bounds;
  bounds.least_per_mass.resize(body.mesh->element_count(), 0.0);
  bounds.is_due.resize(body.mesh->element_count());
  const auto note = [&](int e) {
    if (!bounds.is_due[e]) bounds.due.push_back(e);
    bounds.is_due[e] = 1;
  };
  const auto note_all = [&](int e) {
    note(e);
    for (const int other : body.mesh->elements_around(e)) note(other);
  };
  for (const auto& fresh : field.active.fresh) note_all(fresh.element);
  for (const int e : field.active.emptied) note_all(e);
}

/// What belongs to the set of active elements.
template <int Dim>
void rebuild(const Body<Dim>& body, VelocityField<Dim>& field) {
  auto& buffers = field.buffers;
  const auto& active = field.active;
  field.assembly.rebuild(*body.mesh, active);
  const auto slots = static_cast<std::size_t>(active.size()), accumulators = field.assembly.accumulators(),
             nodes = static_cast<std::size_t>(field.assembly.size());
  buffers.inside.resize(slots);
  buffers.size.resize(slots);
  for (int slot = 0; slot < active.size(); ++slot) {
    const int e = active.element[slot];
    buffers.size[slot] = body.mesh->size_of(e);
    const auto around = body.mesh->elements_around(e);
    buffers.inside[slot] =
        std::all_of(around.begin(), around.end(), [&](int other) { return active.slot[other] >= 0; });
  }
  buffers.weight.assign(slots, 1.0);
  buffers.mean_dilatation.assign(slots, 0);
  buffers.left.assign(slots, 0);
  buffers.mean_gradient.resize(slots * mean_gradient_row(*body.mesh));
  if (!body.patches.empty()) {
    buffers.patch_share.assign(slots, {});
    buffers.bounds.filled.assign(slots, 0.0);
    buffers.bounds.stiffness.resize(nodes);
    note_changes_around(body, field);
  }
  buffers.correction.resize(slots * buffers.correction_row);
  if (body.mesh->axisymmetric) buffers.hoop_correction.resize(slots * padded_row(field.assembly.row()));
  buffers.mass_matrix.resize(slots * mass_matrix_row(field.assembly.row()));
  buffers.sums.resize(accumulators * transfer::node_sums<Dim>);
  buffers.momentum.resize(accumulators * transfer::momentum_size<Dim>);
  field.nodes.resize(nodes);
}

}  // namespace

template <int Dim>
void prepare_threads(VelocityField<Dim>& field) {
  int most = 0;
  for (const auto& block : field.blocks) {
    for (int c = 0; c < field.assembly.chunks(); ++c) {
      const auto slots = field.assembly.chunk(c).slots;
      most = std::max(most, block.begin[slots.last] - block.begin[slots.first]);
    }
  }
  auto& increments = field.buffers.increments;
  const auto threads = static_cast<std::size_t>(exec::thread_count());
  if (increments.size() < threads) increments.resize(threads);
  for (auto& of_thread : increments) of_thread.reserve(most);
  if (field.buffers.totals.size() < threads) field.buffers.totals.resize(threads);
}

template <int Dim>
void reorder(const Body<Dim>& body, VelocityField<Dim>& field) {
  const auto chunk = [&mesh = *body.mesh](int e) { return chunk_of(mesh, e); };
  if (sort_by_element<Dim>(field.blocks, body.mesh->element_count(), chunk, field.active)) rebuild(body, field);
  prepare_threads(field);
}

template <int Dim>
void reorder(Body<Dim>& body) {
  for (auto& field : body.fields) reorder<Dim>(body, field);
}

template struct Body<2>;
template struct Body<3>;
template void take_up_points<2>(Body<2>&);
template void take_up_points<3>(Body<3>&);
template void locate_points<2>(Body<2>&, bool);
template void locate_points<3>(Body<3>&, bool);
template void reorder<2>(Body<2>&);
template void reorder<3>(Body<3>&);
template void reorder<2>(const Body<2>&, VelocityField<2>&);
template void reorder<3>(const Body<3>&, VelocityField<3>&);
template void prepare_threads<2>(VelocityField<2>&);
template void prepare_threads<3>(VelocityField<3>&);

}  // namespace scarp
