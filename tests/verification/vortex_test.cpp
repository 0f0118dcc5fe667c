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

}  // namespace
}  // namespace scarp::verification
