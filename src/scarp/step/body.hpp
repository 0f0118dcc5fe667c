// Everything that a time step works on: the mesh with its conditions, the material points, and the sums at the nodes.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "scarp/boundary/conditions.hpp"
#include "scarp/exec/assembly.hpp"
#include "scarp/mesh/locate.hpp"
#include "scarp/mesh/mesh.hpp"
#include "scarp/points/points.hpp"
#include "scarp/transfer/transfer.hpp"

namespace scarp {

/// A node of the background mesh within a step.
template <int Dim>
struct Node {
  double m = 0;           ///< eq. 1
  Vec<Dim> v{};           ///< v^t; after step 5, v^{t+dt} (eq. 8)
  Vec<Dim> a{};           ///< eq. 5
  std::uint8_t held = 0;  ///< bit j set where the conditions hold component j
  Vec<Dim> F_damping{};   ///< local damping
  Vec<Dim> F_friction{};  ///< of a wall
};

/// Soil on its background mesh. The mesh is held by pointer, so that it stays where the locator saw it.
template <int Dim>
struct Body {
  Body(std::unique_ptr<const Mesh<Dim>> background, const Vec<Dim>& gravitational_acceleration);

  std::unique_ptr<const Mesh<Dim>> mesh;
  Locator<Dim> locator;
  Conditions<Dim> conditions;
  Vec<Dim> gravity;
  std::vector<Block<Dim>> blocks;

  ActiveElements active;
  std::vector<int> nodes;  ///< of the active elements, ascending
  double least_mass = 0;   ///< a node with less only has points on the far edges of its elements, and is left out
  int out_of_place = 0;    ///< points that changed element since their arrays were last put in order

  std::vector<transfer::Quadrature> quadrature;  ///< of each active element, of the step under way
  exec::Incidence incidence;
  exec::ElementRows<transfer::NodeSums<Dim>> sums;
  exec::ElementRows<Vec<Dim>> momentum;
  std::vector<Node<Dim>> node;  ///< of every node of the mesh; valid for active ones

  int point_count() const;
};

/// Finds the element of every point anew and prepares the first step. Throws InputError where a point is outside the
/// mesh.
template <int Dim>
void locate_points(Body<Dim>& body);

/// Orders points and buffers by element after points have moved or gone.
template <int Dim>
void reorder(Body<Dim>& body);

}  // namespace scarp
