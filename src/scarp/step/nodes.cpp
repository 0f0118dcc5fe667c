// Steps 2, 3 and 5 at the nodes.
#include <algorithm>
#include <cmath>

#include "scarp/exec/parallel.hpp"
#include "scarp/step/phases.hpp"
#include "scarp/transfer/transfer.hpp"

namespace scarp::step {
namespace {

constexpr int node_chunk = 256;

/// f(k, n, part) for active node k, number n of the mesh.
template <int Dim, class F>
void for_each_node(Body<Dim>& body, StepBooks<Dim>& books, F&& f) {
  exec::sum_over_chunks(body.assembly.size(), node_chunk, body.buffers.books, books,
                        [&](int first, int last, StepBooks<Dim>& part) {
                          for (int k = first; k < last; ++k) f(k, body.assembly.node(k), part);
                        });
}

/// Step 2: m_n, p_n and F_n^int, from the elements around a node.
template <int Dim>
std::array<double, transfer::node_sums<Dim>> assembled(const Body<Dim>& body, int k) {
  constexpr int Q = transfer::node_sums<Dim>;
  std::array<double, Q> sum{};
  body.assembly.gather(k, [&](int place) {
    const double* part = body.buffers.sums.data() + static_cast<std::size_t>(place) * Q;
    for (int q = 0; q < Q; ++q) sum[q] += part[q];
  });
  return sum;
}

/// Step 3: a_n = (F_grav − F_int) / m_n (eq. 5) with local damping against the motion, and the conditions.
template <int Dim>
void accelerate(Body<Dim>& body, int n, const double* sum, double dt, const StepSettings& settings) {
  Node<Dim>& node = body.buffers.node[n];
  node.m = sum[0];
  node.held = 0;
  const double *p = sum + 1, *F_int = p + Dim;
  const double per_mass = 1 / node.m;
  const bool free = is_free(body.conditions, n);
  Resistance<Dim> resistance;
  for (int j = 0; j < Dim; ++j) {
    const double F = node.m * body.gravity[j] - F_int[j];
    node.v[j] = p[j] * per_mass;
    if (node.v[j] != 0) resistance.F_damping[j] = -std::copysign(settings.damping * std::abs(F), node.v[j]);
    node.a[j] = (F + resistance.F_damping[j]) * per_mass;
  }
  if (!free) {
    const auto reaction = constrain_acceleration<Dim>(body.conditions, n, node.m, node.v, dt, node.a);
    node.held = reaction.held;
    resistance.F_friction = reaction.friction;
    for (int j = 0; j < Dim; ++j) {
      if (node.held & (1u << j)) resistance.F_damping[j] = 0;
    }
  }
  if (!free || settings.damping != 0) body.buffers.resistance[n] = resistance;
  if (settings.flip == 1) return;
  Vec<Dim>& v_next = body.buffers.v_next[n];
  for (int j = 0; j < Dim; ++j) v_next[j] = node.v[j] + node.a[j] * dt;
  if (!free) constrain_velocity<Dim>(body.conditions, n, node.held, v_next);
}

/// The resistance that accelerate() has left; none where it left none.
template <int Dim>
Resistance<Dim> resistance_at(const Body<Dim>& body, int n, double damping) {
  return damping != 0 || !is_free(body.conditions, n) ? body.buffers.resistance[n] : Resistance<Dim>{};
}

}  // namespace

template <int Dim>
void accelerate_nodes(Body<Dim>& body, double dt, const StepSettings& settings, StepBooks<Dim>& books) {
  for_each_node(body, books, [&](int k, int n, StepBooks<Dim>& part) {
    const auto sum = assembled(body, k);
    Node<Dim>& node = body.buffers.node[n];
    if (sum[0] < body.least_mass) {
      node = {};
      body.buffers.v_next[n] = {};
      return;
    }
    accelerate(body, n, sum.data(), dt, settings);
    const auto resistance = resistance_at(body, n, settings.damping);
    for (int j = 0; j < Dim; ++j) {
      if (!(node.held & (1u << j))) part.unbalanced_force += std::abs(node.m * node.a[j] - resistance.F_damping[j]);
      part.weight += std::abs(node.m * body.gravity[j]);
    }
  });
}

/// Forces at nodes work on ½ (v^t + v^{t+dt}): with that the change of the points' kinetic energy is theirs to the last
/// bit. Gravity works on the points' displacements: Σ m_p du_p = Σ m_n v_n dt.
template <int Dim>
void velocities_of_nodes(Body<Dim>& body, double dt, const StepSettings& settings, StepBooks<Dim>& books) {
  for_each_node(body, books, [&](int k, int n, StepBooks<Dim>& part) {
    Node<Dim>& node = body.buffers.node[n];
    if (node.m < body.least_mass) return;
    Vec<Dim> p{};
    body.assembly.gather(k, [&](int place) {
      for (int j = 0; j < Dim; ++j) p[j] += body.buffers.momentum[static_cast<std::size_t>(place) * Dim + j];
    });
    const double per_mass = 1 / node.m;
    const auto resistance = resistance_at(body, n, settings.damping);
    for (int j = 0; j < Dim; ++j) {
      const double v = p[j] * per_mass, path = 0.5 * (node.v[j] + v) * dt;
      part.dissipation_damping -= resistance.F_damping[j] * path;
      part.dissipation_friction -= resistance.F_friction[j] * path;
      node.v[j] = v;
    }
    if (!is_free(body.conditions, n)) constrain_velocity<Dim>(body.conditions, n, node.held, node.v);
    for (int j = 0; j < Dim; ++j) part.work_gravity += node.m * body.gravity[j] * node.v[j] * dt;
  });
}

template void accelerate_nodes<2>(Body<2>&, double, const StepSettings&, StepBooks<2>&);
template void accelerate_nodes<3>(Body<3>&, double, const StepSettings&, StepBooks<3>&);
template void velocities_of_nodes<2>(Body<2>&, double, const StepSettings&, StepBooks<2>&);
template void velocities_of_nodes<3>(Body<3>&, double, const StepSettings&, StepBooks<3>&);

}  // namespace scarp::step
