// What is imposed at the nodes of the background mesh: fixed components and walls with friction.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "scarp/mesh/mesh.hpp"

namespace scarp {

/// Boundary conditions of all nodes. A wall is a node whose `normal` component is held against the soil only: it pushes
/// back, does not pull, and resists sliding with Coulomb friction.
template <int Dim>
struct Conditions {
  std::vector<std::uint8_t> fixed;  ///< of each node: bit j set where component j does not move
  std::vector<std::int8_t> normal;  ///< of each node: the wall's normal component, or -1
  std::vector<double> inward;       ///< +1 or -1: which way along the normal the mesh lies
  std::vector<double> friction;     ///< coefficient μ

  explicit Conditions(int node_count = 0)
      : fixed(node_count, 0), normal(node_count, -1), inward(node_count, 0.0), friction(node_count, 0.0) {}
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
  Vec<Dim> friction{};  ///< force of friction on the node
  std::uint8_t held =
      0;  ///< bit j set where component j may not move in this step: fixed, pressed against or stuck to a wall
};

/// Step 3 with conditions: makes the acceleration a = F/m of node n respect them, for a node of mass m and velocity
/// v^t.
template <int Dim>
Reaction<Dim> constrain_acceleration(const Conditions<Dim>& conditions, int n, double m, const Vec<Dim>& v, double dt,
                                     Vec<Dim>& a);

/// Step 5 with conditions: makes the velocity v^{t+dt} of node n respect them; `held` is that of its Reaction.
template <int Dim>
void constrain_velocity(const Conditions<Dim>& conditions, int n, std::uint8_t held, Vec<Dim>& v);

}  // namespace scarp
