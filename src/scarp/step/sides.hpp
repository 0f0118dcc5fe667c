// Absorbing sides (Lysmer and Kuhlemeyer 1969): nodes on a side of the mesh that was held, where the soil beyond it is
// stood in for by the force with which it held them, by dashpots that take waves, and by springs.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "scarp/base/vec.hpp"
#include "scarp/boundary/conditions.hpp"
#include "scarp/step/forward.hpp"

namespace scarp {

/// What stands for the soil beyond a node, along each axis: F = s (R − C w − k u), with s = min(1, 2 m / mass): soil
/// that draws back a little takes what is beyond along, and a node that loses more than half of its soil fades.
/// The node goes with w = γ v, and F_γ = γ F acts on v: a side stiffer than its soil, r = C / C_soil, weighs m / γ²
/// instead of being as stiff on a node of mass m. γ = 1 up to r = 1, and a side without end, γ = 0, is one that is
/// fixed.
template <int Dim>
struct SideNode {
  Vec<Dim> R{};       ///< with which the node was held [kN]
  Vec<Dim> C{};       ///< impedance times area [kN s/m]
  Vec<Dim> C_soil{};  ///< the same of the soil in front
  Vec<Dim> k{};       ///< stiffness of the soil beyond [kN/m]
  Vec<Dim> u{};       ///< how far the node has gone since [m]
  Vec<Dim> gamma = ones();
  double mass = 0;  ///< of the node when it was let go

  /// γ² = r^(−3/2), beyond r = 50 with another (50/r)^(3/2), of r alone. On v acts the dashpot γ² C: weaker than
  /// that of the soil, by r^(−1/2), and the spring γ² k, that of the soil times r^(1/2): at most 7 of it, and in the
  /// end none of either.
  void find_gamma() {
    for (int j = 0; j < Dim; ++j) {
      if (!(C[j] > C_soil[j])) continue;
      const double r = C[j] / C_soil[j];
      const double root = std::pow(r, -0.75) * std::min(1.0, std::pow(50 / r, 0.75));
      gamma[j] = std::max(root, 1e-100);  // is divided by
    }
  }

 private:
  static Vec<Dim> ones() {
    Vec<Dim> all;
    all.fill(1.0);
    return all;
  }
};

/// Work in a step along absorbing sides [kJ].
struct SideWork {
  double held = 0, dashpot = 0, spring = 0;  ///< by R; taken by the dashpots; stored in the springs
};

template <int Dim>
struct Sides {
  MostlyNone<int> of_node;  ///< of each node of the mesh: its place in `node`, or -1; empty where no side absorbs
  std::vector<SideNode<Dim>> node;

  bool active() const { return !of_node.empty(); }
  bool holds(int n) const { return active() && of_node[n] >= 0; }
  double share(int n, double m) const { return std::min(1.0, 2 * m / node[of_node[n]].mass); }

  double gamma(int n, int j) const { return node[of_node[n]].gamma[j]; }
  /// Is γ of node n below 1?
  bool slows(int n) const {
    if (!holds(n)) return false;
    const auto& gamma = node[of_node[n]].gamma;
    return std::any_of(gamma.begin(), gamma.end(), [](double one) { return one < 1; });
  }

  /// R − k u on node n.
  double force(int n, int j, double m) const {
    const auto& its = node[of_node[n]];
    return share(n, m) * (its.R[j] - its.k[j] * its.u[j]);
  }

  /// The dashpots: a becomes γ times what they leave of it, for a node of velocity v. Their force is −C w* with
  /// w* = γ (v + θ a dt), θ = max(½, 1 − m/(γ² C dt)): energy is taken exactly, and a light node stops without ringing.
  /// The spring's force is that of u^t, half a step late, as if a dashpot −½ k dt stood beside it. With
  /// C + ½ (1 − γ²) k dt for C it comes the nearer to that of the middle of the step the stiffer it is.
  void damp(int n, double m, const Vec<Dim>& v, double dt, Vec<Dim>& a, Vec<Dim>& F_dashpot) const {
    const double s = share(n, m);
    const auto& its = node[of_node[n]];
    for (int j = 0; j < Dim; ++j) {
      const double gamma = its.gamma[j];
      const double C = s * (its.C[j] + 0.5 * (1 - gamma * gamma) * its.k[j] * dt) * gamma, C_v = gamma * C;
      const double kappa = C_v * dt / m, theta = kappa > 2 ? 1 - 1 / kappa : 0.5;
      a[j] = (m * (gamma * a[j]) - C_v * v[j]) / (m + theta * C_v * dt);
      F_dashpot[j] = -C * (v[j] + theta * a[j] * dt);
    }
  }

  /// w = γ v of node n, in place of v or a path of it.
  void slow_down(int n, Vec<Dim>& v) const {
    for (int j = 0; j < Dim; ++j) v[j] *= node[of_node[n]].gamma[j];
  }

  /// Node n goes along `path`, in the components that are not in `set`; the dashpots act on it with F_dashpot.
  SideWork move(int n, double m, unsigned set, const Vec<Dim>& F_dashpot, const Vec<Dim>& path) {
    SideWork work;
    auto& its = node[of_node[n]];
    const double s = share(n, m);
    for (int j = 0; j < Dim; ++j) {
      if (set & (1u << j)) continue;
      const double ahead =
          0.5 * s * its.k[j] * path[j];  // of the spring's force at the end of the path, beyond that of u
      work.held += s * its.R[j] * path[j];
      work.dashpot -= (F_dashpot[j] + ahead) * path[j];
      work.spring += (s * its.k[j] * its.u[j] + ahead) * path[j];
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

/// C, C_soil and k of the nodes of a side that hold soil of a field, R and u zero, for the present soil: from the faces
/// of elements on the side, lumped, times the filled part of the elements. Throws InputError where nodes do not lie on
/// flat sides of the mesh across an axis, where δ is below five elements, and where the law does not tell its shear
/// modulus, and where a wall with friction lies on the side.
template <int Dim>
Sides<Dim> soil_beyond(const Body<Dim>& body, const VelocityField<Dim>& field, const AbsorbingSide& side);

/// Lets the nodes of a side go that hold soil: from now on only `others` are imposed on them, and what stands for the
/// soil beyond, which begins with the force that held them.
template <int Dim>
void open_side(Body<Dim>& body, const StepSettings& settings, const AbsorbingSide& side, const Conditions<Dim>& others);

}  // namespace scarp
