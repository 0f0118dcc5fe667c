// Turning, colliding and flying bodies and the vortex, by the schemes of the step.
#include <gtest/gtest.h>

#include "discs.hpp"
#include "flying_block.hpp"
#include "roughness.hpp"
#include "vortex.hpp"

namespace scarp::verification {
namespace {

/// A scheme with linear functions and the corrected quadrature.
Method with(const Scheme& scheme) {
  Method method;
  method.scheme = scheme;
  return method;
}
Scheme two_terms() {
  return undamped(two_term_scheme());
}
Scheme damped(double share) {
  Scheme scheme = two_terms();
  scheme.damping.share = share;
  return scheme;
}

struct Turn {
  double kept, highest, end;  ///< of the angular momentum; of the energy, parts of that at the start
};

Turn turn(int n, const Scheme& scheme) {
  const auto run = turn_disc(n, with(scheme));
  EXPECT_LT(run.momentum, 1e-13);
  const auto &first = run.history.front(), &last = run.history.back();
  Turn its{last.angular_momentum / first.angular_momentum, 0, (last.kinetic + last.stored) / first.kinetic};
  for (const auto& at : run.history) its.highest = std::max(its.highest, (at.kinetic + at.stored) / first.kinetic);
  std::printf("turning disc, n = %d: angular momentum kept %.3f, energy at most %.4f, %.4f at the end\n", n, its.kept,
              its.highest, its.end);
  return its;
}

TEST(Schemes, TwoTermsKeepTheSpinOfAFreeDisc) {
  // A lumped mass loses Σ (A x)_i × f_i dt, which two terms make Σ (A² x)_i × f_i dt (docs/theory.md): the loss in a
  // turn of the report's scheme, 0.16 and 0.06, at least halved. The stand-alone trial kept 0.927 and 0.985.
  for (const auto& [n, least] : {std::pair{20, 0.92}, {40, 0.975}}) {
    const auto two = turn(n, two_terms()), one = turn(n, report_scheme());
    EXPECT_GT(two.kept, least);
    EXPECT_LT(1 - two.kept, 0.5 * (1 - one.kept));
    // Points that change element weight the stored energy of two elements anew, which gains 2 % in a turn at n = 40
    // (energy_reweighted). ξ = 0.01, the standard of elastic laws, takes it.
    EXPECT_LT(turn(n, damped(0.01)).highest, 1.001);
  }
}

TEST(Schemes, PointsWithTheirVelocityGradientGainNoEnergy) {
  // Pure apic has no share of FLIP: energy can only fall. (It keeps next to no spin of a free body,
  // docs/verification.md: no band for that.)
  EXPECT_LT(turn(20, undamped(apic_scheme())).highest, 1 + 1e-9);
}

TEST(Schemes, CollidingDiscsKeepMomentumAndEnergy) {
  // The bands of discs_test.cpp; of the kinetic energy two terms smooth away less: 0.94 in place of 0.89 of it are
  // there in the end.
  double kinetic = 0;
  for (const auto& [name, scheme] : all_schemes()) {
    const auto run = collide(20, with(scheme));
    EXPECT_LT(run.momentum, 1e-13) << name;
    double low = 1, high = 1;
    const auto &first = run.history.front(), &last = run.history.back();
    for (const auto& at : run.history) {
      low = std::min(low, (at.kinetic + at.stored) / first.kinetic);
      high = std::max(high, (at.kinetic + at.stored) / first.kinetic);
    }
    EXPECT_LT(high, 1.01) << name;
    EXPECT_GT(low, scheme.affine ? 0.8 : 0.97) << name;  // apic takes 14 % in the collision
    if (scheme.two_terms) {
      EXPECT_GT(last.kinetic, first.kinetic * (kinetic + 0.03));
    }
    kinetic = last.kinetic / first.kinetic;  // of the report's, which comes before that of two terms
    std::printf("colliding discs, %s: energy %.4f to %.4f, kinetic at the end %.4f\n", name, low, high, kinetic);
  }
}

TEST(Schemes, VortexIsOfSecondOrderWithLinearFunctions) {
  // A = 1, 4 x 4 points, all that is of first order in h or t left out: the lumped mass (0.040 at n = 80), the strain
  // of the step's start, the mean dilatation, late leaving (2.2 %; with it points at the edge may get lost). What is
  // left is of order 2: 1.5 % in the stand-alone trial.
  Scheme scheme = two_terms();
  scheme.mean_dilatation = false;
  scheme.lateness = 0;
  std::vector<double> errors;
  for (const int n : {40, 80}) errors.push_back(follow_vortex(1, n, 4, with(scheme)).displacement);
  EXPECT_LT(errors[1], 0.02);
  EXPECT_GT(orders(errors)[0], 1.8);
  std::printf("vortex, A = 1, two terms: %s\n", text_of(errors).c_str());
}

TEST(Schemes, VortexKeepsNearTheMotionWithMeanDilatation) {
  // The standard in everything that is not damping: half the error of the report's (0.18).
  const double error = follow_vortex(1, 40, 4, with(two_terms())).displacement;
  EXPECT_LT(error, 0.08);
  std::printf("vortex, A = 1, n = 40, two terms and mean dilatation: %.4f\n", error);
}

TEST(Schemes, BlockInFreeFallKeepsItsSpin) {
  // 4 x 4 elements of 2 x 2 points, whose edge a lumped mass pulls inwards by a quarter of an element: it keeps 0.65.
  const auto one = fly(report_scheme()), two = fly(two_terms()), standard = fly(two_term_scheme());
  EXPECT_GT(two.spin, 0.80);
  EXPECT_GT(two.spin, one.spin + 0.1);
  // Falling is exact with every scheme: P c = c of a uniform c, and stress has no resultant.
  for (const auto& its : {one, two, standard, fly(undamped(apic_scheme()))}) EXPECT_LT(its.fall, 1e-6);
  std::printf("flying block: spin kept %.3f (report), %.3f (two terms), %.3f (standard); fall off by %.1e\n", one.spin,
              two.spin, standard.spin, standard.fall);
}

TEST(Schemes, PointOnACornerOfTheGridStaysWithoutStress) {
  // Three of its element's nodes have no mass: with velocity zero there it was strained and lost its energy. No force
  // acts, so that nothing may change but its place; round-off of a thousand steps.
  for (const Scheme& scheme : {two_term_scheme(), apic_scheme()}) {
    auto body = on_grid({0, 0}, {8, 3}, {8, 3}, {0, 0});
    auto& block = add_points(body, linear_elastic(1000, 0.2), 1, {{{1, 1}, 1}});
    block.points.v[0][0] = 1;
    locate_points(body, true);
    StepSettings settings;
    settings.scheme = scheme;
    run_until(body, 6, 0.3, settings, [&](double t, const StepTotals<2>& totals) {
      ASSERT_NEAR(totals.kinetic_energy, 0.5, 1e-12) << "t = " << t;
    });
    const auto& points = body.blocks()[0].points;
    EXPECT_NEAR(points.x[0][0], 7, 1e-10);
    for (int c = 0; c < 4; ++c) EXPECT_NEAR(points.sigma[c][0], 0, 1e-9);
  }
}

TEST(Schemes, BlockWithItsEdgesOnLinesMovesOnAsItIs) {
  // 3 x 3 points of which the outer ones lie on lines of the grid all around, moving as one across five elements.
  for (const Scheme& scheme : {two_term_scheme(), apic_scheme()}) {
    auto body = on_grid({0, 0}, {10, 4}, {10, 4}, {0, 0});
    std::vector<Place> places;
    for (const double y : {1.0, 1.5, 2.0}) {
      for (const double x : {1.0, 1.5, 2.0}) places.push_back({{x, y}, 0.25});
    }
    auto& block = add_points(body, linear_elastic(1000, 0.2), 1, places);
    for (double& v : block.points.v[0]) v = 1;
    locate_points(body, true);
    StepSettings settings;
    settings.scheme = scheme;
    run_until(body, 5, 0.3, settings, [&](double t, const StepTotals<2>& totals) {
      ASSERT_NEAR(totals.kinetic_energy, 9 * 0.125, 1e-9) << "t = " << t;
    });
  }
}

/// The error of the books of soft ground that swings for half a second, over the largest kinetic energy. It starts with
/// the stress of its weight and with a pressure of 20 kPa more and less from element to element. Nothing takes energy.
double error_of_totals(Cells cells, double safety) {
  auto body = soft_slope(cells, 0.5, 0.5 / 3, 0.45);
  auto& points = body.blocks()[0].points;
  for (int p = 0; p < points.size(); ++p) {
    for (int j = 0; j < 3; ++j) points.sigma[j][p] += points.element[p] % 2 == 0 ? 20 : -20;
  }
  StepSettings settings;
  settings.scheme = two_terms();
  double balance = 0, largest = 0, worst = 0;
  run_until(body, 0.5, safety, settings, [&](double, const StepTotals<2>& totals) {
    balance += totals.work_gravity - totals.work_stress - totals.dissipation_pic - totals.dissipation_waves;
    largest = std::max(largest, totals.kinetic_energy);
    worst = std::max(worst, std::abs(totals.kinetic_energy - balance));
  });
  return worst / largest;
}

TEST(Schemes, BooksOfTrianglesClose) {
  // The mean stress that nodes feel is that of a patch, and so is the volume strain that stress works on. Were only one
  // of them, the books would be off by what the stress of elements differs from their patch's, whatever the time step:
  // by 1.2 here. What is left is the error of the time integration, of first order in dt.
  const double whole = error_of_totals(Cells::triangles, 0.5), half = error_of_totals(Cells::triangles, 0.25);
  std::printf("books of swinging ground on triangles: off by %.2e, by %.2e with half the time step\n", whole, half);
  EXPECT_LT(whole, 0.1);
  EXPECT_LT(half, 0.6 * whole);
}

}  // namespace
}  // namespace scarp::verification
