// Strength, dilation and softening of the linear-elastic, plastic laws against closed forms; and the constants and
// initial values that they refuse.
#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>

#include "plastic_laws.hpp"

namespace scarp::test::plastic {
namespace {

/// One increment of axial strain (along y) with the lateral stress held: the lateral strain by the secant method.
template <class Model>
void triaxial(const Model& model, State6<Model>& s, double axial) {
  const double held = s.sigma[0];
  const auto at = [&](double lateral, State6<Model>& out) {
    out = s;
    EXPECT_EQ(integrate<ModifiedEuler>(model, out, Sym<double, 6>{{lateral, axial, lateral, 0, 0, 0}}, sharp).end,
              IntegrationEnd::done);
    return out.sigma[0] - held;
  };
  State6<Model> out;
  double x0 = 0, x1 = -0.3 * axial, f0 = at(x0, out), f1 = at(x1, out);
  for (int i = 0; i < 60 && std::abs(f1) > 1e-11; ++i) {
    const double x2 = x1 - f1 * (x1 - x0) / (f1 - f0);
    x0 = x1;
    f0 = f1;
    x1 = x2;
    f1 = at(x1, out);
  }
  EXPECT_NEAR(f1, 0, 1e-9);
  s = out;
}

/// Axial stress at failure under a lateral stress of 100.
template <class Model>
State6<Model> failed(const Model& model, double sign) {
  auto s = start(model, 100);
  for (int i = 0; i < 20; ++i) triaxial(model, s, sign * 2e-3);
  return s;
}

// Stress at failure is known in closed form; the control of the lateral stress leaves 1e-9.
TEST(PlasticLaws, TriaxialStrength) {
  EXPECT_NEAR(failed(law<Tresca>(clay), 1).sigma[1], 100 + 2 * 20, 1e-7);
  EXPECT_NEAR(failed(law<Tresca>(clay), -1).sigma[1], 100 - 2 * 20, 1e-7);
  EXPECT_NEAR(failed(law<VonMises>(clay), 1).sigma[1], 100 + std::sqrt(3.0) * 20, 1e-7);
  EXPECT_NEAR(failed(law<VonMises>(clay), -1).sigma[1], 100 - std::sqrt(3.0) * 20, 1e-7);
  const double N = 3, root = std::sqrt(N);  // (1 + sin φ)/(1 − sin φ)
  EXPECT_NEAR(failed(law<MohrCoulomb>(sand), 1).sigma[1], 100 * N + 2 * 5 * root, 1e-6);
  EXPECT_NEAR(failed(law<MohrCoulomb>(sand), -1).sigma[1], (100 - 2 * 5 * root) / N, 1e-6);
  EXPECT_NEAR(failed(law<DruckerPrager>(sand), 1).sigma[1], 100 * N + 2 * 5 * root, 1e-6);
  // The cone in extension: 100 − σ = M (200 + σ)/3 + k with M = 1.2.
  const double M = 1.2, k = 6 * 5 * std::cos(30 * degree) / 2.5;
  EXPECT_NEAR(failed(law<DruckerPrager>(sand), -1).sigma[1], (100 - M * 200 / 3 - k) / (1 + M / 3), 1e-6);
}

// Plastic strain increments at failure: along the edge in compression ε_v' = −2 sin ψ/(1 − sin ψ) ε_1', in extension,
// where the axial strain is ε_3', ε_v' = 2 sin ψ/(1 + sin ψ) ε_3'. The cone: ε_v' = −M_ψ ε_q'.
TEST(PlasticLaws, Dilation) {
  const double v = std::sin(10 * degree);
  const auto rate = [](const auto& model, double sign) {
    auto s = failed(model, sign);
    const auto before = s.epsp;
    triaxial(model, s, sign * 2e-3);
    return s.epsp - before;
  };
  const auto compression = rate(law<MohrCoulomb>(sand), 1), extension = rate(law<MohrCoulomb>(sand), -1);
  EXPECT_NEAR(trace(compression) / compression[1], -2 * v / (1 - v), 1e-7);
  EXPECT_NEAR(trace(extension) / extension[1], 2 * v / (1 + v), 1e-7);
  const auto cone = rate(law<DruckerPrager>(sand), 1);
  EXPECT_NEAR(trace(cone) / (2.0 / 3 * (cone[1] - cone[0])), -6 * v / (3 - v), 1e-7);
  const auto still = rate(law<MohrCoulomb>(sand, {{"psi", 0}}), 1);
  EXPECT_NEAR(trace(still), 0, 1e-12);
}

// Simple shear without volume change, 4 components: at failure (σ1 − σ3)/2 is c cos φ + (σ1 + σ3)/2 sin φ.
TEST(PlasticLaws, PlaneStrainStrength) {
  const auto sheared = [](const auto& model) {
    typename std::decay_t<decltype(model)>::template State<double, 4> s{};
    s.sigma = {{80, 120, 80, 0}};
    for (int i = 0; i < 50; ++i) integrate<ModifiedEuler>(model, s, Sym<double, 4>{{0, 0, 0, 2e-3}}, {1e-6, 1e-9});
    const double radius = std::hypot((s.sigma[0] - s.sigma[1]) / 2, s.sigma[3] / sqrt2);
    return std::pair(radius, (s.sigma[0] + s.sigma[1]) / 2);
  };
  const auto [t, p] = sheared(law<MohrCoulomb>(sand, {{"psi", 0}}));
  EXPECT_NEAR(t, 5 * std::cos(30 * degree) + p * 0.5, 1e-9);
  EXPECT_NEAR(sheared(law<Tresca>(clay)).first, 20, 1e-9);
  // Von Mises tends to σ_zz = (σ_xx + σ_yy)/2, where √J2 is the radius; exponentially over 50 · 2e-3 · G/s_u.
  EXPECT_NEAR(sheared(law<VonMises>(clay)).first, 20, 1e-6);
}

// Softening in simple shear from isotropic stress: τ = s_u − m κ, γ = τ/G + √3 κ, m = (s_u − s_u,r)/κ_r.
template <class Model>
void expect_simple_shear() {
  const auto model = law<Model>(clay, {{"s_u_residual", 8}, {"epsp_residual", 0.02}});
  const double G = model.elasticity().G, m = 12 / 0.02;
  auto s = start(model, 50);
  for (int i = 1; i <= 60; ++i) {
    const double gamma = 1e-3 * i;
    ASSERT_EQ(integrate<ModifiedEuler>(model, s, Sym<double, 6>{{0, 0, 0, 1e-3 / sqrt2, 0, 0}}, {1e-4, 1e-7}).end,
              IntegrationEnd::done);
    const double kappa = std::max(0.0, (gamma - 20 / G) / (std::sqrt(3.0) - m / G));
    const double tau = std::min({G * gamma, 20 - m * std::min(kappa, 0.02)});
    EXPECT_NEAR(s.sigma[3] / sqrt2, tau, 1e-9) << gamma;  // the flow does not turn: exact whatever the increment
    if (kappa <= 0.02) {
      EXPECT_NEAR(s.kappa, kappa, 1e-12);
    }
  }
  EXPECT_NEAR(s.sigma[3] / sqrt2, 8, 1e-9);
}

TEST(PlasticLaws, SofteningInSimpleShear) {
  expect_simple_shear<VonMises>();
  expect_simple_shear<Tresca>();
}

/// ∫ M_ψ dκ where ψ falls from 10° to 0 over κ = 0.04, by the midpoint rule.
double dilated(double kappa) {
  double sum = 0;
  for (int i = 0; i < 1000; ++i) {
    const double v = std::sin(10 * degree * std::max(0.0, 1 - (i + 0.5) * 1e-3 * kappa / 0.04));
    sum += 6 * v / (3 - v) * 1e-3 * kappa;
  }
  return sum;
}

// Friction and cohesion in triaxial compression: σ1 = N(φ) σ3 + 2 c √N(φ) with φ and c of κ, κ from the strains, and
// plastic volume −M_ψ dκ on the edge as on the cone.
template <class Model>
void expect_triaxial_softening() {
  const auto model = law<Model>(sand, {{"c_residual", 1}, {"phi_residual", 22}, {"epsp_residual", 0.04}});
  auto s = start(model, 100);
  for (int i = 0; i < 60; ++i) {
    triaxial(model, s, 2e-3);
    const double share = std::min(1.0, s.kappa / 0.04), sin_phi = std::sin((30 - 8 * share) * degree);
    const double N = (1 + sin_phi) / (1 - sin_phi);
    if (s.kappa > 0) {
      EXPECT_NEAR(s.sigma[1], N * 100 + 2 * (5 - 4 * share) * std::sqrt(N), 1e-6);
    }
    EXPECT_NEAR(trace(s.epsp), -dilated(s.kappa), 1e-6);            // a substep's tolerance of 1e-8, some ten times
    EXPECT_NEAR(s.kappa, 2.0 / 3 * (s.epsp[1] - s.epsp[0]), 1e-9);  // straight: κ is ε_q^p
  }
  EXPECT_GT(s.kappa, 0.06);
}

TEST(PlasticLaws, SofteningInTriaxialCompression) {
  expect_triaxial_softening<MohrCoulomb>();
  expect_triaxial_softening<DruckerPrager>();
}

// Sand that has lost its cohesion has exactly none: with a strength of −1e-15 the tip of the cone would lie in
// compression, and a point at no stress outside it.
TEST(PlasticLaws, SoftenedStrengthIsTheResidualOne) {
  std::mt19937 generator(12);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (int i = 0; i < 1000; ++i) {
    const double peak = 100 * uniform(generator), over = 0.1 * uniform(generator);
    const Softening lost{peak, 0, over}, some{peak, 0.3 * peak, over};
    EXPECT_EQ(lost(over), 0);
    EXPECT_EQ(lost(2 * over), 0);
    EXPECT_EQ(some(2 * over), 0.3 * peak);
    EXPECT_NEAR(some(0.0), peak, 1e-15 * peak);
    EXPECT_GE(lost(over * (1 - 1e-16 * static_cast<double>(i))), 0);
  }
  const auto law = std::get<DruckerPrager>(made("drucker-prager", {{"E", 54673.4},
                                                                   {"nu", 0.478},
                                                                   {"c", 49.5551},
                                                                   {"c_residual", 0},
                                                                   {"phi", 42},
                                                                   {"phi_residual", 28.5},
                                                                   {"psi", 3.5},
                                                                   {"epsp_residual", 0.0291745}}));
  auto s = start(law, 5e-15);
  s.kappa = 0.196;
  EXPECT_TRUE(law.accept(s, 1e-4).sound);
  EXPECT_LT(norm(s.sigma), 1e-14);  // and a number
}

// Pulled apart, a cohesionless point has no stress, is counted as separated, and takes load again once closed.
TEST(PlasticLaws, SeparationAndCutoff) {
  const auto dry = law<MohrCoulomb>(sand, {{"c", 0}});
  auto s = start(dry, 1);
  const auto apart = attempt<ModifiedEuler>(dry, s, isotropic<double, 6>(-1e-3), 1e-4);
  EXPECT_TRUE(apart.flags.separated && apart.flags.sound);
  EXPECT_NEAR(norm(apart.state.sigma), 0, 1e-12);
  const auto back = attempt<ModifiedEuler>(dry, apart.state, isotropic<double, 6>(1e-3), 1e-4);
  EXPECT_FALSE(back.flags.separated);
  EXPECT_NEAR(mean(back.state.sigma), 1, 1e-11);  // as far as before: what opened has closed
  const auto cut = law<MohrCoulomb>(sand, {{"tension", 2}});
  auto pulled = start(cut, 10);
  for (int i = 0; i < 20; ++i) {
    integrate<ModifiedEuler>(cut, pulled, Sym<double, 6>{{-1e-4, 0, 0, 0, 0, 0}}, sharp);
  }
  EXPECT_NEAR(pulled.sigma[0], -2, 1e-9);
  EXPECT_FALSE(attempt<ModifiedEuler>(cut, pulled, isotropic<double, 6>(-1e-2), 1e-4).flags.separated);
}

/// Key of the first problem, "" where there is none.
std::string refused(const std::string& name, Constants constants, const Constants& changes) {
  for (const auto& [key, value] : changes) constants[key] = value;
  const auto result = make_model(name, constants);
  return result.problems.empty() ? "" : result.problems[0].key;
}

TEST(PlasticLaws, ConstantsRefused) {
  EXPECT_EQ(refused("von-mises", clay, {{"s_u_residual", 25}, {"epsp_residual", 0.1}}), "s_u_residual");
  EXPECT_EQ(refused("tresca", clay, {{"s_u_residual", 10}}), "epsp_residual");
  EXPECT_EQ(refused("tresca", clay, {{"s_u_residual", 10}, {"epsp_residual", 1e-4}}), "epsp_residual");
  EXPECT_EQ(refused("mohr-coulomb", sand, {{"psi", 31}}), "psi");
  EXPECT_EQ(refused("mohr-coulomb", sand, {{"phi", 0}, {"c", 0}, {"psi", 0}}), "c");
  EXPECT_EQ(refused("drucker-prager", sand, {{"psi_residual", 31}, {"epsp_residual", 0.1}}), "psi_residual");
  EXPECT_EQ(refused("mohr-coulomb", sand, {{"tension", -1}}), "tension");
  EXPECT_EQ(refused("mohr-coulomb", sand, {}), "");
  const auto model = law<VonMises>(clay);
  EXPECT_EQ(model.parameters().s_u.residual, 20);  // that of s_u where it is left out
}

TEST(PlasticLaws, InitialStates) {
  std::vector<Problem> problems;
  const auto model = law<MohrCoulomb>(sand, {{"c", 0}, {"nu", 0.2}});
  EXPECT_NEAR(model.K0(), 1.0 / 3, 1e-12);  // active pressure: 0.2/0.8 is more than friction carries
  EXPECT_NEAR(law<MohrCoulomb>(sand, {{"nu", 0.4}}).K0(), 2.0 / 3, 1e-12);
  EXPECT_NEAR(law<DruckerPrager>(sand, {{"nu", 0.2}}).K0(), 1.0 / 3, 1e-12);
  model.initial_state<4>(Sym<double, 4>{{100 / 3.0, 100, 100 / 3.0, 0}}, 100, {}, problems);
  EXPECT_TRUE(problems.empty());
  model.initial_state<4>(Sym<double, 4>{{30, 100, 30, 0}}, 100, {}, problems);
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_EQ(problems[0].key, "K0");
  problems.clear();
  const auto old = law<VonMises>(clay, soft_clay);
  const auto s = old.initial_state<6>(isotropic<double, 6>(10), 10, {{"epsp_acc", 0.5}}, problems);
  EXPECT_TRUE(problems.empty());
  EXPECT_EQ(s.kappa, 0.5);
  old.initial_state<6>(isotropic<double, 6>(10), 10, {{"epsp_acc", -1.0}}, problems);
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_EQ(problems[0].key, "epsp_acc");
}

}  // namespace
}  // namespace scarp::test::plastic
