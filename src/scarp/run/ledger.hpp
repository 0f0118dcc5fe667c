// The account of a run: energy, mass, counts, and what a stage has seen. Fed by each step, read by history.csv and
// summary.json.
#pragma once

#include <array>
#include <cstdint>

#include "scarp/run/archive.hpp"
#include "scarp/step/step.hpp"

namespace scarp::run {

/// Sums since the start of the run, those of the energies among them, and the last step's values.
template <int Dim>
struct Ledger : Energies {
  double time = 0, dt = 0;
  std::int64_t steps = 0, point_steps = 0;
  StepTotals<Dim> last;  ///< of the last step; its sums of work are of that step only
  SearchCounts search;
  double initial_mass = 0, removed_mass = 0;
  double initial_kinetic_energy = 0, removed_kinetic_energy = 0;
  std::array<double, phases> seconds{};  ///< of each Phase; only where asked for
  std::int64_t removed_points = 0, left_mesh = 0, failures = 0, corrected = 0, substeps = 0;

  /// f(Entry, member) for each that a checkpoint keeps, besides the last step's and the searches' (archive.hpp).
  template <class Self, class F>
  static void each_saved(Self& l, F&& f) {
    f(Entry{"time", "s", "since the start of the run"}, l.time);
    f(Entry{"dt", "s", "last time step"}, l.dt);
    f(Entry{"steps", "", "since the start of the run"}, l.steps);
    f(Entry{"point_steps", "", "sum over the steps of the number of points"}, l.point_steps);
    for (const auto& term : energy_terms) f(Entry{term.key, "kJ", term.meaning}, l.*term.sum);
    f(Entry{"initial_mass", "Mg", "at the start of the run"}, l.initial_mass);
    f(Entry{"removed_mass", "Mg", "of removed points"}, l.removed_mass);
    f(Entry{"initial_kinetic_energy", "kJ", "at the start of the run"}, l.initial_kinetic_energy);
    f(Entry{"removed_kinetic_energy", "kJ", "of removed points, and taken by zero_velocity"}, l.removed_kinetic_energy);
    f(Entry{"removed_points", "", "cut away or gone from the mesh"}, l.removed_points);
    f(Entry{"left_mesh", "", "of these, gone from the mesh"}, l.left_mesh);
    f(Entry{"failures", "", "failed stress updates"}, l.failures);
    f(Entry{"corrected", "", "stresses pulled back"}, l.corrected);
    f(Entry{"substeps", "", "of all stress updates"}, l.substeps);
  }

  /// Books one step over `points` points.
  void add(double step, int points, const StepTotals<Dim>& totals);

  /// Kinetic energy that nobody accounts for: ΔE_kin + removed − the sum of all terms of the balance, each with its
  /// sign.
  double energy_error() const;
  /// Relative to the initial mass.
  double mass_error() const {
    return initial_mass > 0 ? (last.mass + removed_mass - initial_mass) / initial_mass : 0.0;
  }
  double unbalanced_ratio() const { return last.weight > 0 ? last.unbalanced_force / last.weight : 0.0; }
};

}  // namespace scarp::run
