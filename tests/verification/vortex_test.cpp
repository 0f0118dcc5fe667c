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

/// Relative L2 errors over 0 ≤ t ≤ 1 on some meshes of n × n elements, n/6 of them across the ring.
DrivenErrors refine(double A, std::initializer_list<int> meshes, int per_cell, const Method& method,
                    std::vector<double>& displacement) {
  std::vector<double> stress;
  for (const int n : meshes) {
    const auto found = follow_vortex(A, n, per_cell, method);
    displacement.push_back(found.displacement);
    stress.push_back(found.stress);
  }
  std::printf("vortex, A = %g, %s, %d x %d points, up to n = %d: displacement %s; stress %s\n", A,
              method.name().c_str(), per_cell, per_cell, *(meshes.end() - 1), text_of(displacement).c_str(),
              text_of(stress).c_str());
  return {displacement.back(), stress.back()};
}

TEST(Vortex, SmallTurnsConvergeWithEveryShape) {
  // A = 0.1, shear strains up to 0.6. Second order as any smooth motion (with four elements across the ring errors are
  // half of the motion, so that the first refinement gains more). Band: 5 % with sixteen elements across.
  for (const auto shape : all_shapes) {
    std::vector<double> errors;
    EXPECT_LT(refine(0.1, {24, 48, 96}, 2, {shape}, errors).displacement, 0.05);
    for (const double order : orders(errors)) EXPECT_GT(order, 1.9);
  }
}

TEST(Vortex, SmoothFunctionsFollowTheWholeTurn) {
  // A = 1, shear strains up to 6: shells pass each other by three elements and come back. Band: 5 % of the displacement
  // and 25 % of the stress with thirteen elements across the ring.
  // Two errors meet: that of the mesh, of order 2, and that of the strain increments, of first order in dt (the turn
  // comes before the strain, docs/verification.md), which has the other sign. (Linear functions break down here with so
  // few points, and smooth ones with fewer: make validate.)
  for (const auto shape : {GridFunctions::b_spline, GridFunctions::gimp}) {
    std::vector<double> errors;
    const auto fine = refine(1, {40, 80}, 3, {shape}, errors);
    EXPECT_LT(fine.displacement, 0.05);
    EXPECT_LT(fine.stress, 0.25);
    EXPECT_GT(orders(errors).back(), 1.9);
  }
}

}  // namespace
}  // namespace scarp::verification
