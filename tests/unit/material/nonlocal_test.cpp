// Laws whose softening over a length is given: with the growth of κ̂ that a law makes itself it is the law.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "scarp/material/integrate/embedded.hpp"
#include "scarp/material/models.hpp"
#include "scarp/material/nonlocal.hpp"

namespace scarp::test {
namespace {

constexpr IntegrationSettings sharp{1e-11, 1e-7};

std::map<std::string, double> bonded_constants() {
  return {{"kappa", .02}, {"lambda", .12}, {"nu", .3},   {"p_e", 5},  {"M", 1.0},
          {"M_c", 1.3},   {"k", .78},      {"alpha", 1}, {"xi", .01}, {"c_R", 60},
          {"c_beta", 5},  {"c_b", 20},     {"R_bf", 1},  {"c_a", 3},  {"p_atm", 101.325}};
}
Subloading bonded() {
  return std::get<Subloading>(*make_model("subloading", bonded_constants()).model);
}
ViscoplasticSubloading viscous() {
  auto constants = bonded_constants();
  constants.insert({{"mu", 1}, {"n", 2}, {"R_m", 1.6}});
  return std::get<ViscoplasticSubloading>(*make_model("viscoplastic-subloading", constants).model);
}

template <class Law>
auto start(const Law& law) {
  std::vector<Problem> problems;
  const auto s = law.template initial_state<4>(isotropic<double, 4>(50.0), 50.0,
                                               {{"R_b", 3.0}, {"p_c", 600.0}, {"a", 0.5}}, problems);
  EXPECT_TRUE(problems.empty());
  return s;
}

/// The state of a law, softened as far as it is.
template <class Law>
auto nonlocal_state(const typename Law::template State<double, 4>& s) {
  typename Nonlocal<Law>::template State<double, 4> r{};
  static_cast<typename Law::template State<double, 4>&>(r) = s;
  return r;
}

/// Plane strain with dilation, so that stress has a peak. (A constant horizontal stress would need a loop.)
const Sym<double, 4> biaxial{{-1.05, 1.0, 0.0, 0.0}};

struct Comparison {
  double peak = 0, error = 0;  ///< largest ‖dev σ‖, and largest difference of stress
};

/// Both laws to a strain of 15 % in equal steps, the second with the growth of κ of the first, `lag` steps late.
template <class Law>
Comparison compare(const Law& law, int steps, std::size_t lag, double time = 1) {
  const Nonlocal<Law> nonlocal(law);
  auto s = start(law);
  auto n = nonlocal_state<Law>(s);
  std::vector<double> growth(lag, 0.0);
  Comparison r;
  const double dt = time / steps;
  for (int i = 0; i < steps; ++i) {
    const Increment<double, 4> step{(0.15 / steps) * biaxial, dt};
    const auto before = s.epsp;
    EXPECT_EQ(integrate<ModifiedEuler>(law, s, step, sharp).end, IntegrationEnd::done);
    growth.push_back(norm(s.epsp - before));
    n.kappa_rate = growth[static_cast<std::size_t>(i)] / dt;
    EXPECT_EQ(integrate<ModifiedEuler>(nonlocal, n, step, sharp).end, IntegrationEnd::done);
    r.peak = std::max(r.peak, norm(deviator(s.sigma)));
    r.error = std::max(r.error, norm(n.sigma - s.sigma));
  }
  EXPECT_NEAR(n.kappa, n.kappa_hat, lag > 0 ? 1e-2 : 1e-6);
  EXPECT_LT(s.R_b, 1.3);  // the bonds are nearly gone
  EXPECT_GT(r.peak, 1.2 * norm(deviator(s.sigma)));
  return r;
}

TEST(NonlocalBonds, AreTheLocalLawsWithItsOwnGrowth) {
  const auto c = compare(bonded(), 4000, 0);
  // Over a step of 2e-5 the loss is spread evenly instead of as it comes: of second order in the step.
  EXPECT_LT(c.error, 1e-6 * c.peak);
  std::printf("given growth against the local law: %.1e of the peak\n", c.error / c.peak);
}
TEST(NonlocalBonds, OfTheViscousLawAreItsOwnWithItsOwnGrowth) {
  const auto c = compare(viscous(), 4000, 0, 10.0);
  EXPECT_LT(c.error, 1e-6 * c.peak);
  std::printf("viscous: %.1e of the peak\n", c.error / c.peak);
}

TEST(NonlocalBonds, GrowthOfTheStepBeforeIsAnErrorOfFirstOrder) {
  std::vector<double> errors;
  for (const int steps : {500, 2000, 8000}) {
    const auto c = compare(bonded(), steps, 1);
    errors.push_back(c.error / c.peak);
    std::printf("a step late, steps of %.1e: %.2e of the peak\n", 0.15 / steps, errors.back());
  }
  EXPECT_NEAR(errors[0] / errors[1], 4, 0.4);
  EXPECT_NEAR(errors[1] / errors[2], 4, 0.4);
  EXPECT_LT(errors[1], 1.5e-3);  // at steps of 7.5e-5
}

/// A state on its way, where bonds are left.
Nonlocal<Subloading>::State<double, 4> halfway(const Subloading& law) {
  auto s = start(law);
  integrate<ModifiedEuler>(law, s, 0.03 * biaxial, sharp);
  EXPECT_GT(s.R_b, 1.2);
  return nonlocal_state<Subloading>(s);
}

TEST(NonlocalBonds, LossKeepsRToItsHardeningLaw) {
  // Oracle: R of the state itself, which knows no consistency condition; eq. 31 says dR = U ‖dε^p‖, whatever the bonds
  // lose from outside.
  const auto law = bonded();
  const Nonlocal<Subloading> nonlocal(law);
  const auto s = halfway(law);
  for (const double dkappa_hat : {0.0, 1e-6, 1e-5}) {
    for (const double strain : {0.0, 1e-6}) {
      auto n = s;
      n.kappa_rate = dkappa_hat;
      const auto change = nonlocal.rate(n, strain * biaxial, 1.0).change;
      const double dR = law.homothety(advanced(n, 1.0, change)).R - law.homothety(n).R;
      const double U = law.R_per_strain(law.homothety(n).R);
      EXPECT_NEAR(dR, U * change.kappa, 1e-3 * U * change.kappa + 1e-9) << dkappa_hat << ", " << strain;
      EXPECT_GE(change.kappa, dkappa_hat > 0 || strain > 0 ? 1e-12 : 0.0) << "it flows without strain";
      EXPECT_DOUBLE_EQ(change.R_b, 20 * (1 - s.R_b) * dkappa_hat);
    }
  }
}

TEST(NonlocalBonds, AtTheFloorOfPcOnlyTheBondsFall) {
  const auto law = bonded();
  auto s = start(law);
  s.p_c = 0.01 * 101.325;
  s.sigma = isotropic<double, 4>(0.4);
  s.a = isotropic<double, 4>(0.2);
  auto n = nonlocal_state<Subloading>(s);
  n.kappa_rate = 1e-3;
  const auto change = Nonlocal<Subloading>(law).rate(n, Sym<double, 4>::zero(), 1.0).change;
  EXPECT_LT(change.R_b, 0);
  EXPECT_EQ(change.p_c, 0);
  EXPECT_EQ(norm(change.a), 0);
  EXPECT_EQ(change.kappa, 0);
}

TEST(NonlocalBonds, BelowRMinSoilSoftensWithoutFlow) {
  const auto law = bonded();
  auto s = start(law);
  s.sigma = s.a;
  ASSERT_LT(law.homothety(s).R, 0.01);
  auto n = nonlocal_state<Subloading>(s);
  n.kappa_rate = 1e-3;
  const auto change = Nonlocal<Subloading>(law).rate(n, 1e-4 * biaxial, 1.0).change;
  EXPECT_EQ(change.kappa, 0);
  EXPECT_DOUBLE_EQ(change.p_c / s.p_c, change.R_b / s.R_b);
}

/// Shear of a softening law in steps, against the law with strength at κ̂ of the local one.
template <class Law>
void expect_same_as_local(const Law& law) {
  ASSERT_TRUE(law.softens());
  const Nonlocal<Law> nonlocal(law);
  typename Law::template State<double, 4> s{};
  s.sigma = isotropic<double, 4>(50.0);
  auto n = nonlocal_state<Law>(s);
  double peak = 0;
  for (int i = 0; i < 400; ++i) {
    const Increment<double, 4> step{1e-3 * Sym<double, 4>{{-0.5, 0.5, 0.0, 0.3}}, 2.0};
    const double before = s.kappa;
    ASSERT_EQ(integrate<ModifiedEuler>(law, s, step, sharp).end, IntegrationEnd::done);
    n.kappa_rate = (s.kappa - before) / 2.0;
    ASSERT_EQ(integrate<ModifiedEuler>(nonlocal, n, step, sharp).end, IntegrationEnd::done);
    peak = std::max(peak, norm(deviator(s.sigma)));
    ASSERT_LT(norm(n.sigma - s.sigma), 2e-3 * peak) << i;
  }
  EXPECT_LT(norm(deviator(s.sigma)), 0.9 * peak) << "it has softened";
  EXPECT_LT(norm(n.sigma - s.sigma), 1e-6 * peak) << "strength is the residual one";
  EXPECT_NEAR(n.kappa, s.kappa, 1e-2 * s.kappa);
}

TEST(NonlocalStrength, IsTheLocalLawsWithItsOwnGrowth) {
  expect_same_as_local(std::get<VonMises>(
      *make_model("von-mises", {{"E", 1e4}, {"nu", .3}, {"s_u", 30}, {"s_u_residual", 10}, {"epsp_residual", .2}})
           .model));
  expect_same_as_local(std::get<Tresca>(
      *make_model("tresca", {{"E", 1e4}, {"nu", .3}, {"s_u", 30}, {"s_u_residual", 10}, {"epsp_residual", .2}}).model));
  const std::map<std::string, double> sand{{"E", 1e4},           {"nu", .3},           {"c", 15},
                                           {"phi", 25},          {"psi", 0},           {"c_residual", 2},
                                           {"phi_residual", 20}, {"epsp_residual", .2}};
  expect_same_as_local(std::get<MohrCoulomb>(*make_model("mohr-coulomb", sand).model));
  expect_same_as_local(std::get<DruckerPrager>(*make_model("drucker-prager", sand).model));
}

TEST(NonlocalStrength, IsHeldWhereKappaHatStands) {
  const auto law = std::get<VonMises>(
      *make_model("von-mises", {{"E", 1e4}, {"nu", .3}, {"s_u", 30}, {"s_u_residual", 10}, {"epsp_residual", .2}})
           .model);
  const Nonlocal<VonMises> nonlocal(law);
  Nonlocal<VonMises>::State<double, 4> n{};
  n.kappa_hat = 0.1;
  integrate<ModifiedEuler>(nonlocal, n, Increment<double, 4>{0.1 * Sym<double, 4>{{-0.5, 0.5, 0.0, 0.0}}, 1.0}, sharp);
  // s_u = 20 halfway; ‖dev σ‖ = √2 s_u in plane shear.
  EXPECT_NEAR(norm(deviator(n.sigma)), std::sqrt(2.0) * 20, 1e-9);
  EXPECT_GT(n.kappa, 0.05);
  EXPECT_EQ(n.kappa_hat, 0.1);
}

TEST(NonlocalLaw, KnowsWhatItAveragesAndHowFar) {
  EXPECT_DOUBLE_EQ(kappa_c_of(*make_model("subloading", bonded_constants()).model), 0.15);
  auto without = bonded_constants();
  without["c_b"] = 0;
  EXPECT_EQ(kappa_c_of(*make_model("subloading", without).model), 0);
  EXPECT_EQ(kappa_c_of(*make_model("linear-elastic", {{"E", 1}, {"nu", 0}}).model), 0);
  EXPECT_EQ(kappa_c_of(*make_model("von-mises", {{"E", 1e4}, {"nu", .3}, {"s_u", 30}}).model), 0);
  EXPECT_EQ(kappa_c_of(*make_model("tresca",
                                   {{"E", 1e4}, {"nu", .3}, {"s_u", 30}, {"s_u_residual", 10}, {"epsp_residual", .2}})
                            .model),
            0.2);
}

}  // namespace
}  // namespace scarp::test
