// Steps 2, 3 and 5 at the nodes.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "scarp/step/chunks.hpp"
#include "scarp/step/node_forces.hpp"
#include "scarp/transfer/node_values.hpp"

namespace scarp::step {
namespace {

/// a b + c, in one rounding where the processor has that: what of the report's scheme would else be rounded as the
/// compiler sees fit.
inline double fused(double a, double b, double c) {
#if defined(__FMA__)
  return std::fma(a, b, c);
#else
  return a * b + c;
#endif
}

/// Points that take the nodes' velocities, c = ṽ, keep of the kinetic energy what they can. The rest is booked as that
/// of PIC: here Σ ½ m_n (ṽ² − v^t²), which forces and holds have made of what the points brought, and by the points Σ ½
/// m_p (v_p^t² − v_p^{t+dt}²).
template <int Dim>
void take_velocity(Body<Dim>& body, VelocityField<Dim>& field, int k, const Vec<Dim>& v_next, double dt,
                   const StepSettings& settings, StepTotals<Dim>& totals) {
  const Node<Dim>& node = field.nodes.node[k];
  Vec<Dim> path;
  for (int j = 0; j < Dim; ++j) {
    field.nodes.motion[k].dv(j) = v_next[j];
    field.nodes.a_dt[k][j] = 0;
    path[j] = 0.5 * (node.v[j] + v_next[j]) * dt;
    totals.dissipation_pic += 0.5 * node.m * (v_next[j] * v_next[j] - node.v[j] * node.v[j]);
  }
  record_work<Dim>(body, field, k, settings, all_components, path, totals);
}

/// Step 3: a_n = (F_grav − F_int) / m_n (eq. 5), and what the scheme makes of it (scheme.hpp): c, by which the
/// velocities of points change (step 4), or a dt and ṽ, of which a scheme of two terms forms c. Returns the force that
/// is not balanced.
template <int Dim>
Vec<Dim> accelerate(Body<Dim>& body, VelocityField<Dim>& field, int k, const transfer::NodeSums<Dim>& sums, double dt,
                    const StepSettings& settings, StepTotals<Dim>& totals) {
  const int n = field.assembly.node(k);
  Node<Dim>& node = field.nodes.node[k];
  const Scheme& scheme = settings.scheme;
  node.m = sums.mass();  // one by one: a whole Node would be loaded from where its parts have just been stored
  const double per_mass = 1 / sums.mass();
  node.per_mass = per_mass;
  node.held = 0;
  Vec<Dim> F = driving_force<Dim>(body, field, n, sums), a;
  for (int j = 0; j < Dim; ++j) {
    node.v[j] = sums.momentum(j) * per_mass;
    a[j] = F[j] * per_mass;  // eq. 5
  }
  const bool resisted = is_resisted(body, field, n, settings.damping);
  node.acted_on = resisted || field.outside.active();
  if (resisted) [[unlikely]] {
    const auto left = resisted_by<Dim>(body, field, k, dt, settings, {F, a});
    F = left.F;
    a = left.a;
  }
  auto& motion = field.nodes.motion[k];
  for (int j = 0; j < Dim; ++j) motion.dv(j) = a[j] * dt;
  if (scheme.flip == 1 && !scheme.two_terms) return F;
  Vec<Dim> v_next;
  for (int j = 0; j < Dim; ++j) v_next[j] = fused(a[j], dt, node.v[j]);
  if (resisted) [[unlikely]]
    v_next = constrained<Dim>(body, field, k, scheme, v_next);
  if (scheme.affine) {
    take_velocity<Dim>(body, field, k, v_next, dt, settings, totals);
  } else if (scheme.two_terms) {
    for (int j = 0; j < Dim; ++j) motion.du(j) = v_next[j];
    if (resisted && field.outside.sides.slows(n)) [[unlikely]] {
      for (int j = 0; j < Dim; ++j) {
        motion.dv(j) *= field.outside.sides.gamma(n, j);
        motion.du(j) *= field.outside.sides.gamma(n, j);
      }
    }
    if (node.held != 0) [[unlikely]] {
      for (int j = 0; j < Dim; ++j) {
        if (!(node.held >> j & 1u)) continue;
        field.nodes.a_dt[k][j] = a[j] * dt;
        motion.dv(j) = 0;  // what holds a node is no part of P
      }
    }
  } else {
    for (int j = 0; j < Dim; ++j) {
      field.nodes.a_dt[k][j] = a[j] * dt;
      motion.dv(j) = scheme::change_of_velocity(scheme.flip, a[j], dt, v_next[j]);
    }
  }
  return F;
}

/// f(node, its number among the active ones, M w) of the active nodes with mass, where M w are the n numbers that were
/// summed up for each.
template <int n, int Dim, class F>
void with_sums(const VelocityField<Dim>& field, const exec::Chunk& chunk, F&& f) {
  for (int k = chunk.nodes.first; k < chunk.nodes.last; ++k) {
    const Node<Dim>& node = field.nodes.node[k];
    if (node.m < field.least_mass) continue;
    f(node, k, gathered<transfer::accumulator_size<n>>(field, k, field.buffers.momentum));
  }
}

}  // namespace

template <int Dim>
void accelerate_nodes(Body<Dim>& body, VelocityField<Dim>& field, double dt, const StepSettings& settings) {
  for_each_chunk(field, field.buffers.totals, [&](const exec::Chunk& chunk, StepTotals<Dim>& part) {
    double unbalanced = 0, mass = 0;
    for (int k = chunk.nodes.first; k < chunk.nodes.last; ++k) {
      const auto sums = gathered_sums(field, k);
      if (sums.mass() < field.least_mass) {
        field.nodes.node[k] = {};
        field.nodes.motion[k] = {};
        field.nodes.a_dt[k] = {};
        ++part.massless_nodes;
        continue;
      }
      for (const double F : accelerate(body, field, k, sums, dt, settings, part)) unbalanced += std::abs(F);
      mass += sums.mass();
    }
    part.unbalanced_force = unbalanced;
    for (const double g : body.gravity) part.weight += mass * std::abs(g);
  });
}

/// What is held is no part of P: filter_changes and filter_displacements find it as it was.
template <int Dim>
void filter_changes(VelocityField<Dim>& field, double dt, const StepSettings& settings) {
  const double phi = settings.scheme.kept(dt);
  for_each_chunk(field, [&](const exec::Chunk& chunk) {
    with_sums<2 * Dim>(field, chunk, [&](const Node<Dim>& node, int k, const auto& M_w) {
      auto& motion = field.nodes.motion[k];
      Vec<Dim> a_dt, v_next;
      for (int j = 0; j < Dim; ++j) {
        a_dt[j] = scheme::filtered(motion.dv(j), M_w[j], node.per_mass);
        v_next[j] = scheme::filtered(motion.du(j), M_w[Dim + j], node.per_mass);
      }
      if (const int n = field.assembly.node(k); node.acted_on && field.outside.sides.slows(n)) [[unlikely]] {
        for (int j = 0; j < Dim; ++j) {
          const double gamma = field.outside.sides.gamma(n, j);
          a_dt[j] = scheme::filtered_of(gamma, motion.dv(j), M_w[j], node.per_mass);
          v_next[j] = scheme::filtered_of(gamma, motion.du(j), M_w[Dim + j], node.per_mass);
        }
      }
      if (node.held != 0) [[unlikely]] {
        for (int j = 0; j < Dim; ++j) {
          if (!(node.held >> j & 1u)) continue;
          a_dt[j] = field.nodes.a_dt[k][j];
          v_next[j] = motion.du(j);
        }
      }
      for (int j = 0; j < Dim; ++j) {
        motion.dv(j) = scheme::change_of_velocity(phi, a_dt[j], 1, v_next[j]);
        motion.du(j) = a_dt[j];  // until there is du: its product with M is part of the books of PIC
      }
      if (node.acted_on) [[unlikely]] {
        for (int j = 0; j < Dim; ++j) field.nodes.half_path[k][j] = 0.5 * (v_next[j] - a_dt[j]) * dt;
      }
    });
  });
}

/// What PIC takes is Σ ½ m_p (|v_p^FLIP|² − |v_p^{t+dt}|²). With v_p^FLIP = v_p^t + Σ a_i dt N_i its first part is, in
/// a scheme of two terms with P a for a, Σ ½ m_p |v_p^t|² + Σ (p_i + ½ M_ij a_j dt) · a_i dt: this term of a node comes
/// to the sum of step 1, and to that over the points with their new velocities.
template <int Dim, std::size_t n>
double energy_of_flip(const Node<Dim>& node, const transfer::Motion<Dim>& motion, const std::array<double, n>& M_w) {
  double sum = 0;
  if constexpr (n >= 2 * Dim) {
    for (int j = 0; j < Dim; ++j) sum += (node.m * node.v[j] + 0.5 * M_w[Dim + j]) * motion.du(j);
  }
  return sum;
}

/// The du of held components: no part of P.
template <int Dim>
void keep_aside(VelocityField<Dim>& field, int k) {
  auto& motion = field.nodes.motion[k];
  for (int j = 0; j < Dim; ++j) {
    if (!(field.nodes.node[k].held >> j & 1u)) continue;
    field.nodes.half_path[k][j] = motion.du(j);
    motion.du(j) = 0;
  }
}

/// Forces at nodes work on ½ (v^t + v^{t+dt}), with P before it in a scheme of two terms: with that the change of the
/// points' kinetic energy is theirs to the last bit. Gravity works on the points' displacements:
/// Σ m_p du_p = Σ m_n du_n.
template <int Dim>
void velocities_of_nodes(Body<Dim>& body, VelocityField<Dim>& field, double dt, const StepSettings& settings) {
  const Scheme& scheme = settings.scheme;
  const double phi = scheme.kept(dt);
  const bool filters = scheme.filters_motion(), records_pic = scheme::records_pic_at_nodes(scheme, dt);
  for_each_chunk(field, field.buffers.totals, [&](const exec::Chunk& chunk, StepTotals<Dim>& part) {
    Vec<Dim> m_du{};
    double taken = 0;
    const auto of_node = [&](const Node<Dim>& node, int k, const auto& M_w) {
      auto& motion = field.nodes.motion[k];
      Vec<Dim> v, path;
      for (int j = 0; j < Dim; ++j) {
        v[j] = phi * node.v[j] + M_w[j] * node.per_mass;  // eq. 7 and eq. 8
        path[j] = 0.5 * (node.v[j] + v[j]) * dt;
      }
      if (records_pic) taken += energy_of_flip(node, motion, M_w);
      // The others: of a scheme of two terms on P v, below; of one whose points take the velocity before, on that.
      const unsigned here = scheme.affine ? 0 : scheme.two_terms ? node.held : all_components;
      if (here != 0) record_work<Dim>(body, field, k, settings, here, path, part);
      if (node.acted_on && is_resisted(body, field, field.assembly.node(k), settings.damping)) [[unlikely]]
        v = constrained<Dim>(body, field, k, scheme, v);
      for (int j = 0; j < Dim; ++j) motion.du(j) = v[j] * dt;  // eq. 16
      if (const int n = field.assembly.node(k); node.acted_on && field.outside.sides.slows(n)) [[unlikely]] {
        for (int j = 0; j < Dim; ++j) {
          if (!filters || !(node.held >> j & 1u)) motion.du(j) *= field.outside.sides.gamma(n, j);
        }
      }
      if (!filters) {
        for (int j = 0; j < Dim; ++j) m_du[j] += node.m * motion.du(j);
      } else if (node.held != 0) [[unlikely]] {
        keep_aside<Dim>(field, k);
      }
    };
    if (scheme.two_terms) {
      with_sums<2 * Dim>(field, chunk, of_node);
    } else {
      with_sums<Dim>(field, chunk, of_node);
    }
    part.dissipation_pic += taken;
    for (int j = 0; j < Dim; ++j) part.work_gravity += m_du[j] * body.gravity[j];
  });
}

/// du = P v dt of a node that is acted on, from what it is without conditions; books the work of what acts on it.
template <int Dim, class Sums>
[[gnu::noinline]] Vec<Dim> displacement_of_others(Body<Dim>& body, VelocityField<Dim>& field, int k,
                                                  const StepSettings& settings, Vec<Dim> du, const Sums& M_w,
                                                  StepTotals<Dim>& totals) {
  const Vec<Dim>& aside = field.nodes.half_path[k];
  const int n = field.assembly.node(k);
  const unsigned held = field.nodes.node[k].held;
  const bool slowed = field.outside.sides.slows(n);
  Vec<Dim> path;
  for (int j = 0; j < Dim; ++j) {
    if (slowed) {
      const double gamma = field.outside.sides.gamma(n, j);
      du[j] = scheme::filtered_of(gamma, field.nodes.motion[k].du(j), M_w[Dim + j], field.nodes.node[k].per_mass);
    }
    if (held >> j & 1u) du[j] = aside[j];
    path[j] = aside[j] + 0.5 * du[j];
  }
  if (settings.scheme.two_terms) record_work_of_others<Dim>(body, field, k, settings, ~held, path, totals);
  if (is_resisted(body, field, n, settings.damping)) du = constrained<Dim>(body, field, k, settings.scheme, du);
  if (slowed) field.outside.sides.slow_down(n, du);
  return du;
}

template <int Dim>
void filter_displacements(Body<Dim>& body, VelocityField<Dim>& field, const StepSettings& settings) {
  for_each_chunk(field, field.buffers.totals, [&](const exec::Chunk& chunk, StepTotals<Dim>& part) {
    Vec<Dim> m_du{};
    with_sums<2 * Dim>(field, chunk, [&](const Node<Dim>& node, int k, const auto& M_w) {
      auto& motion = field.nodes.motion[k];
      Vec<Dim> du;
      for (int j = 0; j < Dim; ++j) du[j] = scheme::filtered(motion.du(j), M_w[Dim + j], node.per_mass);
      if (node.acted_on) [[unlikely]]
        du = displacement_of_others<Dim>(body, field, k, settings, du, M_w, part);
      for (int j = 0; j < Dim; ++j) {
        motion.du(j) = du[j];
        m_du[j] += node.m * du[j];
      }
    });
    for (int j = 0; j < Dim; ++j) part.work_gravity += m_du[j] * body.gravity[j];
  });
}

template void accelerate_nodes<2>(Body<2>&, VelocityField<2>&, double, const StepSettings&);
template void accelerate_nodes<3>(Body<3>&, VelocityField<3>&, double, const StepSettings&);
template void filter_changes<2>(VelocityField<2>&, double, const StepSettings&);
template void filter_changes<3>(VelocityField<3>&, double, const StepSettings&);
template void filter_displacements<2>(Body<2>&, VelocityField<2>&, const StepSettings&);
template void filter_displacements<3>(Body<3>&, VelocityField<3>&, const StepSettings&);
template void velocities_of_nodes<2>(Body<2>&, VelocityField<2>&, double, const StepSettings&);
template void velocities_of_nodes<3>(Body<3>&, VelocityField<3>&, double, const StepSettings&);

}  // namespace scarp::step
