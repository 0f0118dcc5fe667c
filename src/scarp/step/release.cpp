#include "scarp/step/release.hpp"

#include <cmath>

#include "scarp/step/node_forces.hpp"
#include "scarp/transfer/node_sums.hpp"

namespace scarp {
namespace {

/// What conditions leave of the force on a node at rest: nothing of fixed components, nor of what a wall with friction
/// balances.
template <int Dim>
void take_reaction(const Conditions<Dim>& conditions, int n, Vec<Dim>& F) {
  const int normal = conditions.normal[n];
  const double pressed = normal >= 0 ? -conditions.inward[n] * F[normal] : 0;
  if (pressed > 0) {
    double along2 = 0;
    for (int j = 0; j < Dim; ++j) along2 += j == normal || conditions.fixed[n] & (1u << j) ? 0 : F[j] * F[j];
    const double along = std::sqrt(along2), friction = conditions.friction[n] * pressed;
    for (int j = 0; j < Dim; ++j) {
      if (j == normal)
        F[j] = 0;
      else
        F[j] *= friction < along ? 1 - friction / along : 0;
    }
  }
  for (int j = 0; j < Dim; ++j) {
    if (conditions.fixed[n] & (1u << j)) F[j] = 0;
  }
}

}  // namespace

template <int Dim>
void hold_imbalance(Body<Dim>& body, const StepSettings& settings) {
  for (auto& field : body.fields) {
    prepare_threads(field);
    step::map_points_to_elements(body, field, settings);
    auto& release = field.outside.release;
    release.imbalance.assign(body.mesh->node_count(), {});
    release.mass.assign(body.mesh->node_count(), 0.0);
    release.share = 0;  // what is held back now is no part of what is to be
    for (int k = 0; k < field.assembly.size(); ++k) {
      const auto sums = step::gathered_sums(field, k);
      if (sums.mass() < field.least_mass) continue;
      const int n = field.assembly.node(k);
      Vec<Dim>& F = release.imbalance[n];
      F = step::driving_force<Dim>(body, field, n, sums);
      take_reaction<Dim>(body.conditions, n, F);
      for (double& component : F) component /= sums.mass();
      release.mass[n] = sums.mass();
    }
    release.share = 1;
  }
}

template void hold_imbalance<2>(Body<2>&, const StepSettings&);
template void hold_imbalance<3>(Body<3>&, const StepSettings&);

}  // namespace scarp
