// Soil with a velocity of its own at the nodes of the background mesh: its points, the elements and nodes that these
// make active, and what a step keeps there. A body has one as a rule; bodies in contact, or the water in the soil, have
// one each.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "scarp/base/zero_pages.hpp"
#include "scarp/comm/alone.hpp"
#include "scarp/exec/assembly.hpp"
#include "scarp/points/points.hpp"
#include "scarp/step/nonlocal.hpp"
#include "scarp/step/outside.hpp"
#include "scarp/step/totals.hpp"
#include "scarp/transfer/mass_matrix.hpp"
#include "scarp/transfer/node_sums.hpp"
#include "scarp/transfer/node_values.hpp"
#include "scarp/transfer/point_increments.hpp"

namespace scarp {

/// A node of the background mesh within a step.
template <int Dim>
struct Node {
  double m = 0;           ///< eq. 1
  double per_mass = 0;    ///< 1 / m
  Vec<Dim> v{};           ///< v^t
  std::uint8_t held = 0;  ///< bit j set where the conditions hold component j
  bool acted_on = false;  ///< by conditions, damping, a side, or what holds an imbalance back?
};

/// Forces on a node that resist its motion [kN].
template <int Dim>
struct Resistance {
  Vec<Dim> F_damping{};   ///< local damping
  Vec<Dim> F_friction{};  ///< of a wall; takes energy
  Vec<Dim> F_dashpot{};   ///< of an absorbing side
  Vec<Dim> F_reaction{};  ///< of what holds the node: fixed components and walls, with their friction
};

/// What a triangle or tetrahedron has of the mean dilatation of its patch (patches.hpp).
struct PatchShare {
  double V = 0;      ///< its volume; zero where it has none
  double p = 0;      ///< mean stress of its points
  double theta = 0;  ///< its own volume strain
};

/// What nodes have to say of the time step, where there are triangles or tetrahedra (node_rates.hpp). Soil moves by
/// parts of an element between one time that this is found and the next. Elements that are new, and those around them
/// and around emptied ones, have theirs found at once; the others do not, so that no element's depends on soil
/// elsewhere.
struct NodeBounds {
  int every = 8;  ///< steps from one time to the next, for all elements
  int age = 0;    ///< steps since the last one
  Column filled;  ///< of each slot: w Σ Ω_p
  // Of each element of the mesh, valid for active ones:
  Column least_per_mass;             ///< of PointIncrements::per_mass
  std::vector<std::uint8_t> is_due;  ///< is it to be found at once?
  std::vector<int> due;              ///< those of which it is
  // Of each active node:
  Column stiffness;  ///< ½ G_n / m_n
};

/// What a step keeps at each active node.
template <int Dim>
struct NodalState {
  std::vector<Node<Dim>> node;
  std::vector<transfer::Motion<Dim>> motion;
  std::vector<Vec<Dim>> a_dt;  ///< a dt; where there is a PIC share, with P of held components only
  std::vector<Vec<Dim>>
      half_path;  ///< with P, of nodes acted on: ½ P v^t dt, half of what forces work on; of a held component its du
  std::vector<Resistance<Dim>> resistance;  ///< with damping, and where nodes are not free
  std::vector<Vec<Dim>> push;               ///< of other fields [kN]; where the body has interactions

  void resize(std::size_t nodes) {
    for_each([nodes](auto& array) { array.resize(nodes); });
  }
  void reserve(std::size_t nodes) {
    for_each([nodes](auto& array) { array.reserve(nodes); });
  }

 private:
  template <class F>
  void for_each(F&& f) {
    f(node), f(motion), f(a_dt), f(half_path), f(resistance);
  }
};

/// What a step keeps of each active element, of each accumulator of the assembly, and of each thread and chunk.
template <int Dim>
struct Buffers {
  // Of each slot:
  std::vector<std::uint8_t> inside;  ///< are all elements around it active, too?
  Column size;                       ///< Mesh::size_of its element
  Column weight;                     ///< w of its quadrature
  Column correction;  ///< transfer::GradientCorrection of its quadrature, as stored: correction_row numbers
  std::size_t correction_row = 0;
  std::vector<std::uint8_t> left;             ///< has a point left it in this step?
  std::vector<std::uint8_t> mean_dilatation;  ///< is the volume strain of its points a mean?
  Column mean_gradient;                       ///< B̄_i of such a cell of GIMP
  std::vector<PatchShare> patch_share;        ///< of triangles and tetrahedra
  NodeBounds bounds;
  Column hoop_correction;  ///< the same of N_i / r, in a body of revolution
  Column mass_matrix;      ///< M_ij, where elements keep it
  // Of each accumulator of the assembly:
  Column sums;                                   ///< transfer::node_sums numbers
  Column momentum;                               ///< up to transfer::momentum_size numbers
  std::vector<PointIncrements<Dim>> increments;  ///< of each thread
  std::vector<BodyTotals<Dim>> totals;           ///< of each thread
  // Elements whose quadrature changes with the points that do (reweighted.hpp), and which of all these are.
  std::vector<int> changed;
  ZeroPages<std::uint8_t> is_changed;
  int steps_since_look = 0;  ///< at all points (soundness.hpp)
};

template <int Dim>
struct VelocityField {
  std::string name;
  std::vector<Block<Dim>> blocks;

  ActiveElements active;
  exec::Assembly assembly;
  comm::Halo halo;
  NodalState<Dim> nodes;
  Buffers<Dim> buffers;
  OutsideForces<Dim> outside;
  Averages<Dim> averages;  ///< of soil that softens over a length
  double least_mass = 0;   ///< a node with less only has points on the far edges of its elements, and is left out
  std::int64_t out_of_place = 0;     ///< points that changed element since their arrays were last put in order
  std::int64_t changed_element = 0;  ///< in the last step

  int point_count() const {
    int count = 0;
    for (const auto& block : blocks) count += block.size();
    return count;
  }
};

/// Numbers that an element of up to `row` nodes keeps for a component of its nodes, and for its mass matrix.
inline std::size_t padded_row(int row) {
  return static_cast<std::size_t>(row <= 4 ? 4 : (row + 7) / 8 * 8);
}
inline std::size_t mass_matrix_row(int row) {
  return transfer::mass_matrix_size(row, padded_row(row));
}

}  // namespace scarp
