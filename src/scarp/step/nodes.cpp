// Steps 2, 3 and 5 at the nodes.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "scarp/exec/parallel.hpp"
#include "scarp/step/phases.hpp"
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

/// f(first, last, part) for chunks of the active nodes.
template <int Dim, class F>
void for_each_chunk(Body<Dim>& body, StepBooks<Dim>& books, F&& f) {
  exec::sum_over_chunks(body.assembly.size(), node_chunk, body.buffers.books, books, f);
}

/// Does anything resist the motion of a node?
template <int Dim>
bool is_resisted(const Body<Dim>& body, int n, double damping) {
  return damping != 0 || !is_free(body.conditions, n) || body.sides.holds(n);
}

// What few nodes need is not inlined, and takes and returns vectors by value: those of the other nodes stay in
// registers.

template <int Dim>
struct ForceAndAcceleration {
  Vec<Dim> F, a;
};

/// Local damping of the force F against the motion, and the conditions: changes a = F / m, notes what is held and the
/// resistance; F becomes what of it is not balanced.
template <int Dim>
[[gnu::noinline]] ForceAndAcceleration<Dim> resisted_by(Body<Dim>& body, int k, double dt, const StepSettings& settings,
                                                        ForceAndAcceleration<Dim> of) {
  auto& [F, a] = of;
  const int n = body.assembly.node(k);
  const double damping = settings.damping;
  // A wall takes the force along its normal: none of it is out of balance, and friction must not feel it damped.
  const bool pressed = settings.scheme.wall == WallRule::by_motion &&
                       reaches_wall<Dim>(body.conditions, n, body.buffers.node[k].v, dt, a);
  Node<Dim>& node = body.buffers.node[k];
  Resistance<Dim>& resistance = body.buffers.resistance[k];
  resistance = {};
  for (int j = 0; j < Dim; ++j) {
    if (damping != 0 && node.v[j] != 0 && !(pressed && j == body.conditions.normal[n])) {
      resistance.F_damping[j] = -damping * std::abs(F[j]) * scheme::direction(settings.scheme, node.v[j], a[j] * dt);
    }
    a[j] = (F[j] + resistance.F_damping[j]) * node.per_mass;
  }
  if (body.sides.holds(n)) body.sides.damp(n, node.m, node.v, dt, a, resistance.F_dashpot);
  if (!is_free(body.conditions, n)) {
    const auto reaction = constrain_acceleration<Dim>(body.conditions, settings.scheme.wall, n, node.m, node.v, dt, a);
    node.held = reaction.held;
    resistance.F_friction = reaction.friction;
  }
  for (int j = 0; j < Dim; ++j) {
    if (node.held & (1u << j)) resistance.F_damping[j] = 0;
    F[j] = node.held & (1u << j) ? 0 : node.m * a[j] - resistance.F_damping[j];
  }
  if (body.sides.slows(n)) {  // m a and the friction in it are γ times forces on the node
    for (int j = 0; j < Dim; ++j) {
      const double gamma = body.sides.gamma(n, j);
      resistance.F_friction[j] /= gamma;
      if (!(node.held & (1u << j))) F[j] = node.m * a[j] / gamma - resistance.F_damping[j];
    }
  }
  return of;
}

/// The conditions on a velocity, or a displacement, of active node k.
template <int Dim>
[[gnu::noinline]] Vec<Dim> constrained(const Body<Dim>& body, int k, const Scheme& scheme, Vec<Dim> v) {
  constrain_velocity<Dim>(body.conditions, scheme.wall, body.assembly.node(k), body.buffers.node[k].held, v);
  return v;
}

template <int Dim>
[[gnu::noinline]] void book_work_of_others(Body<Dim>& body, int k, const StepSettings& settings, unsigned components,
                                           Vec<Dim> path, StepBooks<Dim>& books) {
  const Node<Dim>& node = body.buffers.node[k];
  const int n = body.assembly.node(k);
  if (body.sides.slows(n)) body.sides.slow_down(n, path);
  if (is_resisted(body, n, settings.damping)) {
    const auto& resistance = body.buffers.resistance[k];
    for (int j = 0; j < Dim; ++j) {
      if (!(components >> j & 1u)) continue;
      books.dissipation_damping -= resistance.F_damping[j] * path[j];
      books.dissipation_friction -= resistance.F_friction[j] * path[j];
    }
  }
  if (!body.release.active() && !body.sides.active()) return;
  const unsigned set = set_components(body.conditions, settings.scheme.wall, n, node.held) | ~components;
  if (body.release.active()) books.work_release += work_of<Dim>(body.release, n, node.m, set, path);
  if (!body.sides.holds(n)) return;
  const auto work = body.sides.move(n, node.m, set, body.buffers.resistance[k].F_dashpot, path);
  books.work_boundary += work.held;
  books.dissipation_absorbing += work.dashpot;
  books.stored_sides += work.spring;
}

/// Books the work of forces on active node k that are no part of the body's own, in some of its components, on the path
/// that these make (before γ of sides).
template <int Dim>
void book_work(Body<Dim>& body, int k, const StepSettings& settings, unsigned components, const Vec<Dim>& path,
               StepBooks<Dim>& books) {
  if (body.buffers.node[k].acted_on) [[unlikely]]
    book_work_of_others<Dim>(body, k, settings, components, path, books);
}
constexpr unsigned all_components = ~0u;

/// Points that take the nodes' velocities, c = ṽ, keep of the kinetic energy what they can. The rest is booked as that
/// of PIC: here Σ ½ m_n (ṽ² − v^t²), which forces and holds have made of what the points brought, and by the points Σ ½
/// m_p (v_p^t² − v_p^{t+dt}²).
template <int Dim>
void take_velocity(Body<Dim>& body, int k, const Vec<Dim>& v_next, double dt, const StepSettings& settings,
                   StepBooks<Dim>& books) {
  const Node<Dim>& node = body.buffers.node[k];
  Vec<Dim> path;
  for (int j = 0; j < Dim; ++j) {
    body.buffers.motion[k].dv(j) = v_next[j];
    body.buffers.a_dt[k][j] = 0;
    path[j] = 0.5 * (node.v[j] + v_next[j]) * dt;
    books.dissipation_pic += 0.5 * node.m * (v_next[j] * v_next[j] - node.v[j] * node.v[j]);
  }
  book_work<Dim>(body, k, settings, all_components, path, books);
}

/// Step 3: a_n = (F_grav − F_int) / m_n (eq. 5), and what the scheme makes of it (scheme.hpp): c, by which the
/// velocities of points change (step 4), or a dt and ṽ, of which a scheme of two terms forms c. Returns the force that
/// is not balanced.
template <int Dim>
Vec<Dim> accelerate(Body<Dim>& body, int k, const double* sum, double dt, const StepSettings& settings,
                    StepBooks<Dim>& books) {
  const int n = body.assembly.node(k);
  Node<Dim>& node = body.buffers.node[k];
  const Scheme& scheme = settings.scheme;
  const double m = sum[0], per_mass = 1 / m, *p = sum + 1, *F_int = p + Dim;
  Vec<Dim> F, a;
  node.m = m;  // one by one: a whole Node would be loaded from where its parts have just been stored, and wait for them
  node.per_mass = per_mass;
  node.held = 0;
  for (int j = 0; j < Dim; ++j) {
    node.v[j] = p[j] * per_mass;
    F[j] = m * body.gravity[j] - F_int[j];  // eq. 3 at the node, for gravity is uniform
    if (body.sides.holds(n)) F[j] += body.sides.force(n, j, m);
    if (body.release.active()) F[j] += body.release.force(n, j, m);
    a[j] = F[j] * per_mass;  // eq. 5
  }
  const bool resisted = is_resisted(body, n, settings.damping);
  node.acted_on = resisted || body.release.active() || body.sides.active();
  if (resisted) [[unlikely]] {
    const auto left = resisted_by<Dim>(body, k, dt, settings, {F, a});
    F = left.F;
    a = left.a;
  }
  auto& motion = body.buffers.motion[k];
  for (int j = 0; j < Dim; ++j) motion.dv(j) = a[j] * dt;
  if (scheme.flip == 1 && !scheme.two_terms) return F;
  Vec<Dim> v_next;
  for (int j = 0; j < Dim; ++j) v_next[j] = fused(a[j], dt, node.v[j]);
  if (resisted) [[unlikely]]
    v_next = constrained<Dim>(body, k, scheme, v_next);
  if (scheme.affine) {
    take_velocity<Dim>(body, k, v_next, dt, settings, books);
  } else if (scheme.two_terms) {
    for (int j = 0; j < Dim; ++j) motion.du(j) = v_next[j];
    if (resisted && body.sides.slows(n)) [[unlikely]] {
      for (int j = 0; j < Dim; ++j) {
        motion.dv(j) *= body.sides.gamma(n, j);
        motion.du(j) *= body.sides.gamma(n, j);
      }
    }
    if (node.held != 0) [[unlikely]] {
      for (int j = 0; j < Dim; ++j) {
        if (!(node.held >> j & 1u)) continue;
        body.buffers.a_dt[k][j] = a[j] * dt;
        motion.dv(j) = 0;  // what holds a node is no part of P
      }
    }
  } else {
    for (int j = 0; j < Dim; ++j) {
      body.buffers.a_dt[k][j] = a[j] * dt;
      motion.dv(j) = scheme::change_of_velocity(scheme.flip, a[j], dt, v_next[j]);
    }
  }
  return F;
}

/// f(node, its number among the active ones, M w) of the active nodes with mass, where M w are the n numbers that were
/// summed up for each.
template <int n, int Dim, class F>
void with_sums(const Body<Dim>& body, int first, int last, F&& f) {
  for (int k = first; k < last; ++k) {
    const Node<Dim>& node = body.buffers.node[k];
    if (node.m < body.least_mass) continue;
    f(node, k, gathered<transfer::place_size<n>>(body, k, body.buffers.momentum));
  }
}

}  // namespace

template <int Dim>
void accelerate_nodes(Body<Dim>& body, double dt, const StepSettings& settings, StepBooks<Dim>& books) {
  for_each_chunk(body, books, [&](int first, int last, StepBooks<Dim>& part) {
    double unbalanced = 0, mass = 0;
    for (int k = first; k < last; ++k) {
      const auto sum = gathered<transfer::node_sums<Dim>>(body, k, body.buffers.sums);
      if (sum[0] < body.least_mass) {
        body.buffers.node[k] = {};
        body.buffers.motion[k] = {};
        body.buffers.a_dt[k] = {};
        ++part.massless_nodes;
        continue;
      }
      for (const double F : accelerate(body, k, sum.data(), dt, settings, part)) unbalanced += std::abs(F);
      mass += sum[0];
    }
    part.unbalanced_force = unbalanced;
    for (const double g : body.gravity) part.weight += mass * std::abs(g);
  });
}

/// What is held is no part of P: filter_changes and filter_displacements find it as it was.
template <int Dim>
void filter_changes(Body<Dim>& body, double dt, const StepSettings& settings, StepBooks<Dim>& books) {
  const double phi = settings.scheme.kept(dt);
  for_each_chunk(body, books, [&](int first, int last, StepBooks<Dim>&) {
    with_sums<2 * Dim>(body, first, last, [&](const Node<Dim>& node, int k, const auto& M_w) {
      auto& motion = body.buffers.motion[k];
      Vec<Dim> a_dt, v_next;
      for (int j = 0; j < Dim; ++j) {
        a_dt[j] = scheme::filtered(motion.dv(j), M_w[j], node.per_mass);
        v_next[j] = scheme::filtered(motion.du(j), M_w[Dim + j], node.per_mass);
      }
      if (const int n = body.assembly.node(k); node.acted_on && body.sides.slows(n)) [[unlikely]] {
        for (int j = 0; j < Dim; ++j) {
          const double gamma = body.sides.gamma(n, j);
          a_dt[j] = scheme::filtered_of(gamma, motion.dv(j), M_w[j], node.per_mass);
          v_next[j] = scheme::filtered_of(gamma, motion.du(j), M_w[Dim + j], node.per_mass);
        }
      }
      if (node.held != 0) [[unlikely]] {
        for (int j = 0; j < Dim; ++j) {
          if (!(node.held >> j & 1u)) continue;
          a_dt[j] = body.buffers.a_dt[k][j];
          v_next[j] = motion.du(j);
        }
      }
      for (int j = 0; j < Dim; ++j) {
        motion.dv(j) = scheme::change_of_velocity(phi, a_dt[j], 1, v_next[j]);
        motion.du(j) = a_dt[j];  // until there is du: its product with M is part of the books of PIC
      }
      if (node.acted_on) [[unlikely]] {
        for (int j = 0; j < Dim; ++j) body.buffers.half_path[k][j] = 0.5 * (v_next[j] - a_dt[j]) * dt;
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
void keep_aside(Body<Dim>& body, int k) {
  auto& motion = body.buffers.motion[k];
  for (int j = 0; j < Dim; ++j) {
    if (!(body.buffers.node[k].held >> j & 1u)) continue;
    body.buffers.half_path[k][j] = motion.du(j);
    motion.du(j) = 0;
  }
}

/// Forces at nodes work on ½ (v^t + v^{t+dt}), with P before it in a scheme of two terms: with that the change of the
/// points' kinetic energy is theirs to the last bit. Gravity works on the points' displacements:
/// Σ m_p du_p = Σ m_n du_n.
template <int Dim>
void velocities_of_nodes(Body<Dim>& body, double dt, const StepSettings& settings, StepBooks<Dim>& books) {
  const Scheme& scheme = settings.scheme;
  const double phi = scheme.kept(dt);
  const bool filters = scheme.filters_motion(), books_pic = scheme::books_pic_at_nodes(scheme, dt);
  for_each_chunk(body, books, [&](int first, int last, StepBooks<Dim>& part) {
    Vec<Dim> m_du{};
    double taken = 0;
    const auto of_node = [&](const Node<Dim>& node, int k, const auto& M_w) {
      auto& motion = body.buffers.motion[k];
      Vec<Dim> v, path;
      for (int j = 0; j < Dim; ++j) {
        v[j] = phi * node.v[j] + M_w[j] * node.per_mass;  // eq. 7 and eq. 8
        path[j] = 0.5 * (node.v[j] + v[j]) * dt;
      }
      if (books_pic) taken += energy_of_flip(node, motion, M_w);
      // The others: of a scheme of two terms on P v, below; of one whose points take the velocity before, on that.
      const unsigned here = scheme.affine ? 0 : scheme.two_terms ? node.held : all_components;
      if (here != 0) book_work<Dim>(body, k, settings, here, path, part);
      if (node.acted_on && is_resisted(body, body.assembly.node(k), settings.damping)) [[unlikely]]
        v = constrained<Dim>(body, k, scheme, v);
      for (int j = 0; j < Dim; ++j) motion.du(j) = v[j] * dt;  // eq. 16
      if (const int n = body.assembly.node(k); node.acted_on && body.sides.slows(n)) [[unlikely]] {
        for (int j = 0; j < Dim; ++j) {
          if (!filters || !(node.held >> j & 1u)) motion.du(j) *= body.sides.gamma(n, j);
        }
      }
      if (!filters) {
        for (int j = 0; j < Dim; ++j) m_du[j] += node.m * motion.du(j);
      } else if (node.held != 0) [[unlikely]] {
        keep_aside<Dim>(body, k);
      }
    };
    if (scheme.two_terms) {
      with_sums<2 * Dim>(body, first, last, of_node);
    } else {
      with_sums<Dim>(body, first, last, of_node);
    }
    part.dissipation_pic += taken;
    for (int j = 0; j < Dim; ++j) part.work_gravity += m_du[j] * body.gravity[j];
  });
}

/// du = P v dt of a node that is acted on, from what it is without conditions; books the work of what acts on it.
template <int Dim, class Sums>
[[gnu::noinline]] Vec<Dim> displacement_of_others(Body<Dim>& body, int k, const StepSettings& settings, Vec<Dim> du,
                                                  const Sums& M_w, StepBooks<Dim>& books) {
  const Vec<Dim>& aside = body.buffers.half_path[k];
  const int n = body.assembly.node(k);
  const unsigned held = body.buffers.node[k].held;
  const bool slowed = body.sides.slows(n);
  Vec<Dim> path;
  for (int j = 0; j < Dim; ++j) {
    if (slowed) {
      const double gamma = body.sides.gamma(n, j);
      du[j] = scheme::filtered_of(gamma, body.buffers.motion[k].du(j), M_w[Dim + j], body.buffers.node[k].per_mass);
    }
    if (held >> j & 1u) du[j] = aside[j];
    path[j] = aside[j] + 0.5 * du[j];
  }
  if (settings.scheme.two_terms) book_work_of_others<Dim>(body, k, settings, ~held, path, books);
  if (is_resisted(body, n, settings.damping)) du = constrained<Dim>(body, k, settings.scheme, du);
  if (slowed) body.sides.slow_down(n, du);
  return du;
}

template <int Dim>
void filter_displacements(Body<Dim>& body, const StepSettings& settings, StepBooks<Dim>& books) {
  for_each_chunk(body, books, [&](int first, int last, StepBooks<Dim>& part) {
    Vec<Dim> m_du{};
    with_sums<2 * Dim>(body, first, last, [&](const Node<Dim>& node, int k, const auto& M_w) {
      auto& motion = body.buffers.motion[k];
      Vec<Dim> du;
      for (int j = 0; j < Dim; ++j) du[j] = scheme::filtered(motion.du(j), M_w[Dim + j], node.per_mass);
      if (node.acted_on) [[unlikely]]
        du = displacement_of_others<Dim>(body, k, settings, du, M_w, part);
      for (int j = 0; j < Dim; ++j) {
        motion.du(j) = du[j];
        m_du[j] += node.m * du[j];
      }
    });
    for (int j = 0; j < Dim; ++j) part.work_gravity += m_du[j] * body.gravity[j];
  });
}

template void accelerate_nodes<2>(Body<2>&, double, const StepSettings&, StepBooks<2>&);
template void accelerate_nodes<3>(Body<3>&, double, const StepSettings&, StepBooks<3>&);
template void filter_changes<2>(Body<2>&, double, const StepSettings&, StepBooks<2>&);
template void filter_changes<3>(Body<3>&, double, const StepSettings&, StepBooks<3>&);
template void filter_displacements<2>(Body<2>&, const StepSettings&, StepBooks<2>&);
template void filter_displacements<3>(Body<3>&, const StepSettings&, StepBooks<3>&);
template void velocities_of_nodes<2>(Body<2>&, double, const StepSettings&, StepBooks<2>&);
template void velocities_of_nodes<3>(Body<3>&, double, const StepSettings&, StepBooks<3>&);

}  // namespace scarp::step
