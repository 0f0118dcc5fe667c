// The account of a run: energy, mass, counts, and what a stage has seen. Fed by each step, read by history.csv and
// summary.json.
#pragma once

#include <array>
#include <cstdint>

#include "scarp/step/step.hpp"

namespace scarp::run {

/// Sums since the start of the run, and the last step's values.
template <int Dim>
struct Ledger {
  double time = 0, dt = 0;
  std::int64_t steps = 0, point_steps = 0;
  StepBooks<Dim> last;  ///< of the last step; its sums of work are of that step only
  SearchCounts search;
  double initial_mass = 0, removed_mass = 0;
  double initial_kinetic_energy = 0, removed_kinetic_energy = 0;
  double work_gravity = 0, work_stress = 0, work_release = 0, work_boundary = 0;
  double dissipation_damping = 0, dissipation_friction = 0, dissipation_pic = 0, dissipation_waves = 0;
  double dissipation_absorbing = 0, stored_sides = 0;
  double energy_reweighted = 0;  ///< no part of the balance: stored energy, of which the balance knows the work alone
  std::array<double, phases> seconds{};  ///< of each Phase; only where asked for
  std::int64_t removed_points = 0, failures = 0, corrected = 0, substeps = 0;

  /// Books one step over `points` points.
  void add(double step, int points, const StepBooks<Dim>& books);

  /// Which runs have use for a term, and a column for it in history.csv.
  enum class Use { always, release, absorbing };

  /// A term of the balance of energy, the change of kinetic energy by it being `sign` times its sum.
  struct Term {
    const char* key;  ///< column of history.csv
    double Ledger::*sum;
    double StepBooks<Dim>::*of_step;
    int sign;
    Use use = Use::always;
  };
  static constexpr int terms = 10;
  static const std::array<Term, terms>& balance();

  /// Kinetic energy that nobody accounts for: ΔE_kin + removed − the sum of all terms of the balance.
  double energy_error() const;
  /// Relative to the initial mass.
  double mass_error() const {
    return initial_mass > 0 ? (last.mass + removed_mass - initial_mass) / initial_mass : 0.0;
  }
  double unbalanced_ratio() const { return last.weight > 0 ? last.unbalanced_force / last.weight : 0.0; }
};

}  // namespace scarp::run
