// The account of a run. Oracles: sums worked out here; the motion of a body with known energies.
#include "scarp/run/ledger.hpp"

#include <gtest/gtest.h>

namespace scarp::run {
namespace {

TEST(Ledger, AddsUpWhatStepsBook) {
  Ledger<2> ledger;
  double work = 0, removed_mass = 0;
  for (int n = 1; n <= 5; ++n) {
    StepTotals<2> totals;
    totals.work_gravity = n;
    totals.dissipation_friction = 0.5 * n;
    totals.removed_energy = 0.1 * n;
    totals.removed_mass = 0.01 * n;
    totals.removed = n;
    totals.search.own = 10 * n;
    totals.search.most_examined = 7 - n;
    totals.seconds[1] = 2 * n;
    totals.stress.failures = 3 * n;
    totals.stress.corrected = 4 * n;
    totals.stress.substeps = 5 * n;
    totals.kinetic_energy = 100 * n;
    totals.mass = 50 - n;
    ledger.add(0.25 * n, 1000 + n, totals);
    work += n;
    removed_mass += 0.01 * n;
  }
  EXPECT_EQ(ledger.steps, 5);
  EXPECT_DOUBLE_EQ(ledger.time, 0.25 * 15);
  EXPECT_DOUBLE_EQ(ledger.dt, 1.25);  // of the last step
  EXPECT_EQ(ledger.point_steps, 5 * 1000 + 15);
  EXPECT_DOUBLE_EQ(ledger.work_gravity, work);
  EXPECT_DOUBLE_EQ(ledger.dissipation_friction, 0.5 * work);
  EXPECT_DOUBLE_EQ(ledger.removed_kinetic_energy, 0.1 * work);
  EXPECT_DOUBLE_EQ(ledger.removed_mass, removed_mass);
  EXPECT_EQ(ledger.removed_points, 15);
  EXPECT_EQ(ledger.search.own, 150);
  EXPECT_EQ(ledger.search.most_examined, 6);  // the most, no sum
  EXPECT_DOUBLE_EQ(ledger.seconds[1], 30);
  EXPECT_EQ(ledger.failures, 45);
  EXPECT_EQ(ledger.corrected, 60);
  EXPECT_EQ(ledger.substeps, 75);
  EXPECT_DOUBLE_EQ(ledger.last.kinetic_energy, 500);
  EXPECT_DOUBLE_EQ(ledger.last.mass, 45);
}

// A body of 2 Mg at 3 m/s (9 kJ) falls, gaining 10 kJ of gravity; friction takes 4 kJ of it, 1 kJ is stored in soil.
TEST(Ledger, EnergyClosesWhereEachTermHasItsSign) {
  Ledger<2> ledger;
  ledger.initial_kinetic_energy = 9;
  StepTotals<2> totals;
  totals.work_gravity = 10;
  totals.dissipation_friction = 4;
  totals.work_stress = 1;
  totals.kinetic_energy = 9 + 10 - 4 - 1;
  ledger.add(1, 1, totals);
  EXPECT_NEAR(ledger.energy_error(), 0, 1e-14);
  // Points that leave take 3 kJ with them; nothing is lost by that.
  StepTotals<2> leaving;
  leaving.kinetic_energy = 11;
  leaving.removed_energy = 3;
  ledger.add(1, 1, leaving);
  EXPECT_NEAR(ledger.energy_error(), 0, 1e-14);
  // What is re-weighted is shown and is no part of the balance; what nobody books is its error.
  StepTotals<2> odd;
  odd.kinetic_energy = 11.5;
  odd.energy_reweighted = 7;
  ledger.add(1, 1, odd);
  EXPECT_NEAR(ledger.energy_error(), 0.5, 1e-14);
}

TEST(Ledger, MassAndBalanceOfForces) {
  Ledger<3> ledger;
  EXPECT_EQ(ledger.mass_error(), 0);
  EXPECT_EQ(ledger.unbalanced_ratio(), 0);
  ledger.initial_mass = 10;
  ledger.removed_mass = 2;
  ledger.last.mass = 8;
  EXPECT_EQ(ledger.mass_error(), 0);
  ledger.last.mass = 8.5;
  EXPECT_DOUBLE_EQ(ledger.mass_error(), 0.05);
  ledger.last.weight = 80;
  ledger.last.unbalanced_force = 20;
  EXPECT_DOUBLE_EQ(ledger.unbalanced_ratio(), 0.25);
}

}  // namespace
}  // namespace scarp::run
