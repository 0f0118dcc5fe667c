// Modified Cam Clay on its own: closed forms (docs/models/modified-cam-clay.md), the subloading model's limit, and the
// end of strength.
#include "scarp/material/modified_cam_clay.hpp"

#include <gtest/gtest.h>
#include <cmath>

#include "cam_clay.hpp"
#include "reference.hpp"

namespace scarp::test::cam_clay {
namespace {

// ---- Closed forms, constitutive laws of natural strain; all to 1e-6 with Dormand–Prince at 1e-9 ----

// From OCR = 2, in one increment over the yield point, and back: κ̄, then λ̄, then κ̄.
TEST(ModifiedCamClay, IsotropicCompressionAndUnloading) {
  for (double p_e : {0.0, 20.0}) {
    const auto model = clay({{"p_e", p_e}});
    auto s = start(model, 2);
    strain(model, s, isotropic<double, 6>(0.06));
    const double to_yield = kappa * std::log((200 + p_e) / (100 + p_e));
    EXPECT_NEAR((mean(s.sigma) + p_e) / (200 + p_e), std::exp((0.18 - to_yield) / lambda), 1e-7);
    EXPECT_NEAR(s.p_c, mean(s.sigma), 1e-8 * s.p_c);
    const double p = mean(s.sigma);
    strain(model, s, isotropic<double, 6>(-0.005));
    EXPECT_NEAR((mean(s.sigma) + p_e) / (p + p_e), std::exp(-0.015 / kappa), 1e-14);  // elastic: closed form itself
  }
}

TEST(ModifiedCamClay, UndrainedPathAndStrains) {
  const auto model = clay();
  for (double eta : {0.3, 0.7, 1.0, 1.15}) {
    auto s = start(model, 1);
    strain(model, s, triaxial(0, undrained_strain(0, eta)));
    EXPECT_NEAR(q_over_p(s), eta, 1e-6);
    EXPECT_NEAR(mean(s.sigma) / (100 * std::pow(M * M / (M * M + eta * eta), Lambda)), 1, 1e-6);
  }
}

// Overconsolidated: elastic at constant p up to η₀ = M √(OCR − 1), which is left at M on the wet side for OCR < 2 and
// comes down to it from the dry side for OCR > 2. Elastic and plastic strain in one increment.
TEST(ModifiedCamClay, UndrainedPathAcrossTheYieldPoint) {
  const auto model = clay();
  for (double OCR : {1.5, 4.0}) {
    const double eta0 = M * std::sqrt(OCR - 1), elastic = eta0 * kappa / (3 * r);
    for (double share : {0.3, 0.9, 0.999}) {
      const double eta = eta0 + share * (M - eta0);
      auto s = start(model, OCR);
      strain(model, s, triaxial(0, elastic + undrained_strain(eta0, eta)));
      EXPECT_NEAR(q_over_p(s), eta, 1e-6) << OCR;
      EXPECT_NEAR(mean(s.sigma) / (100 * std::pow((M * M + eta0 * eta0) / (M * M + eta * eta), Lambda)), 1, 1e-6);
    }
  }
}

TEST(ModifiedCamClay, UndrainedStrength) {
  const auto model = clay();
  const std::map<double, double> strength{{1, 34.46095}, {2, 60}, {4, 104.46607}};  // (M/2) p₀ (OCR/2)^Λ
  for (const auto& [OCR, s_u] : strength) {
    for (double sense : {1.0, -1.0}) {
      auto s = start(model, OCR);
      for (int i = 0; i < 10; ++i) strain(model, s, triaxial(0, sense * 0.06));
      EXPECT_NEAR(0.5 * deviatoric_stress(s.sigma), s_u, 1e-6 * s_u) << OCR;
      EXPECT_NEAR(0.5 * deviatoric_stress(s.sigma), M / 2 * 100 * std::pow(OCR / 2, Lambda), 1e-6 * s_u) << OCR;
    }
  }
}

// Drained, dq = 3 dp, normally consolidated: with dp/p = dη/(3 − η), ε_v = λ̄ ln(p/p₀) + (λ̄ − κ̄) ln(1 + η²/M²) and
// dε_q = dε_v^p 2η/(M² − η²) + (κ̄/r) dp/p, by Simpson's rule. The strain path is followed in chords; what the stress
// owes to them falls as their number squared, and is taken off by extrapolation.
TEST(ModifiedCamClay, DrainedPath) {
  const auto model = clay();
  const auto p_of = [](double eta) { return 100 * 3 / (3 - eta); };
  const auto slope = [](double eta) {
    const double plastic = (lambda - kappa) * (1 / (3 - eta) + 2 * eta / (M * M + eta * eta));
    return plastic * 2 * eta / (M * M - eta * eta) + kappa / r / (3 - eta);
  };
  const auto end = [&](int n) {
    auto s = start(model, 1);
    const double eta_end = 1.0, h = eta_end / n;
    const auto eps_v = [&](double eta) {
      return lambda * std::log(p_of(eta) / 100) + (lambda - kappa) * std::log(1 + eta * eta / (M * M));
    };
    for (int i = 0; i < n; ++i) {
      const double x = i * h;
      const double deps_q = h / 6 * (slope(x) + 4 * slope(x + 0.5 * h) + slope(x + h));
      strain(model, s, triaxial(eps_v(x + h) - eps_v(x), deps_q));
    }
    return s.sigma;
  };
  const auto coarse = end(500), fine = end(1000);
  const auto sigma = fine + (1.0 / 3) * (fine - coarse);
  EXPECT_NEAR(mean(sigma) / p_of(1.0), 1, 1e-6);
  EXPECT_NEAR(deviatoric_stress(sigma) / (3 * (p_of(1.0) - 100)), 1, 1e-6);
}

// ---- The subloading model's limit ----

// Same rate on the yield surface, where R = 1, from any state there and for any p_e.
TEST(ModifiedCamClay, HasTheRateOfTheSubloadingLimit) {
  std::mt19937 generator(1);
  for (double p_e : {0.0, 15.0}) {
    const auto model = clay({{"p_e", p_e}});
    const auto limit = subloading(cam_clay_constants(), {{"p_e", p_e}});
    int plastic = 0;
    for (int i = 0; i < 200; ++i) {
      const auto sigma = p100 + 80.0 * random_tensor<6>(generator);
      if (mean(sigma) < 10) continue;
      const auto s = start(model, 1, sigma);
      const auto none = Sym<double, 6>::zero();
      const auto deps = random_tensor<6>(generator, 1e-4);
      const auto one = model.rate(s, deps);
      const auto other = limit.rate(Subloading::State<double, 6>{sigma, none, none, none, s.p_c, 1.0}, deps);
      ASSERT_EQ(one.sound, other.sound);
      if (!one.sound) continue;
      EXPECT_LT(norm(one.change.sigma - other.change.sigma), 1e-10 * norm(one.change.sigma));
      EXPECT_LT(norm(one.change.epsp - other.change.epsp), 1e-10 * norm(deps));
      EXPECT_NEAR(one.change.p_c, other.change.p_c, 1e-8);
      plastic += norm(one.change.epsp) > 0;
    }
    EXPECT_GT(plastic, 50);
  }
}

// An independent program's curve, and scarp's own subloading model, on the same strains.
TEST(ModifiedCamClay, FollowsTheReferenceCurveOfTheLimit) {
  const auto reference = read_reference("01_mcc_undrained_tc");
  const auto model = clay();
  const auto limit = subloading(reference.constants);
  auto s = start(model, 1);
  auto t = reference.initial;
  for (std::size_t i = 1; i < reference.replay.size(); ++i) {
    const auto& point = reference.replay[i];
    const auto deps = point.eps - reference.replay[i - 1].eps;
    strain(model, s, deps);
    integrate<DormandPrince>(limit, t, deps, {1e-9, 1e-9});
    EXPECT_LT(norm(s.sigma - point.state.sigma), 1e-6 * norm(s.sigma)) << i;  // the files have 8 to 11 digits
    EXPECT_LT(norm(s.sigma - t.sigma), 1e-7 * norm(s.sigma)) << i;
    EXPECT_LT(norm(s.epsp - t.epsp), 1e-8) << i;
    EXPECT_NEAR(s.p_c / t.p_c, 1, 1e-7) << i;
  }
}

// ---- The end of strength ----

// Pulled apart, with shear: p_c falls to its floor. There the stress rests where the flow is along the strain,
// ε_v^p/ε_q^p = (M² − η²)/2η; without shear that is p = 0, the point parts from the body, and takes load again.
TEST(ModifiedCamClay, FloorSeparationAndLoadAgain) {
  const auto model = clay({{"p_e", 5}, {"p_c_floor", 0.01}});
  for (double shear : {0.0, 2e-4}) {
    auto s = start(model, 1.2);
    UpdateFlags<double> flags{};
    for (int i = 0; i < 3000; ++i) {
      flags = strain<ModifiedEuler>(model, s, triaxial(-3e-4, shear), 1e-4).flags;
      EXPECT_GE(s.p_c, 1.01325 * (1 - 1e-12));
      EXPECT_GE(mean(s.sigma), -1e-4 * s.p_c);  // the surface ends at 0; the tolerance
    }
    EXPECT_TRUE(flags.on_floor);
    EXPECT_EQ(s.p_c, 1.01325);
    EXPECT_EQ(flags.separated, shear == 0);
    const double eta = 1.5 + std::sqrt(1.5 * 1.5 + M * M);
    if (shear == 0) {
      EXPECT_EQ(norm(s.sigma), 0);
    } else {
      EXPECT_NEAR(q_over_p(s), eta, 1e-3 * eta);
    }
    for (int i = 0; i < 100; ++i) strain<ModifiedEuler>(model, s, isotropic<double, 6>(3e-4), 1e-4);
    EXPECT_GT(mean(s.sigma), 1);
    EXPECT_GT(s.p_c, 1.01325);
  }
}

TEST(ModifiedCamClay, InitialState) {
  const auto model = clay({{"p_c_floor", 0.01}});
  const Sym<double, 4> ground{{60, 100, 60, 14}};
  const auto problem = [&](const Values& keys, const Sym<double, 4>& sigma) {
    std::vector<Problem> problems;
    model.initial_state<4>(sigma, sigma[1], keys, problems);
    return problems.empty() ? std::string() : problems[0].key;
  };
  std::vector<Problem> problems;
  const auto one = model.initial_state<4>(ground, 100, {{"OCR", 1.0}}, problems);
  EXPECT_NEAR(model.yield(one.sigma, one.p_c), 0, 1e-12 * one.p_c * one.p_c);
  EXPECT_NEAR(model.derived(one)[0], 1, 1e-14);
  EXPECT_NEAR(model.initial_state<4>(ground, 100, {{"POP", 50.0}}, problems).p_c, 1.5 * one.p_c, 1e-12 * one.p_c);
  EXPECT_EQ(model.initial_state<4>(ground, 100, {{"p_c", 400.0}, {"OCR", 1.0}}, problems).p_c, 400);
  EXPECT_EQ(problem({}, ground), "OCR");
  EXPECT_EQ(problem({{"OCR", 0.9}}, ground), "OCR");
  EXPECT_EQ(problem({{"POP", -1.0}}, ground), "POP");
  EXPECT_EQ(problem({{"p_c", 80.0}}, ground), "p_c");
  EXPECT_EQ(problem({{"OCR", 2.0}}, Sym<double, 4>{{-10, -10, -10, 0}}), "p_e");
  EXPECT_FALSE(make_model("modified-cam-clay",
                          {{"kappa", 0.1}, {"lambda", 0.1}, {"nu", 0.2}, {"p_e", 0}, {"M", 1}, {"p_atm", 100}})
                   .model);
}

}  // namespace
}  // namespace scarp::test::cam_clay
