// What makes a scheme of the step, in one place: how velocities go between points and nodes, how strain is formed of
// them, what damps waves, and when a point changes element. docs/theory.md, "Schemes".
//
// Every scheme forms at the nodes a change c_n of the points' velocities (step 4) and displacements du_n (step 5):
//     v_p = φ v_p + Σ c_i N_i,     x_p += Σ du_i N_i.
// With M_ij = Σ m_p N_i N_j and m_i = Σ_j M_ij, a lumped node stands for its points' centroid instead of its own place.
// What that smooths away is (A w)_i = w_i − Σ_j M_ij w_j / m_i; P w = w + A w gives the first term of it back.
//
//                 report                      two-term                       apic
//     c           φ a dt + (1 − φ) ṽ          P [φ a dt + (1 − φ) ṽ]         ṽ
//     v^{t+dt}    (φ p + M c) / m             (φ p + M c) / m                M c / m
//     du          v^{t+dt} dt                 P v^{t+dt} dt                  P v^{t+dt} dt
//     φ           flip                        exp(−dt / τ)                   0
// with ṽ = v^t + a dt and conditions wherever a velocity is formed. With pure FLIP P stands in both places or none: it
// is symmetric in the product Σ m_i, so that the points' kinetic energy changes by the work of the nodal forces on the
// motion they make.
// Points of apic carry C_p = Σ (du_i / dt) ⊗ B_i, and bring m_p N_i (v_p + C_p (x_i − x_p)) to the nodes: the affine
// particle-in-cell method (Jiang et al. 2015), of which this is the Taylor form with other functions than linear ones
// (Nakamura et al. 2023). C_p is taken of v^{t+dt}, not of ṽ: nodes with next to no mass have any ṽ, and where elements
// are filled in part C_p of it grows until the points leave the mesh.
//
// Another scheme is another function below, and where it does what none of these does, another member and its line in
// the functions of a node.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>

#include "scarp/base/vec.hpp"
#include "scarp/boundary/conditions.hpp"
#include "scarp/exec/stress_update.hpp"

namespace scarp {

/// Damping of the rate of stress: nodes feel σ* = σ + (β/dt) (σ − Q σ^t Qᵀ), the stress that a point will have β later.
/// Elastic waves lose β ω/2 of critical; soil that flows at constant stress is not damped.
struct StressDamping {
  std::optional<double> share;  ///< ξ, β = ξ h/c: of critical at the shortest wave of an element; not set: by the law
  double time = 0;              ///< β [s]; where it is positive, in place of the share

  /// ξ of a law: strain that a law remembers makes noise dear; elastic bodies keep just what takes the energy that
  /// points bring in when they change element.
  static constexpr double of_elastic = 0.01, of_others = 0.4;
  double share_of(bool elastic) const { return share.value_or(elastic ? of_elastic : of_others); }
};

struct Scheme {
  double flip = 1;  ///< share of its own velocity that a point keeps in a step
  double pic_time = std::numeric_limits<double>::infinity();  ///< τ [s]: φ = flip · exp(−dt/τ)
  bool two_terms = false;                                     ///< P on changes of velocity and displacements
  bool affine = false;                                        ///< points carry C_p
  bool middle = false;           ///< strain and spin of the middle of the step, of second order
  bool mean_dilatation = false;  ///< volume strain is a mean over full elements, or patches of simplices
  bool bounds_by_nodes = false;  ///< the time step of simplices is that of their nodes, too (step/node_rates.hpp)
  bool shares_gaps = false;      ///< what points of an element have opened they share (exec/gap_sharing.hpp)
  double lateness = 0;  ///< η: a point may be so far (in parts of the element) beyond its element and stay in it
  bool smooth = false;  ///< local damping follows the velocity through zero instead of its sign
  bool mends_massless = false;  ///< nodes without mass move with the others of an element
  WallRule wall = WallRule::by_acceleration;
  StressDamping damping{0.0, 0};

  /// φ of a step
  double kept(double dt) const { return flip * std::exp(-dt / pic_time); }
  /// Is P before displacements?
  bool filters_motion() const { return two_terms || affine; }
};

/// The report's, with φ the same in each step whatever its length.
inline Scheme report_scheme(double flip = 1) {
  Scheme s;
  s.flip = flip;
  return s;
}

/// What all but the report's have of time, strain and elements.
inline Scheme standard_scheme() {
  Scheme s;
  s.middle = s.mean_dilatation = s.bounds_by_nodes = s.shares_gaps = s.smooth = s.mends_massless = true;
  s.wall = WallRule::by_motion;
  s.lateness = 0.02;
  s.damping = {};
  return s;
}

/// The standard: PIC per unit of time on velocities of two terms.
inline Scheme two_term_scheme(double pic_time = 0.5) {
  Scheme s = standard_scheme();
  s.two_terms = true;
  s.pic_time = pic_time;
  return s;
}

inline Scheme apic_scheme() {
  Scheme s = standard_scheme();
  s.affine = true;
  s.flip = 0;
  return s;
}

namespace scheme {

/// Is what PIC takes booked of sums at the nodes? Otherwise points book it, who then need a velocity more.
inline bool records_pic_at_nodes(const Scheme& s, double dt) {
  return s.two_terms && s.kept(dt) < 1;
}

/// w and M w of a node to P w; held components are not corrected.
inline double filtered(double w, double M_w, double per_mass) {
  return 2 * w - M_w * per_mass;
}

/// The same at a side that is stiffer than its soil, where (1 + γ A γ) w stands for P w: of γ w and M γ w.
inline double filtered_of(double gamma, double gamma_w, double M_w, double per_mass) {
  return gamma_w / gamma + gamma * (gamma_w - M_w * per_mass);
}

/// φ a dt + (1 − φ) ṽ, with ṽ and a as they are, or with P before both.
inline double change_of_velocity(double phi, double a, double dt, double v_next) {
  return phi * a * dt + (1 - phi) * v_next;
}

/// The direction that local damping acts against, of a velocity component v where the unbalanced force would change it
/// by a_dt in the step: its sign, or what follows it through zero, so that velocities of rounding size do not decide.
inline double direction(const Scheme& s, double v, double a_dt) {
  if (!s.smooth) return std::copysign(1.0, v);
  const double soft = 0.1 * a_dt;
  return v / std::sqrt(v * v + soft * soft);
}

/// What the law's update does about waves, for a law of this kind (exec/stress_update.hpp). With P in place of the
/// lumped mass a mode of the nodes that has the share λ of its mass in m⁻¹M has ω² λ (2 − λ)² in place of ω² λ: at most
/// 32/27 ω². Local damping α makes the force that slows a node 1 + α times as large, and with it ω². (With the lumped
/// mass and few points in an element λ is so far below 1 that this does no harm; the report's limit is as it was.)
inline exec::WaveSettings waves(const Scheme& s, bool elastic, double local_damping = 0) {
  double highest2 = s.two_terms ? 32.0 / 27.0 : 1.0;
  if (s.filters_motion()) highest2 *= 1 + local_damping;
  return {s.damping.time > 0 ? 0 : s.damping.share_of(elastic), s.damping.time, highest2, s.shares_gaps};
}

}  // namespace scheme
}  // namespace scarp
