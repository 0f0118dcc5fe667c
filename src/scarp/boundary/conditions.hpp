// What is imposed at the nodes of the background mesh: fixed components and walls with friction.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "scarp/base/zero_pages.hpp"
#include "scarp/mesh/mesh.hpp"

namespace scarp {

/// When a wall with friction pushes back, and what it does to the motion along its normal.
enum class WallRule {
  by_acceleration,  ///< where the acceleration goes into it; that becomes zero, as does the velocity of what sticks
  by_motion,        ///< where the motion of the step goes into it; that comes to rest (W1 of docs/theory.md)
};

/// Boundary conditions of each node; where there are none they cost no memory. A wall is a node whose `normal`
/// component is held against the soil only: it pushes back, does not pull, and resists sliding with Coulomb friction.
template <int Dim>
struct Conditions {
  ZeroPages<std::uint8_t> fixed;   ///< bit j set where component j does not move
  MostlyNone<std::int8_t> normal;  ///< the wall's normal component, or -1
  ZeroPages<double> inward;        ///< +1 or -1: which way along the normal the mesh lies
  ZeroPages<double> friction;      ///< coefficient μ

  explicit Conditions(int node_count = 0)
      : fixed(node_count), normal(node_count), inward(node_count), friction(node_count) {}
};

/// Is nothing imposed at node n?
template <int Dim>
inline bool is_free(const Conditions<Dim>& conditions, int n) {
  return conditions.fixed[n] == 0 && conditions.normal[n] < 0;
}

/// Holds component j of the nodes.
template <int Dim>
void fix(Conditions<Dim>& conditions, std::span<const int> nodes, int component);

/// Makes the nodes a wall with friction coefficient `friction`; the mesh must lie on one side of them along
/// `component`. Throws InputError where a node has the mesh on both sides.
template <int Dim>
void wall(Conditions<Dim>& conditions, const Mesh<Dim>& mesh, std::span<const int> nodes, int component,
          double friction);

/// What conditions did to the acceleration of a node.
template <int Dim>
struct Reaction {
  Vec<Dim> friction{};  ///< force of friction on the node; by motion also the one that brings it to rest at the wall
  std::uint8_t held =
      0;  ///< bit j set where component j may not move in this step: fixed, pressed against or stuck to a wall
};

/// Does node n arrive at its wall or lie on it in this step, which starts with v and acceleration a (W1)?
template <int Dim>
inline bool reaches_wall(const Conditions<Dim>& conditions, int n, const Vec<Dim>& v, double dt, const Vec<Dim>& a) {
  const int normal = conditions.normal[n];
  return normal >= 0 && conditions.inward[n] * (v[normal] + a[normal] * dt) < 0;
}

/// Step 3 with conditions: makes the acceleration a = F/m of node n respect them, for a node of mass m and velocity
/// v^t.
template <int Dim>
Reaction<Dim> constrain_acceleration(const Conditions<Dim>& conditions, WallRule rule, int n, double m,
                                     const Vec<Dim>& v, double dt, Vec<Dim>& a);

/// Bits of the components of node n whose velocity v^{t+dt} is set, not computed; `held` is that of its Reaction. What
/// sticks to a wall by motion has come to rest by its acceleration: setting it would part the node from its points.
template <int Dim>
inline unsigned set_components(const Conditions<Dim>& conditions, WallRule rule, int n, std::uint8_t held) {
  if (rule == WallRule::by_acceleration) return held;
  const int normal = conditions.normal[n];
  return held & (conditions.fixed[n] | (normal >= 0 ? 1u << normal : 0u));
}

/// Step 5 with conditions: makes the velocity v^{t+dt} of node n respect them; `held` is that of its Reaction.
template <int Dim>
void constrain_velocity(const Conditions<Dim>& conditions, WallRule rule, int n, std::uint8_t held, Vec<Dim>& v);

}  // namespace scarp
