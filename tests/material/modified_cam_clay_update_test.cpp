// The update of Modified Cam Clay: a slow twin, the crossing of the surface, tolerances, batches, random increments.
#include <gtest/gtest.h>
#include <cmath>

#include "cam_clay.hpp"
#include "lanes.hpp"

namespace scarp::test::cam_clay {
namespace {

// Slow twin: forward Euler on the rate form in 2e5 steps, which switches between elastic and plastic as it goes; its
// error is of the order of one step's share. Paths that start inside, and on the surface going in and out again.
TEST(ModifiedCamClay, UpdateIsTheRateIntegrated) {
  std::mt19937 generator(2);
  const auto model = clay({{"p_e", 5}});
  const Sym<double, 6> sigma{{80, 80, 140, 10, 0, 5}};
  int through = 0;
  for (int i = 0; i < 12; ++i) {
    auto s = start(model, i % 2 == 0 ? 1.0 : 1.5, sigma);
    auto deps = random_tensor<6>(generator, 0.01);
    if (i % 4 == 0) deps = (-0.03 / norm(deviator(sigma))) * deviator(sigma);  // unloads, and yields in extension
    auto slow = s;
    constexpr int n = 200000;
    for (int k = 0; k < n; ++k) slow = advanced(slow, 1.0 / n, model.rate(slow, deps).change);
    const double before = s.p_c;
    strain(model, s, deps);
    EXPECT_LT(norm(s.sigma - slow.sigma), 1e-4 * norm(s.sigma)) << i;
    EXPECT_LT(norm(s.epsp - slow.epsp), 1e-4 * norm(deps)) << i;
    EXPECT_NEAR(s.p_c / slow.p_c, 1, 1e-4) << i;
    EXPECT_LT(model.yield(s.sigma, s.p_c), 1e-12 * s.p_c * s.p_c);
    through += s.p_c != before;
  }
  EXPECT_GT(through, 8);
}

// The crossing is met exactly, not searched by the step control: an increment of the size of the point method's that
// crosses is one substep like any other.
TEST(ModifiedCamClay, CrossingCostsNoSubsteps) {
  std::mt19937 generator(3);
  const auto model = clay({{"p_e", 5}});
  int crossings = 0;
  for (int i = 0; i < 300; ++i) {
    auto s = start(model, 1.005);
    const auto deps = random_tensor<6>(generator, 1e-4) + isotropic<double, 6>(0.7e-4);
    const auto report = strain<ModifiedEuler>(model, s, deps, 1e-4);
    EXPECT_EQ(report.substeps + report.rejected, 1);
    EXPECT_FALSE(report.flags.corrected);
    crossings += norm(s.epsp) > 0;
  }
  EXPECT_GT(crossings, 30);
}

// From the surface inwards and out on the other side, at constant p from q to −q: elastic over 2q/3G, then plastic over
// a little more. One substep, whose plastic part starts at the exit.
TEST(ModifiedCamClay, ThroughTheSurfaceAndOut) {
  const auto model = clay();
  const Sym<double, 6> sigma{{80, 80, 140, 0, 0, 0}};
  auto s = start(model, 1, sigma);
  const double elastic = 2 * 60 * kappa / (3 * r * 100), plastic = 1e-5;
  const auto report = strain<ModifiedEuler>(model, s, triaxial(0, -(elastic + plastic)), 1e-4);
  EXPECT_EQ(report.substeps + report.rejected, 1);
  auto t = start(model, 1, Sym<double, 6>{{120, 120, 60, 0, 0, 0}});
  strain(model, t, triaxial(0, -plastic));
  EXPECT_LT(norm(s.sigma - t.sigma), 1e-6 * norm(s.sigma));
  EXPECT_LT(norm(s.epsp - t.epsp), 1e-3 * plastic);  // second order in a strain of 1e-5 over κ̄
  EXPECT_GT(norm(t.epsp), 0.1 * plastic);
}

// The error falls with the tolerance, for both pairs, over the yield point too.
TEST(ModifiedCamClay, ErrorFollowsTheTolerance) {
  const auto model = clay();
  const double eta0 = M * std::sqrt(0.5), eta = 1.1, eps_q = eta0 * kappa / (3 * r) + undrained_strain(eta0, eta);
  for (double tolerance : {1e-4, 1e-6, 1e-8}) {
    auto s = start(model, 1.5), t = s;
    strain<ModifiedEuler>(model, s, triaxial(0, eps_q), tolerance);
    strain<DormandPrince>(model, t, triaxial(0, eps_q), tolerance);
    EXPECT_LT(std::abs(q_over_p(s) - eta), 10 * tolerance);
    EXPECT_LT(std::abs(q_over_p(t) - eta), 10 * tolerance);
    // What the pairs leave of f is returned at the same total strain, so that it does not add up: 1e-10 is its square.
    for (const auto& end : {s, t}) EXPECT_LT(std::abs(model.yield(end.sigma, end.p_c)), 1e-10 * end.p_c * end.p_c);
  }
}

// Lanes that stay inside, cross, load on the surface and stand on the floor, side by side: each gives what double
// gives.
TEST(ModifiedCamClay, MixedLanesGiveWhatDoubleGives) {
  std::mt19937 generator(5);
  const auto model = clay({{"p_e", 5}, {"p_c_floor", 0.01}});
  int inside = 0, plastic = 0;
  std::size_t number = 0;
  for (int round = 0; round < 50; ++round) {
    std::array<State, batch_lanes> s;
    std::array<Sym<double, 6>, batch_lanes> deps;
    ModifiedCamClay::State<Batch, 6> many;
    for (std::size_t i = 0; i < batch_lanes; ++i) {
      const std::size_t kind = number++ % 4;
      const double size = kind == 3 ? 0.005 : 1;
      s[i] = start(model, std::array{3.0, 1.003, 1.0, 1.0}[kind], size * (p100 + 50.0 * random_tensor<6>(generator)));
      deps[i] = random_tensor<6>(generator, 1e-4);
      if (round % 5 == 0) deps[i] = Sym<double, 6>{{0, 0, 0, 1e-4, 0, 0}};  // no volume change: 0/0 in a careless form
    }
    auto* const lanes = reinterpret_cast<double*>(s.data());
    int c = 0;
    for_each_component(
        [&](Batch& x) {
          std::array<double, batch_lanes> values;
          for (std::size_t i = 0; i < batch_lanes; ++i)
            values[i] = lanes[static_cast<int>(i) * state_size<ModifiedCamClay, 6>() + c];
          x = pack(values);
          ++c;
        },
        many);
    const auto trial = attempt<ModifiedEuler>(model, many, pack<6>(deps), 1e-4);
    for (std::size_t i = 0; i < batch_lanes; ++i) {
      const auto one = attempt<ModifiedEuler>(model, s[i], deps[i], 1e-4);
      EXPECT_EQ(trial.flags.sound.get(i), one.flags.sound);
      EXPECT_EQ(trial.flags.on_floor.get(i), one.flags.on_floor);
      EXPECT_LT(norm(lane(trial.state.sigma, i) - one.state.sigma), 1e-12 * norm(one.state.sigma));
      EXPECT_LT(norm(lane(trial.state.epsp, i) - one.state.epsp), 1e-12 * norm(deps[i]));
      EXPECT_NEAR(lane(trial.state.p_c, i), one.state.p_c, 1e-12 * one.state.p_c);
      EXPECT_NEAR(lane(trial.error, i), one.error, 1e-9 * one.error + 1e-15);
      (norm(one.state.epsp) > 0 ? plastic : inside) += 1;
    }
  }
  EXPECT_GT(inside, (inside + plastic) / 10);
  EXPECT_GT(plastic, (inside + plastic) / 10);
}

// Random states and increments up to 1e-2: done or reported, never outside the surface, and σ:dε^p ≥ 0 there
// (σ:N = 2f + p p_c).
TEST(ModifiedCamClay, RandomIncrementsStayAdmissible) {
  std::mt19937 generator(4);
  std::uniform_real_distribution<double> uniform(0, 1);
  const auto model = clay({{"p_e", 5}, {"p_c_floor", 0.01}});
  int failed = 0;
  for (int i = 0; i < 2000; ++i) {
    auto s = start(model, 1 + 5 * uniform(generator) * (i % 3), p100 + 60.0 * random_tensor<6>(generator));
    for (int k = 0; k < 10; ++k) {
      const auto deps = random_tensor<6>(generator, std::pow(10, -4 + 2 * uniform(generator)));
      const auto report = integrate<ModifiedEuler>(model, s, deps, {1e-4, 1e-7});
      if (report.end != IntegrationEnd::done) {
        ++failed;
        break;
      }
      EXPECT_LE(model.yield(s.sigma, s.p_c), 2e-4 * s.p_c * s.p_c);
      EXPECT_TRUE(model.admissible(s));
      EXPECT_GE(dot(s.sigma, model.rate(s, deps).change.epsp), -1e-8 * s.p_c * norm(deps));
    }
  }
  std::printf("  %d of 2000 paths ended in a reported failure\n", failed);
  EXPECT_LT(failed, 2);
}

// Softening that no strain can follow is reported: with κ̄/(λ̄ − κ̄) above its bound N:D:N + H vanishes on the dry side.
TEST(ModifiedCamClay, InstabilityIsReported) {
  const std::map<std::string, double> steep{{"kappa", 0.06}, {"p_e", 0}};  // κ̄/(λ̄ − κ̄) = 1.5
  for (double OCR : {1.5, 20.0}) {
    const auto model = clay(steep);
    auto s = start(model, OCR);
    auto end = IntegrationEnd::done;
    for (int i = 0; i < 100 && end == IntegrationEnd::done; ++i)
      end = integrate<DormandPrince>(model, s, triaxial(0, 3e-3), {1e-6, 1e-7}).end;
    EXPECT_EQ(end, OCR == 20 ? IntegrationEnd::unstable : IntegrationEnd::done) << OCR;
    EXPECT_LE(model.yield(s.sigma, s.p_c), 1e-6 * s.p_c * s.p_c);
  }
}

}  // namespace
}  // namespace scarp::test::cam_clay
