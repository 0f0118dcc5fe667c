// What the error estimate of the linear-elastic, plastic laws is worth, that their flow dissipates, and what becomes of
// increments that they cannot follow.
#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>

#include "plastic_laws.hpp"

namespace scarp::test::plastic {
namespace {

/// Random states at the peak strength, inside the surface or on it, and increments that turn; f(state, increment).
template <class Model, class F>
void random_steps(const Model& model, double size, bool on_surface, F&& f) {
  std::mt19937 generator(31);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (int i = 0; i < 200; ++i) {
    const auto way = random_tensor<6>(generator, 1);
    double inside = 0, outside = 1000;
    for (int k = 0; k < 60; ++k) {
      const double w = 0.5 * (inside + outside);
      (model.excess(model.resolve(isotropic<double, 6>(100) + w * way), 0.0, way).f > 0 ? outside : inside) = w;
    }
    auto s = start(model, 100);
    const double share = i % 2 ? 1.0 : uniform(generator);
    s.sigma = s.sigma + (on_surface ? inside : share * inside) * way;
    f(s, random_tensor<6>(generator, size));
  }
}

/// The answer's error against two thousand substeps is below the estimate; where onset or an edge falls badly within
/// the increment it may be some times that.
template <class Model>
void expect_honest_error(const Model& model) {
  int optimistic = 0, all = 0;
  random_steps(model, 1e-3, false, [&](const State6<Model>& s, const Sym<double, 6>& deps) {
    const auto trial = attempt<ModifiedEuler>(model, s, deps, 1e-4);
    ASSERT_TRUE(trial.flags.sound);
    State6<Model> slow = s;
    for (int k = 0; k < 2000; ++k) slow = attempt<ModifiedEuler>(model, slow, (1.0 / 2000) * deps, 1e-4).state;
    const double error = model.error_norm(slow, advanced(trial.state, -1.0, slow));
    ++all;
    optimistic += error > trial.error + 1e-8;
    EXPECT_LE(error, 3 * trial.error + 1e-7);  // 1e-7: of the substeps, once each as large as theirs
  });
  EXPECT_LT(optimistic, all / 20);
}

/// The estimate falls fourfold and the answer's error eightfold with half the increment, where flow goes on all along.
template <class Model>
void expect_order(const Model& model) {
  std::vector<double> estimates, errors;
  random_steps(model, 2e-4, true, [&](const State6<Model>& s, const Sym<double, 6>& deps) {
    const auto flows = [&](const State6<Model>& at) {
      return attempt<ModifiedEuler>(model, at, 0.01 * deps, 1e-4).state.kappa > at.kappa;
    };
    State6<Model> slow = s;
    for (int k = 0; k < 500; ++k) slow = attempt<ModifiedEuler>(model, slow, (1.0 / 500) * deps, 1e-4).state;
    State6<Model> middle = s;
    for (int k = 0; k < 250; ++k) middle = attempt<ModifiedEuler>(model, middle, (1.0 / 500) * deps, 1e-4).state;
    const auto whole = attempt<ModifiedEuler>(model, s, deps, 1e-4),
               half = attempt<ModifiedEuler>(model, s, 0.5 * deps, 1e-4);
    if (half.error < 1e-7 || !flows(s) || !flows(slow)) return;
    estimates.push_back(whole.error / half.error);
    errors.push_back(model.error_norm(slow, advanced(whole.state, -1.0, slow)) /
                     model.error_norm(middle, advanced(half.state, -1.0, middle)));
  });
  const auto median = [](std::vector<double>& x) {
    std::sort(x.begin(), x.end());
    return x[x.size() / 2];
  };
  ASSERT_GT(estimates.size(), 40u);
  EXPECT_NEAR(median(estimates), 4, 0.5);
  EXPECT_NEAR(median(errors), 8, 1.5);
}

TEST(PlasticLaws, ErrorEstimateIsHonest) {
  expect_honest_error(law<VonMises>(clay));
  expect_honest_error(law<VonMises>(clay, soft_clay));
  expect_honest_error(law<Tresca>(clay, soft_clay));
  expect_honest_error(law<MohrCoulomb>(sand));
  expect_honest_error(law<MohrCoulomb>(sand, soft_sand));
  expect_honest_error(law<DruckerPrager>(sand, soft_sand));
}

TEST(PlasticLaws, OrderOfTheEstimateAndTheAnswer) {
  expect_order(law<VonMises>(clay));
  expect_order(law<VonMises>(clay, soft_clay));
  expect_order(law<Tresca>(clay, soft_clay));
  expect_order(law<MohrCoulomb>(sand));
  expect_order(law<MohrCoulomb>(sand, soft_sand));
  expect_order(law<DruckerPrager>(sand, soft_sand));
}

// Principal axes that stand still and perfect plasticity: one step is exact through plane, edge and all, and says so.
TEST(PlasticLaws, NoErrorWhereTheReturnIsExact) {
  for (const Sym<double, 6>& deps :
       {Sym<double, 6>{{-2e-3, 5e-3, -2e-3, 0, 0, 0}}, Sym<double, 6>{{1e-3, 5e-3, -4e-3, 0, 0, 0}}}) {
    for (double tension : {1e30, 0.0}) {
      const auto model = law<MohrCoulomb>(sand, {{"tension", tension}});
      const auto once = attempt<ModifiedEuler>(model, start(model, 100), deps, 1e-4);
      EXPECT_EQ(once.error, 0);
      auto slow = start(model, 100);
      for (int k = 0; k < 1000; ++k) slow = attempt<ModifiedEuler>(model, slow, 1e-3 * deps, 1e-4).state;
      EXPECT_LT(norm(once.state.sigma - slow.sigma), 1e-9);
    }
  }
}

template <class Model>
void expect_dissipation(const Model& model) {
  random_steps(model, 3e-3, false, [&](const State6<Model>& s, const Sym<double, 6>& deps) {
    State6<Model> end = s;
    if (integrate<ModifiedEuler>(model, end, deps, {1e-5, 1e-7}).end != IntegrationEnd::done) return;
    const auto one = attempt<ModifiedEuler>(model, s, 1e-2 * deps, 1e-4);
    const auto flow = one.state.epsp - s.epsp;
    // The stress of the step's end, its error of second order times the flow
    EXPECT_GE(dot(one.state.sigma, flow), -(one.error * norm(s.sigma) + 1e-9) * norm(flow));
    // Strain splits into elastic and plastic, whatever the substeps.
    EXPECT_LT(
        norm(end.sigma - s.sigma + model.elasticity().stress(end.epsp - s.epsp) - model.elasticity().stress(deps)),
        1e-8);
    EXPECT_GE(end.kappa, s.kappa);
  });
}

TEST(PlasticLaws, PlasticFlowDissipates) {
  expect_dissipation(law<VonMises>(clay, soft_clay));
  expect_dissipation(law<Tresca>(clay, soft_clay));
  expect_dissipation(law<MohrCoulomb>(sand, soft_sand));
  expect_dissipation(law<MohrCoulomb>(sand, {{"tension", 1}, {"psi", 30}}));
  expect_dissipation(law<DruckerPrager>(sand, soft_sand));
}

// A state outside its surface is pulled back once, noted, and then left alone.
TEST(PlasticLaws, AcceptPullsBack) {
  const auto model = law<MohrCoulomb>(sand);
  auto s = start(model, 100);
  s.sigma[1] = 500;
  EXPECT_TRUE(model.accept(s, 1e-4).corrected);
  EXPECT_FALSE(model.accept(s, 1e-4).corrected);
}

// Friction that falls faster than the stress can, at a large mean stress: (dM/dκ) p is some 70 times 3G. It is
// reported, at the peak.
TEST(PlasticLaws, UnstableSofteningIsReported) {
  const auto expect_unstable = [](const auto& model) {
    auto s = start(model, 5000);
    const auto report = integrate<ModifiedEuler>(model, s, Sym<double, 6>{{-0.2, 0.4, -0.2, 0, 0, 0}}, {});
    EXPECT_EQ(report.end, IntegrationEnd::unstable);
    EXPECT_GT(report.reached, 0.1);
    EXPECT_LT(s.kappa, 1e-6);
  };
  const Constants brittle{{"phi_residual", 15}, {"epsp_residual", 0.002}};
  expect_unstable(law<MohrCoulomb>(sand, brittle));
  expect_unstable(law<DruckerPrager>(sand, brittle));
}

}  // namespace
}  // namespace scarp::test::plastic
