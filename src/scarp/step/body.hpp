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
#include "scarp/step/books.hpp"
#include "scarp/transfer/strains.hpp"

namespace scarp {

/// A node of the background mesh within a step.
template <int Dim>
struct Node {
  double m = 0;           ///< eq. 1
  Vec<Dim> v{};           ///< v^t; after step 5, v^{t+dt} (eq. 8)
  Vec<Dim> a{};           ///< eq. 5
  std::uint8_t held = 0;  ///< bit j set where the conditions hold component j
};

/// Forces on a node that take energy from the body.
template <int Dim>
struct Resistance {
  Vec<Dim> F_damping{};   ///< local damping
  Vec<Dim> F_friction{};  ///< of a wall
};

/// Buffers of a step. Rows of elements: the part of local node i of the active element in slot s is at s · row + i.
template <int Dim>
struct Buffers {
  std::vector<std::uint8_t> inside;  ///< of each slot: are all elements around it active, too?
  std::vector<double> weight;        ///< of each slot: w of its quadrature
  std::vector<Vec<Dim>> shift;       ///< rows: s_i of its quadrature
  std::vector<double> hoop_shift;    ///< rows, in a body of revolution: the same of N_i / r
  std::vector<double> sums;          ///< rows: transfer::node_sums numbers for each local node
  std::vector<double> momentum;      ///< rows: Dim numbers for each local node
  // Of every node of the mesh, valid for active ones:
  std::vector<Node<Dim>> node;
  std::vector<Vec<Dim>> v_next;             ///< v^t + a dt with its conditions, for the PIC share; where there is one
  std::vector<Resistance<Dim>> resistance;  ///< with damping, and where nodes are not free
  std::vector<Strains<Dim>> strains;        ///< of each thread
  std::vector<StepBooks<Dim>> books;        ///< of each chunk
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
  exec::Assembly assembly;
  double least_mass = 0;  ///< a node with less only has points on the far edges of its elements, and is left out
  std::int64_t out_of_place = 0;  ///< points that changed element since their arrays were last put in order
  Buffers<Dim> buffers;

  int point_count() const;
};

/// Sweeps over elements go in chunks of this many, whose strain increments stay in the innermost cache.
inline constexpr int element_chunk = 64;

/// Finds the element of every point anew and prepares the first step; displacements count from here. Throws InputError
/// where a point is outside the mesh.
template <int Dim>
void locate_points(Body<Dim>& body);

/// Orders points and buffers by element after points have moved or gone.
template <int Dim>
void reorder(Body<Dim>& body);

/// Room for the strain increments of a chunk, for each thread.
template <int Dim>
void prepare_threads(Body<Dim>& body);

}  // namespace scarp
