// The embedded Runge–Kutta pairs on a law with a known solution, and how the step control ends.
#include "scarp/material/integrate/embedded.hpp"

#include <gtest/gtest.h>
#include <cmath>

#include "material/samples.hpp"

namespace scarp::test {
namespace {

/// Two coupled variables, linear in the strain ε_xx = t: σ_xx' = σ_xx + y, y' = −y.
struct Growth {
  template <class T, int N>
  struct State {
    Sym<T, N> sigma;
    T y;
    template <class F, class... States>
    static void each(F&& f, States&... s) {
      f(s.sigma...);
      f(s.y...);
    }
  };
  double limit = 1e300;  ///< of σ_xx: beyond it no state is admissible

  template <class T, int N>
  Rate<State<T, N>, T> rate(const State<T, N>& s, const Sym<T, N>& deps) const {
    State<T, N> change{};
    change.sigma[0] = (s.sigma[0] + s.y) * deps[0];
    change.y = T(0.0) - s.y * deps[0];
    return {change, s.sigma[0] <= T(limit)};
  }
  template <class T, int N>
  Mask<T> admissible(const State<T, N>& s) const {
    return s.sigma[0] <= T(limit);
  }
  template <class T, int N>
  T error_norm(const State<T, N>& s, const State<T, N>& e) const {
    return norm(e.sigma) / norm(s.sigma);
  }
  template <class T, int N>
  UpdateFlags<T> accept(State<T, N>& s, double) const {
    return {false, false, false, s.sigma[0] <= T(limit)};
  }
};

using GrowthState = Growth::State<double, 6>;
const Sym<double, 6> unit_strain{{1, 0, 0, 0, 0, 0}};

GrowthState start() {
  GrowthState s{};
  s.sigma[0] = 1;
  s.y = 1;
  return s;
}

/// σ' = σ + y, y' = −y from (1, 1): σ = 3/2 e^t − ½ e^−t.
double exact(double t) {
  return 1.5 * std::exp(t) - 0.5 * std::exp(-t);
}

template <class Pair>
double error_in_equal_steps(int n) {
  const Growth law;
  GrowthState s = start();
  for (int i = 0; i < n; ++i) s = attempt<Pair>(law, s, (1.0 / n) * unit_strain, 1.0).state;
  return std::abs(s.sigma[0] - exact(1));
}

// Observed order between 16 and 32 steps; a wrong coefficient costs at least one order.
TEST(Pairs, OrderOfConvergence) {
  EXPECT_NEAR(std::log2(error_in_equal_steps<ModifiedEuler>(16) / error_in_equal_steps<ModifiedEuler>(32)), 2, 0.1);
  EXPECT_NEAR(std::log2(error_in_equal_steps<DormandPrince>(16) / error_in_equal_steps<DormandPrince>(32)), 5, 0.2);
}

// The estimate of a pair p(p−1) is the error of the lower solution: h^p to leading order.
template <class Pair>
double estimate(double h) {
  return attempt<Pair>(Growth{}, start(), h * unit_strain, 1.0).error;
}

TEST(Pairs, OrderOfTheErrorEstimate) {
  EXPECT_NEAR(std::log2(estimate<ModifiedEuler>(0.02) / estimate<ModifiedEuler>(0.01)), 2, 0.1);
  EXPECT_NEAR(std::log2(estimate<DormandPrince>(0.2) / estimate<DormandPrince>(0.1)), 5, 0.3);
}

template <class Pair>
void expect_tolerance_is_met() {
  for (double tolerance : {1e-4, 1e-6, 1e-8}) {
    GrowthState s = start();
    const auto report = integrate<Pair>(Growth{}, s, unit_strain, {tolerance, 1e-9});
    EXPECT_EQ(report.end, IntegrationEnd::done);
    EXPECT_EQ(report.reached, 1);
    // Local errors of the lower solution, at most one tolerance for each substep.
    EXPECT_LT(std::abs(s.sigma[0] / exact(1) - 1), tolerance * report.substeps);
  }
}

TEST(Integrate, MeetsItsTolerance) {
  expect_tolerance_is_met<ModifiedEuler>();
  expect_tolerance_is_met<DormandPrince>();
}

/// σ' = 1 up to σ = kink, 3 beyond it.
struct Kinked : Growth {
  double kink = 0;
  template <class T, int N>
  Rate<State<T, N>, T> rate(const State<T, N>& s, const Sym<T, N>& deps) const {
    State<T, N> change{};
    change.sigma[0] = (s.sigma[0] < kink ? 1.0 : 3.0) * deps[0];
    return {change, true};
  }
};

// The estimate of a pair of high order misses an error at a kink by up to two orders of magnitude, wherever in a
// substep the kink comes to lie; with doubted substeps confirmed the error stays within a few tolerances.
TEST(Integrate, KinksOfALawKeepTheTolerance) {
  constexpr double tolerance = 1e-7;
  double worst = 0;
  for (int i = 1; i < 200; ++i) {
    Kinked law;
    law.kink = 1 + i / 200.0;
    GrowthState s = start();
    integrate<DormandPrince>(law, s, unit_strain, {tolerance, 1e-12});
    const double expected = law.kink + 3 * (2 - law.kink);
    worst = std::max(worst, std::abs(s.sigma[0] / expected - 1));
  }
  EXPECT_LT(worst, 10 * tolerance);
}

TEST(Integrate, AStateThatCannotGoOnStopsAndSaysHowFar) {
  GrowthState s = start();
  const Growth law{exact(0.5)};
  const auto report = integrate<DormandPrince>(law, s, unit_strain, {1e-6, 1e-7});
  EXPECT_NE(report.end, IntegrationEnd::done);
  EXPECT_NEAR(report.reached, 0.5, 1e-3);
  EXPECT_NEAR(s.sigma[0], exact(report.reached), 1e-5);  // the last accepted state, not a trial
  EXPECT_LE(s.sigma[0], law.limit);
}

TEST(Integrate, AnImpossibleToleranceIsNotConverged) {
  GrowthState s = start();
  EXPECT_EQ(integrate<ModifiedEuler>(Growth{}, s, unit_strain, {1e-14, 1e-3}).end, IntegrationEnd::not_converged);
}

// Known from the reference's README: a normally consolidated isotropic state of strong structure has no solution under
// strain control where c_b (1 − R_bf/R_b)/√3 > 1/κ̄ + 1/(λ̄ − κ̄).
TEST(Integrate, AMaterialInstabilityIsReported) {
  const double limit = 1 / 0.02 + 1 / 0.08;
  for (double factor : {0.9, 1.1}) {
    const double c_b = factor * limit * std::sqrt(3.0) / (1 - 1.0 / 4);
    const auto model = subloading(cam_clay_constants(), {{"c_b", c_b}});
    const auto none = Sym<double, 6>::zero();
    Subloading::State<double, 6> s{isotropic<double, 6>(100.0), none, none, none, 100.0, 4.0};
    const auto report = integrate<ModifiedEuler>(model, s, isotropic<double, 6>(1e-6), {1e-6, 1e-7});
    EXPECT_EQ(report.end, factor < 1 ? IntegrationEnd::done : IntegrationEnd::unstable);
    EXPECT_EQ(mean(s.sigma) == 100, factor > 1);  // never stepped across
  }
}

TEST(Integrate, NaNIsNeverAccepted) {
  const auto model = subloading(full_constants());
  std::vector<Problem> problems;
  auto s = model.initial_state<6>({{60, 60, 100, 0, 0, 0}}, 100, {{"R_b", 1.0}, {"OCR", 1.5}}, problems);
  const auto before = s;
  const auto report = integrate<ModifiedEuler>(model, s, Sym<double, 6>{{std::nan(""), 0, 0, 0, 0, 0}}, {1e-6, 1e-7});
  EXPECT_NE(report.end, IntegrationEnd::done);
  EXPECT_EQ(s.sigma[0], before.sigma[0]);
}

}  // namespace
}  // namespace scarp::test
