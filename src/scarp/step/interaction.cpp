#include "scarp/step/interaction.hpp"

#include "scarp/base/error.hpp"
#include "scarp/step/node_forces.hpp"

namespace scarp::step {

template <int Dim>
void interact(Body<Dim>& body, double dt, const StepSettings& settings) {
  if (settings.scheme.affine)
    throw RunError("fields do not act on each other in an affine scheme", "affine = true",
                   "take the standard scheme, or the report's");
  for (auto& field : body.fields) field.nodes.push.assign(field.nodes.node.size(), {});
  for (const auto& interaction : body.interactions) interaction->act(body, dt, settings);
}

template <int Dim>
void push(VelocityField<Dim>& field, int k, const std::type_identity_t<Vec<Dim>>& F, double dt,
          const StepSettings& settings) {
  Node<Dim>& node = field.nodes.node[k];
  auto& motion = field.nodes.motion[k];
  const auto& sides = field.outside.sides;
  const int n = field.assembly.node(k);
  const bool slowed = sides.slows(n);
  for (int j = 0; j < Dim; ++j) {
    if (node.held >> j & 1u) continue;
    const double gamma = slowed ? sides.gamma(n, j) : 1;
    const double dv = gamma * F[j] * node.per_mass * dt;
    field.nodes.push[k][j] += F[j];
    if (settings.scheme.two_terms) {
      motion.dv(j) += gamma * dv;
      motion.du(j) += gamma * dv;
    } else {
      motion.dv(j) += dv;  // φ a dt + (1 − φ) ṽ, whatever φ
      field.nodes.a_dt[k][j] += dv;
    }
  }
  node.acted_on = true;
}

template <int Dim>
Vec<Dim> coming_velocity(const VelocityField<Dim>& field, int k, const StepSettings& settings) {
  const auto& motion = field.nodes.motion[k];
  Vec<Dim> v;
  for (int j = 0; j < Dim; ++j) {
    if (settings.scheme.two_terms) {
      v[j] = motion.du(j);
    } else {
      v[j] = field.nodes.node[k].v[j] + (settings.scheme.flip == 1 ? motion.dv(j) : field.nodes.a_dt[k][j]);
    }
  }
  return v;
}

template void interact<2>(Body<2>&, double, const StepSettings&);
template void push<2>(VelocityField<2>&, int, const Vec<2>&, double, const StepSettings&);
template Vec<2> coming_velocity<2>(const VelocityField<2>&, int, const StepSettings&);
template void interact<3>(Body<3>&, double, const StepSettings&);
template void push<3>(VelocityField<3>&, int, const Vec<3>&, double, const StepSettings&);
template Vec<3> coming_velocity<3>(const VelocityField<3>&, int, const StepSettings&);

}  // namespace scarp::step
