// Steps 2, 3 and 5 at the nodes.
#include <algorithm>
#include <cmath>

#include "scarp/exec/parallel.hpp"
#include "scarp/step/phases.hpp"
#include "scarp/transfer/transfer.hpp"

namespace scarp::step {
namespace {

constexpr int node_chunk = 256;

/// f(first, last, part) for chunks of the active nodes.
template <int Dim, class F>
void for_each_chunk(Body<Dim>& body, StepBooks<Dim>& books, F&& f) {
  exec::sum_over_chunks(body.assembly.size(), node_chunk, body.buffers.books, books, f);
}

/// Step 2: the sum over the places of active node k, n numbers each.
template <int n, int Dim>
std::array<double, n> gathered(const Body<Dim>& body, int k, const Column& numbers) {
  std::array<double, n> sum{};
  body.assembly.gather(k, [&](int place) {
    const double* part = numbers.data() + static_cast<std::size_t>(place) * n;
    for (int q = 0; q < n; ++q) sum[q] += part[q];
  });
  return sum;
}

/// Does anything resist the motion of a node?
template <int Dim>
bool is_resisted(const Body<Dim>& body, int n, double damping) {
  return damping != 0 || !is_free(body.conditions, n) || body.sides.holds(n);
}

/// Local damping of the force F against the motion, and the conditions: changes a = F / m, notes what is held and the
/// resistance; F becomes what of it is not balanced.
template <int Dim>
[[gnu::noinline]] void resist(Body<Dim>& body, int n, double dt, const StepSettings& settings, Vec<Dim>& F,
                              Vec<Dim>& a) {
  const double damping = settings.damping;
  // A wall takes the force along its normal: none of it is out of balance, and friction must not feel it damped.
  const bool pressed =
      settings.wall == WallRule::by_motion && reaches_wall<Dim>(body.conditions, n, body.buffers.node[n].v, dt, a);
  Node<Dim>& node = body.buffers.node[n];
  Resistance<Dim>& resistance = body.buffers.resistance[n];
  resistance = {};
  for (int j = 0; j < Dim; ++j) {
    if (damping != 0 && node.v[j] != 0 && !(pressed && j == body.conditions.normal[n])) {
      resistance.F_damping[j] = -std::copysign(damping * std::abs(F[j]), node.v[j]);
    }
    a[j] = (F[j] + resistance.F_damping[j]) * node.per_mass;
  }
  if (body.sides.holds(n)) body.sides.damp(n, node.m, node.v, dt, a, resistance.F_dashpot);
  if (!is_free(body.conditions, n)) {
    const auto reaction = constrain_acceleration<Dim>(body.conditions, settings.wall, n, node.m, node.v, dt, a);
    node.held = reaction.held;
    resistance.F_friction = reaction.friction;
  }
  for (int j = 0; j < Dim; ++j) {
    if (node.held & (1u << j)) resistance.F_damping[j] = 0;
    F[j] = node.held & (1u << j) ? 0 : node.m * a[j] - resistance.F_damping[j];
  }
}

/// Step 3: a_n = (F_grav − F_int) / m_n (eq. 5), and by what it changes the velocities of points (step 4):
/// c = φ a dt + (1 − φ) ṽ, ṽ = v^t + a dt with the conditions. Returns the force that is not balanced.
template <int Dim>
Vec<Dim> accelerate(Body<Dim>& body, int n, const double* sum, double dt, const StepSettings& settings) {
  Node<Dim>& node = body.buffers.node[n];
  const double m = sum[0], per_mass = 1 / m, *p = sum + 1, *F_int = p + Dim;
  Vec<Dim> F, a;
  node.m = m;  // one by one: a whole Node would be loaded from where its parts have just been stored, and wait for them
  node.per_mass = per_mass;
  node.held = 0;
  for (int j = 0; j < Dim; ++j) {
    node.v[j] = p[j] * per_mass;
    F[j] = m * body.gravity[j] - F_int[j];
    if (body.sides.holds(n)) F[j] += body.sides.force(n, j, m);
    if (body.release.active()) F[j] += body.release.force(n, j, m);
    a[j] = F[j] * per_mass;
  }
  const bool resisted = is_resisted(body, n, settings.damping);
  if (resisted) [[unlikely]]
    resist<Dim>(body, n, dt, settings, F, a);
  auto& motion = body.buffers.motion[n];
  for (int j = 0; j < Dim; ++j) motion.dv(j) = a[j] * dt;
  if (settings.flip == 1) return F;
  Vec<Dim> v_next;
  for (int j = 0; j < Dim; ++j) {
    body.buffers.a_dt[n][j] = a[j] * dt;
    v_next[j] = node.v[j] + a[j] * dt;
  }
  if (resisted) constrain_velocity<Dim>(body.conditions, settings.wall, n, node.held, v_next);
  for (int j = 0; j < Dim; ++j) motion.dv(j) = settings.flip * a[j] * dt + (1 - settings.flip) * v_next[j];
  return F;
}

/// The work of what acts on node n from outside, with v^{t+dt} of eq. 8 before conditions.
template <int Dim>
[[gnu::noinline]] void book_from_outside(Body<Dim>& body, int n, const Vec<Dim>& v, double dt, WallRule rule,
                                         StepBooks<Dim>& books) {
  const Node<Dim>& node = body.buffers.node[n];
  const unsigned set = set_components<Dim>(body.conditions, rule, n, node.held);
  Vec<Dim> path;
  for (int j = 0; j < Dim; ++j) path[j] = 0.5 * (node.v[j] + v[j]) * dt;
  if (body.release.active()) books.work_release += work_of<Dim>(body.release, n, node.m, set, path);
  if (!body.sides.holds(n)) return;
  const auto work = body.sides.move(n, node.m, set, body.buffers.resistance[n].F_dashpot, path);
  books.work_boundary += work.held;
  books.dissipation_absorbing += work.dashpot;
  books.stored_sides += work.spring;
}

}  // namespace

template <int Dim>
void accelerate_nodes(Body<Dim>& body, double dt, const StepSettings& settings, StepBooks<Dim>& books) {
  for_each_chunk(body, books, [&](int first, int last, StepBooks<Dim>& part) {
    double unbalanced = 0, mass = 0;
    for (int k = first; k < last; ++k) {
      const int n = body.assembly.node(k);
      const auto sum = gathered<transfer::node_sums<Dim>>(body, k, body.buffers.sums);
      if (sum[0] < body.least_mass) {
        body.buffers.node[n] = {};
        body.buffers.motion[n] = {};
        body.buffers.a_dt[n] = {};
        continue;
      }
      for (const double F : accelerate(body, n, sum.data(), dt, settings)) unbalanced += std::abs(F);
      mass += sum[0];
    }
    part.unbalanced_force = unbalanced;
    for (const double g : body.gravity) part.weight += mass * std::abs(g);
  });
}

/// Forces at nodes work on ½ (v^t + v^{t+dt}): with that the change of the points' kinetic energy is theirs to the last
/// bit. Gravity works on the points' displacements: Σ m_p du_p = Σ m_n v_n dt.
template <int Dim>
void velocities_of_nodes(Body<Dim>& body, double dt, const StepSettings& settings, StepBooks<Dim>& books) {
  for_each_chunk(body, books, [&](int first, int last, StepBooks<Dim>& part) {
    double damping = 0, friction = 0;
    Vec<Dim> m_du{};
    for (int k = first; k < last; ++k) {
      const int n = body.assembly.node(k);
      const Node<Dim>& node = body.buffers.node[n];
      if (node.m < body.least_mass) continue;
      const auto dp = gathered<transfer::momentum_size<Dim>>(body, k, body.buffers.momentum);
      Vec<Dim> v;
      for (int j = 0; j < Dim; ++j) v[j] = settings.flip * node.v[j] + dp[j] * node.per_mass;
      if (body.release.active() || body.sides.active()) [[unlikely]]
        book_from_outside<Dim>(body, n, v, dt, settings.wall, part);
      if (is_resisted(body, n, settings.damping)) [[unlikely]] {
        const auto& resistance = body.buffers.resistance[n];
        for (int j = 0; j < Dim; ++j) {
          const double path = 0.5 * (node.v[j] + v[j]) * dt;
          damping -= resistance.F_damping[j] * path;
          friction -= resistance.F_friction[j] * path;
        }
        constrain_velocity<Dim>(body.conditions, settings.wall, n, node.held, v);
      }
      auto& motion = body.buffers.motion[n];
      for (int j = 0; j < Dim; ++j) {
        motion.du(j) = v[j] * dt;
        m_du[j] += node.m * motion.du(j);
      }
    }
    part.dissipation_damping = damping;
    part.dissipation_friction = friction;
    for (int j = 0; j < Dim; ++j) part.work_gravity += m_du[j] * body.gravity[j];
  });
}

template void accelerate_nodes<2>(Body<2>&, double, const StepSettings&, StepBooks<2>&);
template void accelerate_nodes<3>(Body<3>&, double, const StepSettings&, StepBooks<3>&);
template void velocities_of_nodes<2>(Body<2>&, double, const StepSettings&, StepBooks<2>&);
template void velocities_of_nodes<3>(Body<3>&, double, const StepSettings&, StepBooks<3>&);

}  // namespace scarp::step
