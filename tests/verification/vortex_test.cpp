// The generalised vortex on three meshes.
#include "vortex.hpp"

#include <gtest/gtest.h>

#include <cstdio>

namespace scarp::verification {
namespace {

TEST(Vortex, ForceBalancesTheMotionItIsDerivedFor) {
  // Oracle: ρ ẍ = div σ + ρ b at a point of the deformed ring, with ẍ and div σ by central differences; J = 1, so that
  // shells keep their radii and the point that is now at x came from the angle θ − α(R). Band: the differences' error.
  const Vortex motion;
  const double d = 1e-4, t = 0.3;
  const auto stress_at = [&](const Vec<2>& x) {
    const double R = std::hypot(x[0], x[1]), back = std::atan2(x[1], x[0]) - std::sin(motion.rate * t) * Vortex::g(R);
    return motion.stress({R * std::cos(back), R * std::sin(back)}, t);
  };
  const Vec<2> X{0.55, 0.7};
  const auto at = [&](double time) {
    const Vec<2> u = motion.displacement(X, time);
    return Vec<2>{X[0] + u[0], X[1] + u[1]};
  };
  const Vec<2> x = at(t), before = at(t - d), after = at(t + d), b = motion.force(X, t);
  const auto slope = [&](int c, int k) {
    Vec<2> low = x, high = x;
    low[k] -= d;
    high[k] += d;
    return (stress_at(high)[c] - stress_at(low)[c]) / (2 * d) * (c == 3 ? 1 / sqrt2 : 1.0);
  };
  const Vec<2> divergence{slope(0, 0) + slope(3, 1), slope(3, 0) + slope(1, 1)};
  for (int j = 0; j < 2; ++j) {
    const double acceleration = (after[j] - 2 * x[j] + before[j]) / (d * d);
    EXPECT_NEAR(acceleration - divergence[j] / motion.solid.rho, b[j], 1e-4 * std::hypot(b[0], b[1]));
    EXPECT_NEAR((after[j] - before[j]) / (2 * d), motion.velocity(X, t)[j], 1e-5);
  }
}

/// Relative L2 errors over 0 ≤ t ≤ 1 with 4, 8 and 16 elements across the ring, 2 × 2 points in each.
struct Errors {
  std::vector<double> displacement, stress;
};

Errors refine(double A, const Method& method) {
  Errors errors;
  for (const int n : {24, 48, 96}) {
    const auto found = follow_vortex(A, n, 2, method);
    errors.displacement.push_back(found.displacement);
    errors.stress.push_back(found.stress);
  }
  std::printf("vortex, A = %g, %s, n = 24, 48, 96: displacement %s; stress %s\n", A, method.name().c_str(),
              text_of(errors.displacement).c_str(), text_of(errors.stress).c_str());
  return errors;
}

TEST(Vortex, SmallTurnsConvergeWithEveryShape) {
  // A = 0.1, shear strains up to 0.6. Second order as any smooth motion (with four elements across the ring errors of
  // half of the motion, so that the first step of refinement gains more). Band: 5 % with sixteen elements across.
  for (const auto shape : all_shapes) {
    const auto errors = refine(0.1, {shape});
    for (const double order : orders(errors.displacement)) EXPECT_GT(order, 1.9);
    EXPECT_LT(errors.displacement.back(), 0.05);
  }
}

TEST(Vortex, SmoothFunctionsFollowTheWholeTurn) {
  // A = 1, shear strains up to 6: shells pass each other by three elements and come back. Band: 6 % with sixteen
  // elements across, each refinement at least halving what was left. (Linear functions break down here with 2 × 2 and 3
  // × 3 points: make validate.)
  for (const auto shape : {GridFunctions::b_spline, GridFunctions::gimp}) {
    const auto errors = refine(1, {shape});
    EXPECT_LT(errors.displacement[2], 0.5 * errors.displacement[1]);
    EXPECT_LT(errors.displacement[1], 0.5 * errors.displacement[0]);
    EXPECT_LT(errors.displacement.back(), 0.06);
    EXPECT_LT(errors.stress.back(), 0.25);
  }
}

}  // namespace
}  // namespace scarp::verification
