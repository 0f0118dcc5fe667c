// The manufactured solution on three meshes, at small strain and at large.
#include "manufactured.hpp"

#include <gtest/gtest.h>

#include <cstdio>

namespace scarp::verification {
namespace {

struct Errors {
  std::vector<double> displacement, stress;
};

/// Relative L2 errors over a period with n, 2n and 4n elements along a side.
Errors refine(double A, int n, int per_cell, const Method& method) {
  Errors errors;
  for (const int factor : {1, 2, 4}) {
    const auto found = follow_manufactured(A, factor * n, per_cell, method);
    errors.displacement.push_back(found.displacement);
    errors.stress.push_back(found.stress);
  }
  std::printf("manufactured, A = %g, %s, %d x %d points per element, n = %d, %d, %d: displacement %s; stress %s\n", A,
              method.name().c_str(), per_cell, per_cell, n, 2 * n, 4 * n, text_of(errors.displacement).c_str(),
              text_of(errors.stress).c_str());
  return errors;
}

TEST(Manufactured, ForceBalancesTheMotionItIsDerivedFor) {
  // Oracle: ρ ü = Div P + ρ b by central differences, P_i = J σ_i / F_i from the stress that is compared with. Band:
  // the differences' own error, (3e-5)² of the fourth derivatives and 1e-16/(3e-5)² of round-off, 1e-6 of the largest
  // term.
  const Manufactured motion{0.1};
  const double d = 3e-5, t = 0.37;
  const Vec<2> X{0.3, 0.8};
  const auto P = [&](Vec<2> at, int i) {
    const Vec<2> F = motion.stretch(at, t);
    return motion.stress(at, t)[i] * F[0] * F[1] / F[i];
  };
  for (int i = 0; i < 2; ++i) {
    Vec<2> low = X, high = X;
    low[i] -= d;
    high[i] += d;
    const double acceleration =
        (motion.displacement(X, t + d)[i] - 2 * motion.displacement(X, t)[i] + motion.displacement(X, t - d)[i]) /
        (d * d);
    const double balance = motion.solid.rho * acceleration - (P(high, i) - P(low, i)) / (2 * d);
    EXPECT_NEAR(balance, motion.solid.rho * motion.force(X, t)[i], 1e-6 * motion.solid.rho);
    EXPECT_NEAR((motion.displacement(X, t + d)[i] - motion.displacement(X, t - d)[i]) / (2 * d),
                motion.velocity(X, t)[i], 1e-9);
  }
}

/// The displacement's relative L2 error over a period at small strain, from what the mappings do to sin kx, k = π.
///
/// A lumped mapping to the nodes (eqs 1, 2; 4; 7, 8) and an interpolation from them (eqs 6; 9; 16) are convolutions
/// with N: each multiplies sin kx by 1 − s k²h²/2 + O(h⁴), s h² the variance of N: s = ¼ for quadratic B-splines, ⅙ for
/// linear functions. From accelerations at the nodes to velocities of points, to the nodes, to strains, to forces there
/// are four, so that ω² is (1 − δ) times too small with δ = 2 s k²h² = ½ k²h². For linear functions the stresses of
/// elements have their own, finite elements with lumped mass: δ = (2/12 + 1/12) k²h². The nodes, of amplitude
/// m = 1 − s k²h²/2 at the start, follow
///     U'' + W² (1 − δ) U = m (W² − ω²) sin ωt,    W² = k² (λ + 2μ)/ρ, ω² = k² E/ρ,
/// as b = (W² − ω²) u at small strain; points follow m U.
double error_of_the_mapping(int n, GridFunctions shape) {
  const Manufactured motion{0};
  const double k2h2 = std::pow(motion.pi / n, 2);
  const double s = shape == GridFunctions::b_spline ? 1.0 / 4 : 1.0 / 6;
  const double delta = shape == GridFunctions::b_spline ? k2h2 / 2 : k2h2 / 4, m = 1 - s * k2h2 / 2;
  const double omega = motion.pi * motion.c(), W2 = std::pow(motion.pi * motion.solid.wave_speed(), 2);
  const double slow2 = W2 * (1 - delta), forced = m * (W2 - omega * omega) / (slow2 - omega * omega),
               free = (m - forced) * omega / std::sqrt(slow2);
  RelativeL2 error;
  for (int i = 1; i <= 1000; ++i) {
    const double t = motion.period() * i / 1000, exact = std::sin(omega * t);
    error.add(1, m * (forced * exact + free * std::sin(std::sqrt(slow2) * t)), exact);
  }
  return error.value();
}

// Band of the displacement's size: a tenth of the prediction, as O(h⁴) and the walls are left out of it.

TEST(Manufactured, SplinesAtSmallStrain) {
  // Stresses are of order 2 inside. At the walls the functions of open knots are not symmetric, and a lumped mass maps
  // a field to their centroids, not to the places that their values stand for; eqs 7 and 8 do so twice, and the order
  // of the stress falls to 1.6 as the error there comes to dominate. (Found with a plain one-dimensional step, too;
  // there it stays 2.0 where strains follow from v^t + a dt instead of eq. 8, and with a consistent mass.)
  for (const auto quadrature : {QuadratureRule::corrected, QuadratureRule::points}) {
    const auto errors = refine(2e-4, 12, 2, {GridFunctions::b_spline, quadrature});
    for (const double order : orders(errors.displacement)) EXPECT_GT(order, 1.9);
    for (const double order : orders(errors.stress)) EXPECT_GT(order, 1.5);
    const double predicted = error_of_the_mapping(48, GridFunctions::b_spline);
    EXPECT_NEAR(errors.displacement.back(), predicted, 0.1 * predicted);
  }
}

TEST(Manufactured, LinearFunctionsAndGimpAtSmallStrain) {
  // A linear displacement in each element has a gradient that errs by O(h): the stress of the points on either side of
  // the middle. GIMP with domains that tile the elements is linear. (With eq. 4 as printed an error of the size of the
  // strain remains, 3e-4 of the displacement: volumes grow with ε while points stay in their elements.)
  for (const auto shape : {GridFunctions::linear, GridFunctions::gimp}) {
    const auto errors = refine(2e-4, 12, 2, {shape});
    for (const double order : orders(errors.displacement)) EXPECT_GT(order, 1.9);
    for (const double order : orders(errors.stress)) EXPECT_NEAR(order, 1.0, 0.2);
    const double predicted = error_of_the_mapping(48, shape);
    EXPECT_NEAR(errors.displacement.back(), predicted, 0.1 * predicted);
    std::printf("  the mapping alone: %.2e with n = 48\n", predicted);
  }
}

TEST(Manufactured, SplinesAtLargeStrain) {
  // Strains of 31 %: points cross elements, and where they do not keep step with them they are a worse quadrature the
  // finer the mesh. Refinement at a fixed number of points converges no longer (with 2 × 2 points it diverges), so the
  // error is held under a ceiling: 2 % of the displacement, 4 % of the stress, with 4 × 4 points and n = 32. It is
  // 1.4 % and 2.7 %, of which the first-order strain increment is a third (a step an eighth as long leaves 1.1 %).
  const Method method{GridFunctions::b_spline};
  const auto errors = follow_manufactured(0.1, 32, 4, method);
  EXPECT_LT(errors.displacement, 0.02);
  EXPECT_LT(errors.stress, 0.04);
  std::printf("manufactured, A = 0.1, %s, 4 x 4 points per element, n = 32: displacement %.2e, stress %.2e\n",
              method.name().c_str(), errors.displacement, errors.stress);
}

}  // namespace
}  // namespace scarp::verification
