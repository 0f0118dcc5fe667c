// Absorbing sides (Lysmer and Kuhlemeyer 1969): nodes on a side of the mesh that was held, where the soil beyond it is
// stood in for by the force with which it held them, by dashpots that take waves, and by springs.
#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <vector>

#include "scarp/base/vec.hpp"
#include "scarp/boundary/conditions.hpp"

namespace scarp {

/// What stands for the soil beyond a node, along each axis: F = s (R − C v − k u), with s = min(1, 2 m / mass): soil
/// that draws back a little takes what is beyond along, and a node that loses more than half of its soil fades.
template <int Dim>
struct SideNode {
  Vec<Dim> R{};     ///< with which the node was held [kN]
  Vec<Dim> C{};     ///< impedance times area [kN s/m]
  Vec<Dim> k{};     ///< stiffness of the soil beyond [kN/m]
  Vec<Dim> u{};     ///< how far the node has gone since [m]
  double mass = 0;  ///< of the node when it was let go
};

/// Work in a step along absorbing sides [kJ].
struct SideWork {
  double held = 0, dashpot = 0, spring = 0;  ///< by R; taken by the dashpots; stored in the springs
};

template <int Dim>
struct Sides {
  std::vector<int> of_node;  ///< of each node of the mesh: its place in `node`, or -1; empty where no side absorbs
  std::vector<SideNode<Dim>> node;

  bool active() const { return !of_node.empty(); }
  bool holds(int n) const { return active() && of_node[n] >= 0; }
  double share(int n, double m) const { return std::min(1.0, 2 * m / node[of_node[n]].mass); }

  /// R − k u on node n.
  double force(int n, int j, double m) const {
    const auto& its = node[of_node[n]];
    return share(n, m) * (its.R[j] - its.k[j] * its.u[j]);
  }

  /// The dashpots: a becomes what they leave of it, for a node of velocity v. The force is −C v* with
  /// v* = (1 − θ) v + θ (v + a dt), θ = max(½, 1 − m/(C dt)): energy is taken exactly, and a light node stops without
  /// ringing.
  void damp(int n, double m, const Vec<Dim>& v, double dt, Vec<Dim>& a, Vec<Dim>& F_dashpot) const {
    const double s = share(n, m);
    for (int j = 0; j < Dim; ++j) {
      const double C = s * node[of_node[n]].C[j], kappa = C * dt / m;
      const double theta = kappa > 2 ? 1 - 1 / kappa : 0.5;
      a[j] = (m * a[j] - C * v[j]) / (m + theta * C * dt);
      F_dashpot[j] = -C * (v[j] + theta * a[j] * dt);
    }
  }

  /// Node n goes along `path`, in the components that are not in `set`; the dashpots act on it with F_dashpot.
  SideWork move(int n, double m, unsigned set, const Vec<Dim>& F_dashpot, const Vec<Dim>& path) {
    SideWork work;
    auto& its = node[of_node[n]];
    const double s = share(n, m);
    for (int j = 0; j < Dim; ++j) {
      if (set & (1u << j)) continue;
      work.held += s * its.R[j] * path[j];
      work.dashpot -= F_dashpot[j] * path[j];
      work.spring += s * its.k[j] * its.u[j] * path[j];
      its.u[j] += path[j];
    }
    return work;
  }
};

/// A side that is to absorb.
struct AbsorbingSide {
  std::vector<int> nodes;
  std::optional<double> thickness;                 ///< δ of the springs [m]; 0: none; not set: the soil's larger side
  std::optional<std::array<double, 2>> impedance;  ///< Z_p, Z_s [kPa s/m]; not set: that of the soil on the side
};

template <int Dim>
struct Body;
struct StepSettings;

/// C, k and mass of the nodes of a side that hold soil, R and u zero, for the present soil: from the faces of elements
/// on the side, lumped, times the filled part of the elements. Throws InputError where nodes do not lie on flat sides
/// of the mesh across an axis, where δ is below five elements, and where the law does not tell its shear modulus.
template <int Dim>
Sides<Dim> soil_beyond(const Body<Dim>& body, const AbsorbingSide& side);

/// Lets the nodes of a side go that hold soil: from now on only `others` are imposed on them, and what stands for the
/// soil beyond, which begins with the force that held them.
template <int Dim>
void open_side(Body<Dim>& body, const StepSettings& settings, const AbsorbingSide& side, const Conditions<Dim>& others);

}  // namespace scarp
