#include "scarp/step/patches.hpp"

#include "scarp/step/chunks.hpp"
#include "scarp/step/element.hpp"
#include "scarp/step/phases.hpp"
#include "scarp/transfer/means.hpp"

namespace scarp::step {
namespace {

/// f(basis, slot, element, its Means) for the elements of F.
template <int Dim, class F>
void for_each_simplex(Body<Dim>& body, VelocityField<Dim>& field, F&& f) {
  for_each_chunk(field, [&](const exec::Chunk& chunk) {
    for_each_element(body, field, chunk, [&]<class Basis>(Basis basis, int slot, int e) {
      if constexpr (is_simplex<Basis>) {
        if (!field.buffers.mean_dilatation[slot]) return;
        const typename Basis::Cell cell(*body.mesh, e);
        f(basis, slot, e, transfer::Means<Basis>(cell));
      }
    });
  });
}

/// F_i += Vp B̄_i, in a body of revolution also of N_i / r.
template <class Basis>
void add_force(const transfer::Means<Basis>& means, double Vp, const int* accumulator, double* nodes) {
  constexpr int Dim = Basis::dim;
  using Sums = transfer::NodeSums<Dim>;
  double B[transfer::nodal_size<Basis>];
  const auto add = [&](const transfer::Nodal<Basis>& of_nodes, int j) {
    transfer::store_nodal<Basis>(of_nodes, B);
    for (int i = 0; i < Basis::nodes; ++i)
      nodes[static_cast<std::size_t>(accumulator[i]) * Sums::size + Sums::internal_force_at + j] += Vp * B[i];
  };
  for (int j = 0; j < Dim; ++j) add(means.gradient[j], j);
  if constexpr (is_axisymmetric<Basis>) add(means.hoop[0], 0);
}

}  // namespace

template <int Dim>
void add_mean_stresses(Body<Dim>& body, VelocityField<Dim>& field) {
  auto& buffers = field.buffers;
  for_each_simplex(body, field, [&]<class Basis>(Basis, int slot, int e, const transfer::Means<Basis>& means) {
    const double Vp = buffers.patch_share[slot].V * mean_over_patch(body, field, e, &PatchShare::p);
    add_force<Basis>(means, Vp, field.assembly.accumulators_of(slot), buffers.sums.data());
  });
}

template <int Dim>
void find_dilations(Body<Dim>& body, VelocityField<Dim>& field, const StepSettings& settings) {
  const bool mends = settings.scheme.mends_massless && counted(field, &StepTotals<Dim>::massless_nodes) > 0;
  for_each_simplex(body, field, [&]<class Basis>(Basis, int slot, int, const transfer::Means<Basis>& means) {
    auto motion = motion_of_nodes<Basis>(field, slot);
    transfer::Motion<Dim> mean_motion;
    if (mends) mend_massless<Basis>(field, slot, motion, mean_motion);
    field.buffers.patch_share[slot].theta = transfer::mean_dilation<Basis>(means, motion);
  });
}

template void add_mean_stresses<2>(Body<2>&, VelocityField<2>&);
template void add_mean_stresses<3>(Body<3>&, VelocityField<3>&);
template void find_dilations<2>(Body<2>&, VelocityField<2>&, const StepSettings&);
template void find_dilations<3>(Body<3>&, VelocityField<3>&, const StepSettings&);

}  // namespace scarp::step
