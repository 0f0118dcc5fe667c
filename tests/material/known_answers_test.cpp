// Closed forms and limits of the subloading model (docs/models/subloading.md), under strain control.
#include <gtest/gtest.h>
#include <cmath>

#include "samples.hpp"
#include "scarp/material/integrate/embedded.hpp"

namespace scarp::test {
namespace {

using State = Subloading::State<double, 6>;
constexpr double kappa = 0.02, lambda = 0.1, M = 1.2, Lambda = (lambda - kappa) / lambda, nu = 0.25;

State start(const Subloading& model, const Sym<double, 6>& sigma, const Values& keys) {
  std::vector<Problem> problems;
  const auto s = model.initial_state<6>(sigma, sigma[2], keys, problems);
  for (const auto& p : problems) ADD_FAILURE() << p.key << ": " << p.what << ' ' << p.value;
  return s;
}

void strain(const Subloading& model, State& s, const Sym<double, 6>& deps, double tolerance = 1e-9) {
  const auto report = integrate<DormandPrince>(model, s, deps, {tolerance, 1e-9});
  EXPECT_EQ(report.end, IntegrationEnd::done) << "reached " << report.reached;
}

/// Undrained triaxial strain, compression along z: volumetric part zero.
Sym<double, 6> undrained(double eps_q) {
  return {{-0.5 * eps_q, -0.5 * eps_q, eps_q, 0, 0, 0}};
}

const Sym<double, 6> p100 = isotropic<double, 6>(100.0);

TEST(CamClayLimit, IsotropicCompressionAndUnloading) {
  for (double p_e : {0.0, 20.0}) {
    const auto model = subloading(cam_clay_constants(), {{"p_e", p_e}});
    auto s = start(model, p100, {{"R_b", 1.0}, {"OCR", 1.0}});
    strain(model, s, isotropic<double, 6>(0.05));
    EXPECT_NEAR((mean(s.sigma) + p_e) / (100 + p_e), std::exp(0.15 / lambda), 1e-7);
    const double p = mean(s.sigma);
    strain(model, s, isotropic<double, 6>(-0.005));
    EXPECT_NEAR((mean(s.sigma) + p_e) / (p + p_e), std::exp(-0.015 / kappa), 1e-9);
  }
}

/// p and ε_q of undrained shear from η = 0 on the normal line.
double undrained_p(double eta) {
  return 100 * std::pow(M * M / (M * M + eta * eta), Lambda);
}
double undrained_strain(double eta) {
  const double r = 3 * (1 - 2 * nu) / (2 * (1 + nu)), arc = std::atan(eta / M);
  return kappa * Lambda / M * (std::log((M + eta) / (M - eta)) - 2 * arc) +
         kappa / (3 * r) * ((1 - 2 * Lambda) * eta + 2 * Lambda * M * arc);
}

TEST(CamClayLimit, UndrainedPathAndStrains) {
  const auto model = subloading(cam_clay_constants());
  for (double eta : {0.3, 0.7, 1.0, 1.15}) {
    auto s = start(model, p100, {{"R_b", 1.0}, {"OCR", 1.0}});
    strain(model, s, undrained(undrained_strain(eta)));
    const double found = deviatoric_stress(s.sigma) / mean(s.sigma);
    EXPECT_NEAR(found, eta, 1e-6);
    EXPECT_NEAR(mean(s.sigma), undrained_p(eta), 1e-5);
  }
}

// Undrained strength (M/2) p₀ (OCR/2)^Λ. Inside the yield surface R tends to 1 at a finite c_R; what is left of that in
// the strength falls as 1/c_R.
TEST(CamClayLimit, UndrainedStrength) {
  const auto model = subloading(cam_clay_constants(), {{"c_R", 2e4}});
  const std::map<double, double> strength{{1, 34.46095}, {2, 60}, {4, 104.46607}};
  for (const auto& [OCR, s_u] : strength) {
    auto s = start(model, p100, {{"R_b", 1.0}, {"OCR", OCR}});
    for (int i = 0; i < 10; ++i) strain(model, s, undrained(0.06), 1e-7);
    EXPECT_NEAR(0.5 * deviatoric_stress(s.sigma), s_u, 1e-3 * s_u) << OCR;
  }
}

// Critical state from any start (ξ = 0): q/p → M_c in compression and k M_c in extension, at constant p, q, p_c.
TEST(CriticalState, IsReachedFromAnyStart) {
  const auto model = subloading(full_constants(), {{"xi", 0}, {"p_e", 1}, {"c_beta", 20}});
  const Sym<double, 6> k0{{60, 60, 100, 0, 0, 0}}, sheared{{90, 100, 110, 10, -5, 8}};
  const std::vector<State> starts = {start(model, p100, {{"R_b", 1.0}, {"OCR", 1.0}}),
                                     start(model, p100, {{"R_b", 3.0}, {"OCR", 4.0}, {"a", 0.5}}),
                                     start(model, k0, {{"R_b", 2.0}, {"OCR", 1.3}, {"a", 0.5}, {"beta", "K0"}}),
                                     start(model, sheared, {{"R_b", 1.5}, {"OCR", 1.5}, {"a", 0.3}, {"beta", "K0"}})};
  for (const auto& from : starts) {
    for (double sense : {1.0, -1.0}) {
      auto s = from;
      for (int i = 0; i < 40; ++i) strain(model, s, undrained(0.1 * sense), 1e-7);
      const double ratio = sense > 0 ? 1.2 : 1.2 * 5 / 7;
      EXPECT_NEAR(deviatoric_stress(s.sigma) / mean(s.sigma), ratio, 1e-4);
      const auto before = s;
      strain(model, s, undrained(0.1 * sense), 1e-7);
      EXPECT_NEAR(s.p_c / before.p_c, 1, 1e-4);
    }
  }
}

// Isotropic plastic strain: R_b = R_bf + (R_b0 − R_bf) exp(−c_b ε_v^p/√3), and p_c follows by eqs 33–36.
TEST(Structure, DebondsWithPlasticStrain) {
  for (double R_bf : {1.0, 1.5}) {
    const auto model = subloading(cam_clay_constants(), {{"c_b", 15}, {"R_bf", R_bf}, {"c_R", 50}});
    auto s = start(model, p100, {{"R_b", 4.0}, {"OCR", 2.0}});
    const double p_c0 = s.p_c;
    for (int i = 0; i < 20; ++i) {
      strain(model, s, isotropic<double, 6>(0.02));
      const double plastic = trace(s.epsp), R_b = R_bf + (4 - R_bf) * std::exp(-15 * plastic / std::sqrt(3.0));
      EXPECT_NEAR(s.R_b, R_b, 1e-7);
      EXPECT_NEAR(s.p_c / p_c0, std::exp(plastic / (lambda - kappa)) * R_b / 4, 1e-6 * s.p_c / p_c0);
    }
    EXPECT_NEAR(s.R_b, R_bf, 1e-3);
  }
}

// An isotropic, centred state yields at p = (1 − ξ) p_c; with c_R large it is elastic until there.
TEST(Yield, OfIsotropicCompression) {
  const double xi = 0.1, p_c = 200, p_e = 5, p_y = (1 - xi) * p_c;
  const auto model = subloading(cam_clay_constants(), {{"xi", xi}, {"p_e", p_e}, {"c_R", 1e6}});
  const auto to_yield = kappa * std::log((p_y + p_e) / (40 + p_e));
  auto s = start(model, isotropic<double, 6>(40.0), {{"R_b", 1.0}, {"p_c", p_c}});
  strain(model, s, isotropic<double, 6>(to_yield / 3), 1e-7);
  EXPECT_NEAR(mean(s.sigma), p_y, 1e-3 * p_y);
  EXPECT_NEAR(model.homothety(s).R, 1, 1e-3);
  EXPECT_LT(trace(s.epsp), 1e-2 * to_yield);
  strain(model, s, isotropic<double, 6>(0.01), 1e-7);  // and on along the normal line
  EXPECT_NEAR((mean(s.sigma) + p_e) / (p_y + p_e), std::exp(0.03 / lambda), 2e-3);
}

// ---- Section 3.5: the simpler forms of the model ----

TEST(Reduction, LargeCRIsElasticInside) {
  const auto soft = subloading(full_constants(), {{"c_R", 20}, {"c_a", 0}});
  const auto hard = subloading(full_constants(), {{"c_R", 1e6}, {"c_a", 0}});
  const Values keys{{"R_b", 1.0}, {"OCR", 3.0}};
  auto s = start(soft, p100, keys), t = start(hard, p100, keys);
  strain(soft, s, undrained(1e-3), 1e-6);
  strain(hard, t, undrained(1e-3), 1e-6);
  EXPECT_GT(norm(s.epsp), 1e-5);
  EXPECT_LT(norm(t.epsp), 1e-3 * norm(s.epsp));
  EXPECT_NEAR(mean(t.sigma), 100, 1e-2);  // undrained and elastic: p stays
}

TEST(Reduction, FixedCentreAtTheOrigin) {
  const auto model = subloading(full_constants(), {{"c_a", 0}});
  auto s = start(model, p100, {{"R_b", 2.0}, {"OCR", 1.5}});
  strain(model, s, undrained(0.02));
  EXPECT_GT(norm(s.epsp), 1e-3);
  EXPECT_EQ(norm(s.a), 0);
}

TEST(Reduction, AlphaOfOneIsAssociated) {
  std::mt19937 generator(21);
  for (double alpha : {1.0, 0.8}) {
    const auto model = subloading(full_constants(), {{"alpha", alpha}});
    double least = 1;
    for (int i = 0; i < 50; ++i) {
      const auto s = random_state<6>(generator, model);
      const auto h = model.homothety(s);
      // ∂f/∂σ at σ_y by central differences of f, quadratic in σ and so exact; p_c_through is not used here.
      const auto y = s.a + (1 / h.R) * (s.sigma - s.a);
      auto f = [&](const Sym<double, 6>& sigma) {
        const double p = mean(sigma), p_bar = p + 0.003 * s.p_c,
                     q_bar = deviatoric_stress(deviator(sigma) - p * s.beta);
        return q_bar * q_bar / (0.82 * 0.82) + p_bar * (p_bar - s.p_c);
      };
      Sym<double, 6> N;
      for (int c = 0; c < 6; ++c) {
        auto e = Sym<double, 6>::zero();
        e[c] = 1;
        N[c] = 0.5 * (f(y + e) - f(y - e));
      }
      const auto rate = model.rate(s, 1e-5 * N);
      if (!rate.sound || h.R < 0.02) continue;
      least = std::min(least, dot(rate.change.epsp, N) / (norm(rate.change.epsp) * norm(N)));
    }
    EXPECT_EQ(least > 1 - 1e-9, alpha == 1.0) << least;
  }
}

TEST(Reduction, WithoutStructureRbStaysOne) {
  const auto model = subloading(full_constants(), {{"c_b", 0}, {"R_bf", 1}});
  auto s = start(model, p100, {{"R_b", 1.0}, {"OCR", 1.5}, {"a", 0.5}});
  strain(model, s, undrained(0.05));
  EXPECT_EQ(s.R_b, 1);
  // eq. 35 alone, with p_e/(1 − ξ): ln of (p_c + p_e/(1−ξ)) moves by ε_v^p/(λ̄−κ̄)
  const double shift = 3 / (1 - 0.003), p_c0 = start(model, p100, {{"R_b", 1.0}, {"OCR", 1.5}, {"a", 0.5}}).p_c;
  EXPECT_NEAR(std::log((s.p_c + shift) / (p_c0 + shift)), trace(s.epsp) / (0.1 - 0.015), 1e-8);
}

// β = 0, c_β = 0, M = M_c: isotropic. Turning the strain path turns the stress, although no state was turned.
TEST(Reduction, WithoutBetaTheSoilIsIsotropic) {
  const auto isotropic_soil = subloading(full_constants(), {{"c_beta", 0}, {"M", 1.2}, {"k", 1}});
  const auto anisotropic_soil = subloading(full_constants());
  const Rotation<double, 6> q(Spin<double, 6>{{0.9, -0.4, 0.2}});
  for (const auto* model : {&isotropic_soil, &anisotropic_soil}) {
    auto s = start(*model, p100, {{"R_b", 2.0}, {"OCR", 1.5}, {"a", 0.4}});
    if (model == &anisotropic_soil) s.beta = {{-0.1, -0.1, 0.2, 0, 0, 0}};
    auto t = s;
    strain(*model, s, undrained(0.03));
    strain(*model, t, q(undrained(0.03)));
    EXPECT_EQ(norm(q(s.sigma) - t.sigma) < 1e-5, model == &isotropic_soil);
  }
}

// All reductions at once, against Modified Cam Clay written down by itself: rates in p, q on the yield surface.
TEST(Reduction, AllTogetherAreModifiedCamClay) {
  const auto model = subloading(cam_clay_constants());
  for (double eta : {0.0, 0.4, 0.9, 1.3}) {
    const double p = 150, q = eta * p, r = 3 * (1 - 2 * nu) / (2 * (1 + nu));
    const Sym<double, 6> sigma{{p - q / 3, p - q / 3, p + 2 * q / 3, 0, 0, 0}};
    const auto s = start(model, sigma, {{"R_b", 1.0}, {"OCR", 1.0}});
    EXPECT_NEAR(s.p_c, p * (1 + eta * eta / (M * M)), 1e-10);
    const double de_v = 1e-4, de_q = 3e-4;
    const auto rate = model.rate(s, {{de_v / 3 - de_q / 2, de_v / 3 - de_q / 2, de_v / 3 + de_q, 0, 0, 0}});
    // f = q²/M² + p (p − p_c), dp_c = p_c dε_v^p/(λ−κ), K = p/κ, 3G = 3 r K
    const double K = p / kappa, G3 = 3 * r * K, f_p = 2 * p - s.p_c, f_q = 2 * q / (M * M);
    const double dL =
        (f_p * K * de_v + f_q * G3 * de_q) / (f_p * K * f_p + f_q * G3 * f_q + p * s.p_c * f_p / (lambda - kappa));
    EXPECT_NEAR(mean(rate.change.sigma), K * (de_v - dL * f_p), 1e-9);
    EXPECT_NEAR(rate.change.sigma[2] - rate.change.sigma[0], G3 * (de_q - dL * f_q), 1e-9);
    EXPECT_NEAR(rate.change.p_c, s.p_c * dL * f_p / (lambda - kappa), 1e-9);
  }
}

}  // namespace
}  // namespace scarp::test
