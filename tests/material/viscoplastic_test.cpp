// The viscoplastic subloading model: closed forms of its isotropic states, its limits at slow and at fast straining,
// creep and relaxation (docs/models/viscoplastic-subloading.md).
#include <gtest/gtest.h>
#include <cmath>

#include "dual.hpp"
#include "samples.hpp"
#include "scarp/material/integrate/embedded.hpp"

namespace scarp::test {
namespace {

using State = ViscoplasticSubloading::State<double, 6>;
using Strain = Sym<double, 6>;
using Step = Increment<double, 6>;
constexpr double kappa = 0.02, lambda = 0.1;
const Strain none = Strain::zero();

ViscoplasticSubloading viscoplastic(std::map<std::string, double> values, double mu, double n, double R_m) {
  values.insert({{"mu", mu}, {"n", n}, {"R_m", R_m}});
  return std::get<ViscoplasticSubloading>(made("viscoplastic-subloading", values));
}

IntegrationReport run(const auto& model, auto& s, const Step& step, double tolerance = 1e-9) {
  const auto report = integrate<DormandPrince>(model, s, step, {tolerance, 1e-12});
  EXPECT_EQ(report.end, IntegrationEnd::done) << "reached " << report.reached;
  return report;
}

/// An undrained triaxial strain, compression along z.
Strain undrained(double eps_q) {
  return {{-0.5 * eps_q, -0.5 * eps_q, eps_q, 0, 0, 0}};
}

double R_of(const ViscoplasticSubloading& model, const State& s) {
  return model.slow_limit().homothety(s).R;
}
double static_ratio(const ViscoplasticSubloading& model, const State& s) {
  return model.R_s(s, R_of(model, s));
}

/// Isotropic soil of the Modified Cam Clay limit that stands at R = p/p_c with the static ratio 1.
State isotropic_state(double R) {
  State s{};
  s.sigma = isotropic<double, 6>(100.0);
  s.p_c = 100 / R;
  s.R_b = 1;
  s.overstress = R - 1;
  return s;
}

// ---- Closed forms. Isotropic, a = 0, ξ = 0: R = p/p_c, ε̇_v^vp = √3 ‖ε̇^vp‖, ln p_c grows by ε_v^vp/(λ̄ − κ̄); R_s = 1
// stays.

/// The time, in units of μ, that R takes from R0 down to R where Ṙ = −b R ‖ε̇^vp‖ and n = 1:
/// (1/b) ∫ (R_m − R) / (R (R − 1)) dR, in partial fractions −R_m/R + (R_m − 1)/(R − 1).
double time_to(double R, double R0, double R_m, double b) {
  return ((R_m - 1) * std::log((R0 - 1) / (R - 1)) - R_m * std::log(R0 / R)) / b;
}

TEST(Viscoplastic, IsotropicRelaxation) {
  const double mu = 50, R_m = 2, b = std::sqrt(3.0) * lambda / (kappa * (lambda - kappa));
  const auto model = viscoplastic(cam_clay_constants(), mu, 1, R_m);
  auto s = isotropic_state(1.4);
  double t = 0;
  for (double R : {1.3, 1.1, 1.01, 1.0001}) {
    const double at = mu * time_to(R, 1.4, R_m, b);
    run(model, s, {none, at - t});
    t = at;
    EXPECT_NEAR(R_of(model, s), R, 1e-7);  // tolerance 1e-9 in each of less than 100 substeps
    // ln p falls and ln p_c grows in the ratio 1/κ̄ : 1/(λ̄ − κ̄).
    EXPECT_NEAR(std::log(mean(s.sigma) / 100) / std::log(s.p_c / (100 / 1.4)), -(lambda - kappa) / kappa, 1e-6);
    EXPECT_NEAR(static_ratio(model, s), 1, 1e-7);
  }
}

// Held at one stress: p_c alone moves, Ṙ = −√3 R ‖ε̇^vp‖/(λ̄ − κ̄). The strain that keeps the stress is the viscoplastic
// one, ε_v = (λ̄ − κ̄) ln(R0/R): given that strain over the times of the closed form, the stress must stay.
TEST(Viscoplastic, IsotropicCreep) {
  const double mu = 50, R_m = 2, b = std::sqrt(3.0) / (lambda - kappa);
  const auto model = viscoplastic(cam_clay_constants(), mu, 1, R_m);
  double before = 0;
  for (int steps : {100, 200}) {
    auto s = isotropic_state(1.4);
    double R = 1.4, off = 0;
    const double ratio = std::pow(0.01 / 0.4, 1.0 / steps);  // R − 1 in equal ratios, from 0.4 to 0.01
    for (int i = 0; i < steps; ++i) {
      const double next = 1 + (R - 1) * ratio, time = mu * time_to(next, R, R_m, b);
      run(model, s, {isotropic<double, 6>((lambda - kappa) * std::log(R / next) / 3), time});
      R = next;
      off = std::max(off, std::abs(mean(s.sigma) / 100 - 1));
    }
    EXPECT_NEAR(R_of(model, s), 1.01, 1e-4);
    EXPECT_LT(off, 1e-3);
    if (before > 0) {
      EXPECT_NEAR(before / off, 4, 0.5);  // strain is linear in time within a step: second order
    }
    before = off;
  }
}

// Compressed at one rate, R tends to the value at which plastic strain is (λ̄ − κ̄)/λ̄ of the strain, and the stress to a
// line parallel to the normal compression line: an isotache.
TEST(Viscoplastic, SteadyCompressionIsAnIsotache) {
  const double mu = 200, R_m = 1.5, rate = 1e-4;
  for (double n : {1.0, 2.0, 3.5}) {
    const auto model = viscoplastic(cam_clay_constants(), mu, n, R_m);
    auto s = isotropic_state(1.0);
    for (int i = 0; i < 20; ++i) run(model, s, {isotropic<double, 6>(0.01 / 3), 0.01 / rate});
    const double R = R_of(model, s);
    EXPECT_NEAR(std::pow(R - 1, n) / (R_m - R), mu * rate * (lambda - kappa) / (lambda * std::sqrt(3.0)), 1e-6);
    const double p = mean(s.sigma);
    run(model, s, {isotropic<double, 6>(0.01 / 3), 0.01 / rate});
    EXPECT_NEAR(mean(s.sigma) / p, std::exp(0.01 / lambda), 1e-6);
  }
}

// Explicit integration is stable for steps of 2/λ, λ = (N:D:G + H)/(‖G‖ N:(σ_y − a)) ∂‖ε̇^vp‖/∂R the rate at which an
// overstress dies out. With the overstress well above the tolerance the step control finds that size, once rounding has
// grown to the tolerance: over a long strain.
TEST(Viscoplastic, SlowStrainingCostsSubstepsOfTheStableSize) {
  const double mu = 200, R_m = 1.5, b = std::sqrt(3.0) * lambda / (kappa * (lambda - kappa));
  const auto model = viscoplastic(cam_clay_constants(), mu, 1, R_m);
  for (double rate : {1e-6, 1e-5}) {
    auto s = isotropic_state(1.0);
    run(model, s, {isotropic<double, 6>(0.002 / 3), 0.002 / rate});
    const double R = R_of(model, s), decay = b * R / mu * (R_m - 1) / ((R_m - R) * (R_m - R)), time = 0.01 / rate;
    const auto report =
        integrate<ModifiedEuler>(model, s, Step{isotropic<double, 6>(rate * time / 3), time}, {1e-6, 1e-9});
    ASSERT_EQ(report.end, IntegrationEnd::done);
    EXPECT_NEAR(report.substeps * 2 / (decay * time), 1, 0.1) << report.substeps;
  }
}

/// The elastoplastic state with the derivative of each of its components in the direction of `change`.
Subloading::State<Dual, 6> along(const Subloading::State<double, 6>& s, const Subloading::State<double, 6>& change) {
  Subloading::State<Dual, 6> dual{};
  for_each_component([](Dual& x, const double& v, const double& d) { x = Dual(v, d); }, dual, s, change);
  return dual;
}

// ---- The law shares all but the multiplier with the elastoplastic one ----

TEST(Viscoplastic, FlowsAndHardensAsTheElastoplasticLaw) {
  const auto model = viscoplastic(full_constants(), 30, 1.5, 1.4);
  const auto& elastoplastic = model.slow_limit();
  const auto& c = elastoplastic.parameters();
  std::mt19937 generator(31);
  int compared = 0;
  for (int i = 0; i < 200; ++i) {
    const auto base = random_state<6>(generator, elastoplastic);
    const auto deps = random_tensor<6>(generator, 1e-4);
    const double R = elastoplastic.homothety(base).R;
    const auto reference = elastoplastic.rate(base, deps);
    const double size = norm(reference.change.epsp);
    if (R < 0.1 || !reference.sound || size == 0) continue;
    ++compared;
    const State s{base, 0.2 * R};
    const double dt = 0.01, flow = dt / 30 * std::pow(0.2 * R, 1.5) / (1.4 - R), w = flow / size;
    const auto d = model.rate(s, deps, dt).change;
    EXPECT_NEAR(norm(d.epsp), flow, 1e-13);
    EXPECT_LT(norm(d.epsp - w * reference.change.epsp), 1e-12 * flow);
    EXPECT_LT(norm(d.beta - w * reference.change.beta), 1e-12 * norm(d.beta));
    EXPECT_LT(norm(d.a - w * reference.change.a), 1e-12 * norm(d.a));
    EXPECT_NEAR(d.p_c, w * reference.change.p_c, 1e-12 * std::abs(d.p_c));
    EXPECT_NEAR(d.R_b, w * reference.change.R_b, 1e-12 * std::abs(d.R_b));
    const double K = (mean(s.sigma) + c.p_e) / c.kappa, G2 = 3 * (1 - 2 * c.nu) / (1 + c.nu) * K;
    const auto elastic = deps - d.epsp;
    EXPECT_LT(norm(d.sigma - G2 * deviator(elastic) - isotropic<double, 6>(K * trace(elastic))), 1e-12 * K * 1e-4);
    // R of the changed state moves by the overstress and by eq. 31 at R_s: R by dual numbers, nothing of the law's own.
    const double R_change = elastoplastic.homothety(along(base, d)).R.d;
    const double R_s_change = -c.c_R * std::log((0.8 * R - c.R_min) / (1 - c.R_min)) * flow;
    EXPECT_NEAR(d.overstress, R_change - R_s_change, 1e-10 * (std::abs(R_change) + 1e-2));
  }
  EXPECT_GT(compared, 30);
}

// Elastic motion below the static ratio: R_s goes down with R and stays while R comes back.
TEST(Viscoplastic, UnloadingTakesTheStaticRatioAlong) {
  const auto model = viscoplastic(full_constants(), 1e3, 1, 1.5);
  std::vector<Problem> problems;
  auto s = model.initial_state<6>(isotropic<double, 6>(100.0), 100, {{"R_b", 1.0}, {"OCR", 1.1}}, problems);
  ASSERT_TRUE(problems.empty());
  auto R = [&] { return R_of(model, s); };
  run(model, s, {isotropic<double, 6>(-1e-3), 1e-6});
  const double low = R();
  EXPECT_NEAR(low, (103 * std::exp(-0.003 / 0.015) - 3) / 100 / 1.1, 1e-3);  // elastic; ξ = 0.003 is next to nothing
  EXPECT_EQ(static_ratio(model, s), low);
  run(model, s, {isotropic<double, 6>(5e-4), 1e-6});
  EXPECT_GT(R(), low + 0.05);
  EXPECT_NEAR(static_ratio(model, s), low, 1e-6);  // a time of 1e-9 μ lets nothing flow
}

// In one increment past the centre of homothety R falls and grows again, and the least R on the way is the static
// ratio. The error control finds it: the overstress starts to grow there.
TEST(Viscoplastic, StaticRatioSeesTheLowestRInsideAnIncrement) {
  const auto model = viscoplastic(full_constants(), 1e9, 1, 1.5);  // next to no flow
  std::vector<Problem> problems;
  const Values initial{{"R_b", 1.0}, {"OCR", 1.5}, {"a", 0.9}};
  auto whole = model.initial_state<6>({{60, 60, 100, 0, 0, 0}}, 100, initial, problems);
  ASSERT_TRUE(problems.empty());
  auto parts = whole;
  const auto deps = undrained(-4e-3);
  double lowest = 1;
  for (int i = 0; i < 4000; ++i) {
    run(model, parts, {1.0 / 4000 * deps, 1e-6}, 1e-6);
    lowest = std::min(lowest, R_of(model, parts));
  }
  EXPECT_GT(R_of(model, parts), lowest + 0.2);
  EXPECT_NEAR(static_ratio(model, parts), lowest, 1e-5);
  for (double tolerance : {1e-3, 1e-5, 1e-7}) {
    auto at_once = whole;
    run(model, at_once, {deps, 1e-6}, tolerance);
    EXPECT_NEAR(static_ratio(model, at_once), lowest, 20 * tolerance + 1e-5);
    std::printf("  %g: %g\n", tolerance, static_ratio(model, at_once) - lowest);
  }
}

// ---- Slow and fast ----

template <class Model>
auto triaxial_start(const Model& model) {
  std::vector<Problem> problems;
  auto s = model.template initial_state<6>(
      {{60, 60, 100, 0, 0, 0}}, 100, {{"R_b", 2.5}, {"OCR", 1.6}, {"a", 0.4}, {"beta", std::string("K0")}}, problems);
  EXPECT_TRUE(problems.empty());
  return s;
}

/// Undrained loading, unloading and loading again at one rate of ε_q; q after every part.
std::vector<Strain> cycle(const auto& model, double rate) {
  auto s = triaxial_start(model);
  std::vector<Strain> stresses;
  for (double sense : {1.0, 1.0, 1.0, 1.0, 1.0, -1.0, -1.0, 1.0, 1.0, 1.0}) {
    run(model, s, {undrained(1e-3 * sense), 1e-3 / rate}, 1e-7);
    stresses.push_back(s.sigma);
  }
  return stresses;
}

double largest_difference(const std::vector<Strain>& a, const std::vector<Strain>& b) {
  double worst = 0;
  for (std::size_t i = 0; i < a.size(); ++i) worst = std::max(worst, norm(a[i] - b[i]) / norm(b[i]));
  return worst;
}

// The overstress of a strain rate is (μ ‖ε̇^vp‖ (R_m − R))^{1/n} to leading order, and so is the difference to the
// elastoplastic curve, unloading and reloading included.
TEST(Viscoplastic, SlowStrainingTendsToTheElastoplasticModel) {
  for (double n : {1.0, 2.0}) {
    const auto model = viscoplastic(full_constants(), 100, n, 1.5);
    const auto limit = cycle(model.slow_limit(), 1.0);
    const double overstress = n == 1 ? 2e-3 : 1e-2;  // of a rate near 1 in the parentheses
    const double rate = std::pow(overstress, n) / 100;
    const double at = largest_difference(cycle(model, rate), limit),
                 slower = largest_difference(cycle(model, rate / 4), limit),
                 slowest = largest_difference(cycle(model, rate / 16), limit);
    std::printf("  n = %g: %.2e %.2e %.2e\n", n, at, slower, slowest);
    EXPECT_NEAR(at / slower, std::pow(4, 1 / n), 0.15 * std::pow(4, 1 / n));
    EXPECT_NEAR(slower / slowest, std::pow(4, 1 / n), 0.15 * std::pow(4, 1 / n));
    EXPECT_LT(slowest, overstress);
  }
}

TEST(Viscoplastic, FastStrainingRaisesTheStrengthUpToRm) {
  const double R_m = 1.3;
  const auto model = viscoplastic(full_constants(), 100, 1, R_m);
  double before = 0;
  for (double rate : {1e-6, 1e-5, 1e-4, 1e-3, 1e-2, 1e-1}) {
    auto s = triaxial_start(model);
    double strength = 0;
    for (int i = 0; i < 40; ++i) {
      run(model, s, {undrained(1e-3), 1e-3 / rate}, 1e-6);
      strength = std::max(strength, deviatoric_stress(s.sigma));
      EXPECT_LT(R_of(model, s), R_m);
    }
    EXPECT_GT(strength, before) << rate;
    before = strength;
  }
}

TEST(Viscoplastic, StressBeyondRmIsRefused) {
  const auto model = viscoplastic(full_constants(), 100, 1, 1.1);
  auto s = triaxial_start(model);
  const auto report = integrate<DormandPrince>(model, s, Step{undrained(0.05), 0.0}, {1e-6, 1e-9});
  EXPECT_NE(report.end, IntegrationEnd::done);
  EXPECT_GT(report.reached, 0);
  EXPECT_TRUE(model.admissible(s));
  EXPECT_NEAR(R_of(model, s), 1.1, 1e-4);  // the state just before
}

TEST(Viscoplastic, AcceptedStatesKeepTheirBounds) {
  const auto model = viscoplastic(cam_clay_constants(), 100, 1, 1.5);
  for (double R : {0.005, 0.4, 1.49, 1.51}) {
    for (double overstress : {-0.1, 0.2, 0.5}) {
      auto s = isotropic_state(R);
      s.overstress = overstress;
      const auto flags = model.accept(s, 1e-4);
      EXPECT_EQ(flags.sound, R < 1.5);
      EXPECT_EQ(model.admissible(s), R < 1.5);
      EXPECT_FALSE(flags.corrected);
      EXPECT_NEAR(R_of(model, s), R, 1e-12);                                          // R > 1 is not pulled back
      EXPECT_DOUBLE_EQ(s.overstress, std::max(0.0, std::min(overstress, R - 0.01)));  // R_min ≤ R_s ≤ R
    }
  }
}

// ---- Relaxation and creep of a general state ----

TEST(Viscoplastic, StressRelaxesUntilNoOverstressIsLeft) {
  const auto model = viscoplastic(full_constants(), 100, 1, 1.5);
  auto s = triaxial_start(model);
  run(model, s, {undrained(0.01), 1.0});
  auto overstress = [&] { return s.overstress; };
  double before = overstress(), q = deviatoric_stress(s.sigma);
  EXPECT_GT(before, 0.1);
  for (double time : {0.1, 1.0, 10.0, 100.0}) {
    run(model, s, {none, time}, 1e-7);
    EXPECT_LT(overstress(), before);
    EXPECT_LT(deviatoric_stress(s.sigma), q);
    before = overstress();
    q = deviatoric_stress(s.sigma);
  }
  EXPECT_NEAR(before, 0, 1e-6);
}

// Held at one stress by the strain that undoes its change, found step by step.
TEST(Viscoplastic, CreepAtConstantStressSlowsDownAndEnds) {
  const auto model = viscoplastic(full_constants(), 100, 1, 1.5);
  const auto& c = model.slow_limit().parameters();
  auto s = triaxial_start(model);
  run(model, s, {{{0.002, 0.002, 0.01, 0, 0, 0}}, 1.0});
  const auto held = s.sigma;
  double before = 1, moved = 0;
  for (int i = 0; i < 300; ++i) {
    const double dt = 0.02 * std::pow(1.03, i);
    Strain deps = none;
    for (int k = 0; k < 30; ++k) {
      auto trial = s;
      run(model, trial, {deps, dt}, 1e-8);
      const auto off = held - trial.sigma;
      const double K = (mean(held) + c.p_e) / c.kappa, G2 = 3 * (1 - 2 * c.nu) / (1 + c.nu) * K;
      deps = deps + (1 / G2) * deviator(off) + isotropic<double, 6>(mean(off) / (3 * K));
      if (norm(off) < 1e-6 * norm(held)) break;
    }
    run(model, s, {deps, dt}, 1e-8);
    EXPECT_LT(norm(s.sigma - held), 1e-4 * norm(held));
    const double rate = norm(deps) / dt;
    if (rate > 1e-8) {
      EXPECT_LT(rate, before) << i;  // below, what the stress is found to, 1e-6, is all that is left
    }
    before = rate;
    moved += deps[2];
  }
  EXPECT_GT(moved, 1e-3);
  EXPECT_LT(s.overstress, 1e-3);
}

TEST(Viscoplastic, DualNumbersGiveTheDerivativeOfTheRate) {
  const auto model = viscoplastic(full_constants(), 30, 2.0, 1.5);
  auto s = triaxial_start(model);
  run(model, s, {undrained(2e-3), 1.0});
  const auto deps = undrained(1e-4);
  const auto direction = model.rate(s, deps, 0.1).change;
  ViscoplasticSubloading::State<Dual, 6> dual{};
  for_each_component([](Dual& x, const double& v, const double& d) { x = Dual(v, d); }, dual, s, direction);
  Sym<Dual, 6> dual_deps;
  for (int i = 0; i < 6; ++i) dual_deps[i] = Dual(deps[i]);
  const auto exact = model.rate(dual, dual_deps, Dual(0.1)).change;
  const double h = 1e-3;
  const auto ahead = model.rate(advanced(s, h, direction), deps, 0.1).change,
             behind = model.rate(advanced(s, -h, direction), deps, 0.1).change;
  for_each_component(
      [&](const Dual& x, const double& a, const double& b) {
        EXPECT_NEAR(x.d, (a - b) / (2 * h), 1e-6 * std::abs(x.d) + 1e-9);  // h² of the third derivative, and rounding
      },
      exact, ahead, behind);
}

}  // namespace
}  // namespace scarp::test
