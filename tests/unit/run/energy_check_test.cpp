// The watch over the books of energy, fed with ledgers of motions whose energies are known.
#include "scarp/run/energy_check.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace scarp::run {
namespace {

/// A body of mass m under a force m g in steps of `dt`, as the step does it: velocities change first, and places with
/// the new ones. `lost` of the work each step is not in the books.
class Fall {
 public:
  Fall(double mass, double g, double dt, double lost = 0) : mass_(mass), g_(g), dt_(dt), lost_(lost) {}

  const Ledger<2>& step() {
    v_ += g_ * dt_;
    StepTotals<2> totals;
    totals.work_gravity = mass_ * g_ * v_ * dt_;
    totals.dissipation_damping = -lost_ * totals.work_gravity;
    totals.kinetic_energy = 0.5 * mass_ * v_ * v_;
    ledger.add(dt_, 1, totals);
    return ledger;
  }
  void turn() { v_ = -v_; }

  Ledger<2> ledger;

 private:
  double mass_, g_, dt_, lost_, v_ = 0;
};

TEST(EnergyCheck, FallsWithoutAWarningFromTheFirstStep) {
  // The books' own error, ½ m g v dt, is 1/n of the work after n steps: over a per cent for the first hundred.
  Fall fall(2, 10, 1e-3);
  EnergyCheck check(fall.ledger, 0);
  for (int n = 0; n < 1000; ++n) check.step(fall.step());
  EXPECT_GT(check.relative(fall.ledger), 0.9e-3);
  EXPECT_LT(check.largest_ratio(), 0.003);  // ¼ (g dt)² against ½ (20 g dt)²: 0.12 %
  EXPECT_LT(check.ratio(), 1e-6);
}

TEST(EnergyCheck, SeesWhatNobodyAccountsFor) {
  for (const double lost : {-0.05, 0.05}) {
    Fall fall(2, 10, 1e-3, lost);
    EnergyCheck check(fall.ledger, 0);
    for (int n = 0; n < 1000; ++n) check.step(fall.step());
    EXPECT_NEAR(check.ratio(), 0.05, 2e-4);  // the work is short by that of the last half step
    EXPECT_NEAR(check.largest_at(), 1.0, 1.0);
    EXPECT_NE(energy_warning(check).find("5 % now"), std::string::npos) << energy_warning(check);
  }
}

TEST(EnergyCheck, ComparesWithTheLargestEnergiesOfTheRun) {
  // Back where it came from, gravity has done no work in all; its largest work is what counts.
  Fall fall(2, 10, 1e-3, 0.05);
  EnergyCheck check(fall.ledger, 0);
  for (int n = 0; n < 500; ++n) check.step(fall.step());
  const double worst = check.largest_ratio(), largest_work = fall.ledger.work_gravity;
  fall.turn();
  for (int n = 0; n < 500; ++n) check.step(fall.step());
  // What is not accounted for falls as gravity takes its work back; over that work alone it would grow without bound.
  EXPECT_NEAR(fall.ledger.work_gravity, 0, 0.01 * largest_work);
  EXPECT_LT(check.largest_ratio(), 1.1 * worst);
  EXPECT_LT(check.ratio(), 0.1 * worst);
}

TEST(EnergyCheck, TakesNoNoticeOfEnergiesOfNoAccount) {
  Fall fall(2, 10, 1e-3, 0.5);
  const double largest = 0.5 * 2 * 10 * 10;  // of the kinetic energy, after a second
  EnergyCheck check(fall.ledger, 100 * largest);
  for (int n = 0; n < 1000; ++n) check.step(fall.step());
  EXPECT_NEAR(check.ratio(), 0.005, 1e-4);
}

TEST(EnergyCheck, CountsAnewFromTheCut) {
  Fall before(2, 10, 1e-3, 0.5);
  EnergyCheck check(before.ledger, 0);
  for (int n = 0; n < 100; ++n) check.step(before.step());
  EXPECT_GT(check.ratio(), 0.1);
  check.start(before.ledger);
  EXPECT_EQ(check.ratio(), 0);
  EXPECT_EQ(check.relative(before.ledger), 0);
  EXPECT_GT(check.largest_ratio(), 0.1) << "the run keeps its worst";
}

TEST(EnergyCheck, HoldsStillWithoutAnyEnergy) {
  Ledger<3> ledger;
  EnergyCheck check(ledger, 0);
  for (int n = 0; n < 100; ++n) {
    ledger.add(1e-3, 1, {});
    check.step(ledger);
  }
  EXPECT_EQ(check.largest_ratio(), 0);
}

}  // namespace
}  // namespace scarp::run
