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

TEST(Manufactured, LinearFunctionsAtSmallStrain) {
  // A linear displacement in each element errs by O(h²), its gradient, the stress of two points on either side of the
  // middle, by O(h). With eq. 4 as printed an error of the size of the strain (6e-4) remains: volumes grow with ε while
  // points stay in their elements.
  for (const auto quadrature : {Quadrature::corrected, Quadrature::points}) {
    const auto errors = refine(2e-4, 16, 2, {GridFunctions::linear, quadrature});
    for (const double order : orders(errors.displacement)) EXPECT_GT(order, 1.85);
    for (const double order : orders(errors.stress)) EXPECT_GT(order, 0.95);
    EXPECT_LT(errors.displacement.back(), 1.6e-3);
  }
}

}  // namespace
}  // namespace scarp::verification
