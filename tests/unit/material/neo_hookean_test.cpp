// The neo-Hookean law against closed forms from the deformation gradient (tension positive there, so signs turn).
#include "scarp/material/neo_hookean.hpp"

#include <gtest/gtest.h>
#include <cmath>

#include "material/samples.hpp"
#include "scarp/material/integrate/embedded.hpp"

namespace scarp::test {
namespace {

const NeoHookean rubber({100, 0.3});
const double lambda = 100 * 0.3 / (1.3 * 0.4), mu = 100 / 2.6;

template <int N>
NeoHookean::State<double, N> natural() {
  std::vector<Problem> problems;
  const auto s = rubber.initial_state<N>(Sym<double, N>::zero(), 0, {}, problems);
  EXPECT_TRUE(problems.empty());
  return s;
}

/// [λ ln J I + μ (F Fᵀ − I)]/J of plain matrices, turned to compression positive.
Matrix stress_of(const Matrix& F) {
  const double J = determinant(F);
  Matrix sigma = F * transposed(F);
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j)
      sigma[i][j] = -(mu * (sigma[i][j] - (i == j)) + lambda * std::log(J) * (i == j)) / J;
  return sigma;
}

template <int N>
void expect_stress(const NeoHookean::State<double, N>& s, const Matrix& F, double band) {
  EXPECT_LT(norm(s.sigma - from_matrix<N>(stress_of(F))), band * norm(s.sigma));
}

// Fixed principal directions: the natural strain determines F, in however many increments. Uniaxial (which is also the
// confined stretch of a one-dimensional manufactured solution), isotropic, and three different stretches.
TEST(NeoHookean, StretchesByTheirClosedForm) {
  for (const auto& stretch : {std::array{1.0, 0.4, 1.0}, std::array{1.0, 2.5, 1.0}, std::array{0.6, 0.6, 0.6},
                              std::array{1.5, 1.5, 1.5}, std::array{2.0, 0.5, 1.3}}) {
    const Matrix F{{{stretch[0], 0, 0}, {0, stretch[1], 0}, {0, 0, stretch[2]}}};
    for (int pieces : {1, 7}) {
      auto s = natural<6>();
      Sym<double, 6> deps = Sym<double, 6>::zero();
      for (int i = 0; i < 3; ++i) deps[i] = -std::log(stretch[static_cast<std::size_t>(i)]) / pieces;
      for (int k = 0; k < pieces; ++k)
        EXPECT_EQ((integrate<ModifiedEuler>(rubber, s, deps, {1e-13, 1e-7}).end), IntegrationEnd::done);
      expect_stress(s, F, 1e-12);  // the tolerance, some substeps
      EXPECT_NEAR(rubber.derived(s)[0], stretch[0] * stretch[1] * stretch[2], 1e-12);
    }
  }
}

/// One increment of F → F_g F with F_g a simple shear of γ, by its polar decomposition V R: turned by R, strained by ln
/// V.
template <int N>
void shear(NeoHookean::State<double, N>& s, double gamma) {
  Spin<double, N> spin{};
  spin.w[0] = 2 * std::tan(0.5 * std::atan(0.5 * gamma));  // Cayley's angle of R, tan φ = −γ/2
  rotate(s, Rotation<double, N>(spin));
  const double stretch = std::asinh(0.5 * gamma), angle = 0.5 * std::atan2(2.0, gamma);
  Sym<double, N> deps = Sym<double, N>::zero();
  deps[0] = -stretch * std::cos(2 * angle);
  deps[1] = -deps[0];
  deps[3] = -sqrt2 * stretch * std::sin(2 * angle);
  EXPECT_EQ((integrate<ModifiedEuler>(rubber, s, deps, {1e-13, 1e-7}).end), IntegrationEnd::done);
}

TEST(NeoHookean, SimpleShearAtLargeStrain) {
  for (int pieces : {1, 10}) {
    auto s = natural<4>();
    auto t = natural<6>();
    for (int k = 0; k < pieces; ++k) {
      shear(s, 2.0 / pieces);
      shear(t, 2.0 / pieces);
    }
    expect_stress(s, {{{1, 2, 0}, {0, 1, 0}, {0, 0, 1}}}, 1e-12);
    expect_stress(t, {{{1, 2, 0}, {0, 1, 0}, {0, 0, 1}}}, 1e-12);
    EXPECT_NEAR(s.sigma[0], -mu * 4, 1e-11 * mu);          // σ_xx = μ γ² in tension
    EXPECT_NEAR(s.sigma[3], -mu * 2 * sqrt2, 1e-11 * mu);  // σ_xy = μ γ
  }
}

/// Error of the stress after simple shear to γ = 1 in n steps as a step of the point method makes them: turned by the
/// spin, then strained by the symmetric part of the velocity gradient.
double error_of_steps(int n) {
  auto s = natural<4>();
  for (int k = 0; k < n; ++k) {
    rotate(s, Rotation<double, 4>(Spin<double, 4>{{0.5 / n}}));
    s = attempt<ModifiedEuler>(rubber, s, Sym<double, 4>{{0, 0, 0, -0.5 / n * sqrt2}}, 1e-4).state;
  }
  return norm(s.sigma - from_matrix<4>(stress_of({{{1, 1, 0}, {0, 1, 0}, {0, 0, 1}}}))) / norm(s.sigma);
}

// Turning first and straining after splits the step to first order; the law adds nothing to that.
TEST(NeoHookean, StepsOfSimpleShearConverge) {
  EXPECT_LT(error_of_steps(1000), 1e-3);
  EXPECT_NEAR(std::log2(error_of_steps(100) / error_of_steps(200)), 1, 0.1);
}

// Straining there and back in another order of magnitude and direction leaves nothing: b has no drift.
TEST(NeoHookean, ComesBackToNoStress) {
  std::mt19937 generator(3);
  auto s = natural<6>();
  std::vector<Sym<double, 6>> path;
  for (int i = 0; i < 100; ++i) path.push_back(random_tensor<6>(generator, 0.05));
  for (const auto& deps : path) s = attempt<ModifiedEuler>(rubber, s, deps, 1e-4).state;
  EXPECT_GT(norm(s.sigma), 1);
  for (auto deps = path.rbegin(); deps != path.rend(); ++deps)
    s = attempt<ModifiedEuler>(rubber, s, -1.0 * *deps, 1e-4).state;
  EXPECT_LT(norm(s.sigma), 1e-11 * mu);  // rounding of 200 increments
}

// The work along any path is the energy W = ½ μ (tr b − 3) − μ ln J + ½ λ (ln J)², per natural volume: Simpson's rule
// for J σ : d over each increment, error of the fourth power of increments of 0.02.
TEST(NeoHookean, WorkIsStoredEnergy) {
  std::mt19937 generator(4);
  auto s = natural<6>();
  double work = 0;
  for (int i = 0; i < 50; ++i) {
    const auto deps = random_tensor<6>(generator, 0.02);
    const auto middle = attempt<ModifiedEuler>(rubber, s, 0.5 * deps, 1e-4).state;
    const auto end = attempt<ModifiedEuler>(rubber, s, deps, 1e-4).state;
    const auto power = [&](const auto& at) { return rubber.derived(at)[0] * dot(at.sigma, deps); };
    work += (power(s) + 4 * power(middle) + power(end)) / 6;
    s = end;
  }
  const double log_J = std::log(rubber.derived(s)[0]);
  const double W = 0.5 * mu * (trace(s.b) - 3) - mu * log_J + 0.5 * lambda * log_J * log_J;
  EXPECT_GT(W, 0.1);
  EXPECT_NEAR(work, W, 1e-6 * W);
}

// rate() is what update() integrates: a fifth-order step of the one is the other to the sixth power of the increment.
TEST(NeoHookean, RateAndUpdateAreTheSameLaw) {
  std::mt19937 generator(5);
  auto s = natural<6>();
  for (int i = 0; i < 20; ++i) {
    const auto step = as_increment(random_tensor<6>(generator, 0.05));
    const auto pair = attempt_pair<DormandPrince>(rubber, s, step, 1e-4).state;
    const auto rate = rubber.rate(s, step.deps).change;
    const double h = 1e-6;
    const auto ahead = attempt<ModifiedEuler>(rubber, s, h * step.deps, 1e-4).state;
    EXPECT_LT(norm((1 / h) * (ahead.sigma - s.sigma) - rate.sigma), 1e-6 * norm(rate.sigma) + 1e-7);
    s = attempt<ModifiedEuler>(rubber, s, step, 1e-4).state;
    EXPECT_LT(norm(pair.b - s.b), 1e-7 * norm(s.b));
    EXPECT_LT(norm(pair.sigma - s.sigma), 1e-6 * mu);
  }
}

TEST(NeoHookean, SmallStrainIsLinearElasticity) {
  auto s = natural<6>();
  LinearElastic::State<double, 6> linear{Sym<double, 6>::zero()};
  const Sym<double, 6> deps{{1e-7, -2e-7, 3e-7, 1e-7, -1e-7, 2e-7}};
  s = attempt<ModifiedEuler>(rubber, s, deps, 1e-4).state;
  linear = attempt<ModifiedEuler>(LinearElastic({100, 0.3}), linear, deps, 1e-4).state;
  EXPECT_LT(norm(s.sigma - linear.sigma), 1e-6 * norm(linear.sigma));  // of the order of the strain
}

template <int N>
void expect_round_trip() {
  std::mt19937 generator(6);
  for (int i = 0; i < 200; ++i) {
    auto s = natural<N>();
    // Compressed to as little as a fifth of the volume, or spread while it is still stable.
    const auto deps = random_tensor<N>(generator, 0.15) + isotropic<double, N>(0.5 * (i % 10) / 9.0);
    ASSERT_EQ((integrate<ModifiedEuler>(rubber, s, deps, {1e-12, 1e-7}).end), IntegrationEnd::done);
    std::vector<Problem> problems;
    const auto found = rubber.initial_state<N>(s.sigma, 0, {}, problems);
    ASSERT_TRUE(problems.empty());
    EXPECT_LT(norm(found.b - s.b), 1e-10 * norm(s.b));
    EXPECT_LT(norm(found.sigma - s.sigma), 1e-12 * norm(s.sigma) + 1e-13 * mu);
  }
}

TEST(NeoHookean, InitialStressGivesItsStretch) {
  expect_round_trip<4>();
  expect_round_trip<6>();
}

// Isotropic tension t(J) = [λ ln J + μ (J^⅔ − 1)]/J has a peak: stress up to it has a state, beyond it none.
TEST(NeoHookean, TensionBeyondThePeakIsRefused) {
  double peak = 0;
  for (double J = 1; J < 20; J += 1e-3)
    peak = std::max(peak, (lambda * std::log(J) + mu * (std::pow(J, 2.0 / 3) - 1)) / J);
  for (double share : {0.5, 0.999, 1.001, 3.0}) {
    std::vector<Problem> problems;
    const auto s = rubber.initial_state<6>(isotropic<double, 6>(-share * peak), 0, {}, problems);
    ASSERT_EQ(problems.empty(), share < 1) << share;
    EXPECT_NEAR(mean(s.sigma), -share * peak, 1e-9 * peak);
    if (share > 1) {
      EXPECT_EQ(problems[0].key, "stress");
    }
  }
}

// ρ c² of a stretched bar, from its referential wave speed c₀² = [λ (1 − ln J)/F² + μ (1 + 1/F²)]/ρ₀ (verification by
// manufactured solutions): c = F c₀ and ρ = ρ₀/F. Where F is compressed, waves across it are faster.
TEST(NeoHookean, WaveModulusOfAStretchedBar) {
  for (double F : {0.5, 1.0, 1.8}) {
    const auto s =
        attempt<ModifiedEuler>(rubber, natural<6>(), Sym<double, 6>{{0, -std::log(F), 0, 0, 0, 0}}, 1e-4).state;
    const double log_J = std::log(F), along = (lambda * (1 - log_J) + mu * (F * F + 1)) / F;
    const double across = (lambda * (1 - log_J) + 2 * mu) / F;
    EXPECT_NEAR(rubber.p_wave_modulus(s), std::max(along, across), 1e-9 * along);
  }
}

// No direction is stiffer than the modulus says: difference quotients of the stress along random directions.
TEST(NeoHookean, NoDirectionIsStiffer) {
  std::mt19937 generator(7);
  for (int i = 0; i < 50; ++i) {
    const auto s = attempt<ModifiedEuler>(rubber, natural<6>(), random_tensor<6>(generator, 0.3), 1e-4).state;
    double stiffest = 0;
    for (int k = 0; k < 300; ++k) {
      const auto v = random_tensor<6>(generator);
      const double size = std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
      const double x = v[0] / size, y = v[1] / size, z = v[2] / size;
      const Sym<double, 6> nn{{x * x, y * y, z * z, sqrt2 * x * y, sqrt2 * y * z, sqrt2 * z * x}};
      stiffest = std::max(stiffest, dot(nn, rubber.rate(s, nn).change.sigma));
    }
    EXPECT_LE(stiffest, rubber.p_wave_modulus(s) * (1 + 1e-9));
    EXPECT_GT(stiffest, rubber.p_wave_modulus(s) * 0.98);  // 300 directions come near it
  }
}

}  // namespace
}  // namespace scarp::test
