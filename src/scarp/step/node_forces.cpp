#include "scarp/step/node_forces.hpp"

#include <cmath>

namespace scarp::step {

template <int Dim>
ForceAndAcceleration<Dim> resisted_by(Body<Dim>& body, VelocityField<Dim>& field, int k, double dt,
                                      const StepSettings& settings, ForceAndAcceleration<Dim> of) {
  auto& [F, a] = of;
  const int n = field.assembly.node(k);
  const auto& sides = field.outside.sides;
  const double damping = settings.damping;
  Node<Dim>& node = field.nodes.node[k];
  Resistance<Dim>& resistance = field.nodes.resistance[k];
  // A wall takes the force along its normal: none of it is out of balance, and friction must not feel it damped.
  const bool pressed =
      settings.scheme.wall == WallRule::by_motion && reaches_wall<Dim>(body.conditions, n, node.v, dt, a);
  resistance = {};
  for (int j = 0; j < Dim; ++j) {
    if (damping != 0 && node.v[j] != 0 && !(pressed && j == body.conditions.normal[n])) {
      resistance.F_damping[j] = -damping * std::abs(F[j]) * scheme::direction(settings.scheme, node.v[j], a[j] * dt);
    }
    a[j] = (F[j] + resistance.F_damping[j]) * node.per_mass;
  }
  if (sides.holds(n)) sides.damp(n, node.m, node.v, dt, a, resistance.F_dashpot);
  if (!is_free(body.conditions, n)) {
    const Vec<Dim> free = a;
    const auto reaction = constrain_acceleration<Dim>(body.conditions, settings.scheme.wall, n, node.m, node.v, dt, a);
    node.held = reaction.held;
    resistance.F_friction = reaction.friction;
    for (int j = 0; j < Dim; ++j) resistance.F_reaction[j] = node.m * (a[j] - free[j]);
  }
  for (int j = 0; j < Dim; ++j) {
    if (node.held & (1u << j)) resistance.F_damping[j] = 0;
    F[j] = node.held & (1u << j) ? 0 : node.m * a[j] - resistance.F_damping[j];
  }
  if (sides.slows(n)) {  // m a and the friction in it are γ times forces on the node
    for (int j = 0; j < Dim; ++j) {
      const double gamma = sides.gamma(n, j);
      resistance.F_friction[j] /= gamma;
      resistance.F_reaction[j] /= gamma;
      if (!(node.held & (1u << j))) F[j] = node.m * a[j] / gamma - resistance.F_damping[j];
    }
  }
  return of;
}

template <int Dim>
Vec<Dim> constrained(const Body<Dim>& body, const VelocityField<Dim>& field, int k, const Scheme& scheme, Vec<Dim> v) {
  constrain_velocity<Dim>(body.conditions, scheme.wall, field.assembly.node(k), field.nodes.node[k].held, v);
  return v;
}

template <int Dim>
void record_work_of_others(Body<Dim>& body, VelocityField<Dim>& field, int k, const StepSettings& settings,
                           unsigned components, Vec<Dim> path, StepTotals<Dim>& totals) {
  const Node<Dim>& node = field.nodes.node[k];
  const int n = field.assembly.node(k);
  auto& outside = field.outside;
  if (outside.sides.slows(n)) outside.sides.slow_down(n, path);
  if (is_resisted(body, field, n, settings.damping)) {
    const auto& resistance = field.nodes.resistance[k];
    for (int j = 0; j < Dim; ++j) {
      if (!(components >> j & 1u)) continue;
      totals.dissipation_damping -= resistance.F_damping[j] * path[j];
      totals.dissipation_friction -= resistance.F_friction[j] * path[j];
    }
  }
  const bool pushed = !field.nodes.push.empty();
  if (!outside.active() && !pushed) return;
  const unsigned set = set_components(body.conditions, settings.scheme.wall, n, node.held) | ~components;
  if (outside.active()) {
    outside.record_works(n, node.m, set, field.nodes.resistance[k].F_dashpot, path, totals);
  }
  for (int j = 0; j < Dim && pushed; ++j) {
    if (!(set >> j & 1u)) totals.work_interaction += field.nodes.push[k][j] * path[j];
  }
}

template ForceAndAcceleration<2> resisted_by<2>(Body<2>&, VelocityField<2>&, int, double, const StepSettings&,
                                                ForceAndAcceleration<2>);
template ForceAndAcceleration<3> resisted_by<3>(Body<3>&, VelocityField<3>&, int, double, const StepSettings&,
                                                ForceAndAcceleration<3>);
template Vec<2> constrained<2>(const Body<2>&, const VelocityField<2>&, int, const Scheme&, Vec<2>);
template Vec<3> constrained<3>(const Body<3>&, const VelocityField<3>&, int, const Scheme&, Vec<3>);
template void record_work_of_others<2>(Body<2>&, VelocityField<2>&, int, const StepSettings&, unsigned, Vec<2>,
                                       StepTotals<2>&);
template void record_work_of_others<3>(Body<3>&, VelocityField<3>&, int, const StepSettings&, unsigned, Vec<3>,
                                       StepTotals<3>&);

}  // namespace scarp::step
