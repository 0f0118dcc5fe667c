// The opening of points that have parted from the body: what opens closes before the point carries load again, so that
// no cycle of straining leaves volume behind. The oracles are sums over strain that know nothing of increments:
//   tr ε = p/K + tr ε^p,                the elastic and the plastic volume, and
//   tr ε^p = −gap − M_ψ κ               on Drucker and Prager's cone: of the plastic volume, what is not dilation.
#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>

#include "material/lanes.hpp"
#include "plastic_laws.hpp"

namespace scarp::test::plastic {
namespace {

const Constants dry{{"E", 1e4}, {"nu", 0.3}, {"c", 0}, {"phi", 30}, {"psi", 0}};
const Constants dilatant{{"E", 1e4}, {"nu", 0.2}, {"c", 0}, {"phi", 35}, {"psi", 8}};

/// Open by 1 % each way and closed again: the case of a cohesionless soil at 10 kPa.
template <class Model>
void expect_closed_as_before(const Model& model, int increments) {
  auto s = start(model, 10);
  const double elastic = 10 / model.elasticity().K;
  for (const double sign : {-1.0, 1.0}) {
    for (int i = 0; i < increments; ++i) {
      const auto report = integrate<ModifiedEuler>(model, s, isotropic<double, 6>(sign * 0.01 / increments), sharp);
      ASSERT_EQ(report.end, IntegrationEnd::done);
      EXPECT_EQ(report.flags.separated, s.gap > 0);
    }
    EXPECT_NEAR(s.gap, sign < 0 ? 0.03 - elastic : 0, 1e-15);
    EXPECT_EQ(s.gap > 0 ? norm(s.sigma) : 0, 0);
  }
  EXPECT_LT(norm(s.sigma - isotropic<double, 6>(10)), 1e-10);  // 1e-15 of strain times E
}

TEST(Gap, WhatOpensClosesBeforeThePointCarriesLoad) {
  for (const int increments : {1, 3, 100}) {
    expect_closed_as_before(law<MohrCoulomb>(dry), increments);
    expect_closed_as_before(law<DruckerPrager>(dry), increments);
    expect_closed_as_before(law<MohrCoulomb>(dilatant), increments);
    expect_closed_as_before(law<DruckerPrager>(dilatant), increments);
    expect_closed_as_before(law<MohrCoulomb>(sand, {{"tension", 0}}), increments);  // cohesion, but no tension
  }
}

/// A walk through opening, shear and closing; f(state, total strain) after each increment.
template <class Model, class F>
int walk(const Model& model, F&& f) {
  std::mt19937 generator(41);
  int open = 0;
  for (int k = 0; k < 20; ++k) {
    auto s = start(model, 5);
    auto eps = Sym<double, 6>::zero();
    for (int i = 0; i < 50; ++i) {
      const auto deps = random_tensor<6>(generator, 3e-3) - 0.2 * eps;  // it comes back
      EXPECT_EQ(integrate<ModifiedEuler>(model, s, deps, sharp).end, IntegrationEnd::done);
      eps = eps + deps;
      EXPECT_GE(s.gap, 0);
      EXPECT_EQ(s.gap > 0 ? norm(s.sigma) : 0, 0);
      open += s.gap > 0;
      f(s, eps);
    }
  }
  return open;
}

// Without dilation the volume of soil that carries load is elastic, wherever it has been.
TEST(Gap, SandThatDoesNotDilateDoesNotSwell) {
  const auto expect = [](const auto& model) {
    const double K = model.elasticity().K;
    const int open = walk(model, [&](const auto& s, const auto& eps) {
      EXPECT_NEAR(trace(eps), (mean(s.sigma) - 5) / K - s.gap, 1e-12);
    });
    EXPECT_TRUE(open > 200 && open < 800) << open;
  };
  expect(law<MohrCoulomb>(dry));
  expect(law<DruckerPrager>(dry));
}

// With dilation, shear of an open point uses up its gap.
TEST(Gap, PlasticVolumeIsDilationAndGap) {
  const auto cone = law<DruckerPrager>(dilatant);
  const double v = std::sin(8 * degree), M_psi = 6 * v / (3 - v);
  const int open = walk(cone, [&](const auto& s, const auto& eps) {
    EXPECT_NEAR(trace(s.epsp), -s.gap - M_psi * s.kappa, 1e-7);  // some of 1e-8 a substep
    EXPECT_NEAR(trace(eps), (mean(s.sigma) - 5) / cone.elasticity().K + trace(s.epsp), 1e-10);
  });
  EXPECT_GT(open, 30);
}

/// One attempt is as good as it says: against five hundred from the same open state.
template <class Model>
void expect_honest(const Model& model) {
  std::mt19937 generator(42);
  int exact = 0, closed = 0;
  for (int i = 0; i < 200; ++i) {
    auto s = start(model, 0);
    s.kappa = 0.002 * (i % 10);
    s.gap = i % 5 ? 1e-3 * (i % 7 + 1) : 1e-15;
    const auto deps = random_tensor<6>(generator, 2e-3) + isotropic<double, 6>(i % 3 ? 1e-3 : -1e-3);
    const auto once = attempt<ModifiedEuler>(model, s, deps, 1e-4);
    ASSERT_TRUE(once.flags.sound);
    EXPECT_EQ(once.flags.separated, once.state.gap > 0);
    auto slow = s;
    for (int k = 0; k < 500; ++k) slow = attempt<ModifiedEuler>(model, slow, (1.0 / 500) * deps, 1e-4).state;
    const double error = model.error_norm(slow, advanced(once.state, -1.0, slow));
    EXPECT_LE(error, 3 * once.error + 1e-7) << i;
    exact += once.error < 1e-12;
    closed += once.state.gap == 0;
  }
  EXPECT_TRUE(model.softens() || exact > 50) << exact;
  EXPECT_TRUE(closed > 20 && closed < 180) << closed;
}

TEST(Gap, ErrorEstimateIsHonest) {
  expect_honest(law<MohrCoulomb>(dry));
  expect_honest(law<MohrCoulomb>(dilatant));
  expect_honest(law<DruckerPrager>(dilatant));
  const Constants softening{{"phi_residual", 28}, {"epsp_residual", 0.02}};
  expect_honest(law<MohrCoulomb>(dilatant, softening));
  expect_honest(law<DruckerPrager>(dilatant, softening));
}

/// Does the flow cone of the planes around Mohr and Coulomb's apex hold this plastic strain? Its sides by the 6 flow
/// directions: e · n ≤ 0 for all n that no direction leads out of; by a search over the sphere.
bool in_cone(const std::array<double, 3>& e, double sin_psi) {
  double size = 0;
  for (const double x : e) size += std::abs(x);
  return -(e[0] + e[1] + e[2]) >= sin_psi * size;
}

// What is left of the plastic strain without the isotropic opening lies on the boundary of the cone of flow directions.
TEST(Gap, MohrCoulombOpensBeyondTheFlowAroundTheApex) {
  std::mt19937 generator(43);
  for (const double psi : {0.0, 8.0, 30.0}) {
    const auto model = law<MohrCoulomb>(dry, {{"psi", psi}});
    const double v = std::sin(psi * degree);
    for (int i = 0; i < 300; ++i) {
      const auto e = random_tensor<6>(generator, 1);
      const double g = model.opening(model.resolve(model.elasticity().stress(e)), 0.0);
      const auto values = spectral(e).value;
      const auto with = [&](double x) {
        return std::array<double, 3>{values[0] + x / 3, values[1] + x / 3, values[2] + x / 3};
      };
      EXPECT_TRUE(in_cone(with(g - 1e-10), v)) << psi << " " << i;
      EXPECT_FALSE(in_cone(with(g + 1e-10), v)) << psi << " " << i;
      // The stress stays at the apex exactly where the gap grows.
      auto s = start(model, 0);
      const auto there = attempt<ModifiedEuler>(model, s, 1e-3 * e, 1e-4).state;
      EXPECT_EQ(there.gap > 0, g > 0);
      EXPECT_EQ(norm(there.sigma) == 0, g > 0);
      EXPECT_NEAR(there.gap, 1e-3 * std::max(0.0, g), 1e-15);
    }
  }
}

// A cycle from an open state costs no energy, and gives none.
TEST(Gap, ACycleGivesNoWork) {
  const auto expect = [](const auto& model) {
    std::mt19937 generator(44);
    for (int k = 0; k < 50; ++k) {
      auto s = start(model, 0);
      s.gap = 1e-3 * (k % 5);
      const double gap = s.gap;
      const auto way = random_tensor<6>(generator, 4e-3);
      double work = 0;
      for (int i = 0; i < 200; ++i) {
        const auto before = s.sigma;
        const auto deps = (i < 100 ? 0.01 : -0.01) * way;
        integrate<ModifiedEuler>(model, s, deps, sharp);
        work += 0.5 * dot(before + s.sigma, deps);
      }
      EXPECT_GE(work, -1e-9);
      EXPECT_NEAR(-s.gap + mean(s.sigma) / model.elasticity().K, -gap, 1e-13);
    }
  };
  expect(law<MohrCoulomb>(dry));
  expect(law<DruckerPrager>(dry));
}

// An open point to which nothing happens keeps its state, stays separated, and is not turned.
TEST(Gap, AnOpenPointRests) {
  const auto expect = [](const auto& model) {
    auto s = start(model, 0);
    s.gap = 0.01;
    const auto trial = attempt<ModifiedEuler>(model, s, Sym<double, 6>::zero(), 1e-4);
    EXPECT_TRUE(trial.flags.separated && trial.flags.sound);
    EXPECT_EQ(trial.state.gap, 0.01);
    auto same = s;
    EXPECT_TRUE(model.accept(same, 1e-4).separated);
    EXPECT_EQ(same.gap, 0.01);
  };
  expect(law<MohrCoulomb>(dry));
  expect(law<DruckerPrager>(dilatant));
}

/// Lanes that open, stay open, close, and never opened.
template <class Model, int N>
void expect_batch_is_double(const Constants& constants) {
  const auto model = law<Model>(constants);
  std::mt19937 generator(45);
  for (int repeat = 0; repeat < 200; ++repeat) {
    std::array<typename Model::template State<double, N>, batch_lanes> s{};
    std::array<Sym<double, N>, batch_lanes> deps;
    for (std::size_t l = 0; l < batch_lanes; ++l) {
      if ((l + static_cast<std::size_t>(repeat)) % 2) {
        s[l].gap = l % 3 ? 1e-3 : 1e-6;
      } else {
        s[l].sigma = isotropic<double, N>(20);
      }
      s[l].kappa = 0.001 * static_cast<double>(l % 4);
      deps[l] = random_tensor<N>(generator, 2e-3);
    }
    const auto all = attempt<ModifiedEuler>(model, packed<Model, N>(s), pack<N>(deps), 1e-4);
    for (std::size_t l = 0; l < batch_lanes; ++l) {
      const auto one = attempt<ModifiedEuler>(model, s[l], deps[l], 1e-4);
      EXPECT_LT(norm(lane(all.state.sigma, l) - one.state.sigma), 1e-11);
      EXPECT_LT(norm(lane(all.state.epsp, l) - one.state.epsp), 1e-15);
      EXPECT_NEAR(lane(all.state.kappa, l), one.state.kappa, 1e-15);
      EXPECT_NEAR(lane(all.state.gap, l), one.state.gap, 1e-15);
      EXPECT_NEAR(lane(all.error, l), one.error, 1e-10 * one.error + 1e-12);
      EXPECT_EQ(all.flags.separated.get(l), one.flags.separated);
      EXPECT_EQ(all.flags.sound.get(l), one.flags.sound);
    }
  }
}

TEST(Gap, BatchGivesWhatDoubleGives) {
  expect_batch_is_double<MohrCoulomb, 4>(dry);
  expect_batch_is_double<MohrCoulomb, 6>(dilatant);
  expect_batch_is_double<DruckerPrager, 4>(dilatant);
  expect_batch_is_double<DruckerPrager, 6>(dry);
}

/// tr ε of a subloading point that started closed: eq. 26 for the elastic part.
template <class State>
double volume(const State& s, double p_0, const std::map<std::string, double>& c) {
  const double p_e = c.at("p_e");
  return c.at("kappa") * std::log((mean(s.sigma) + p_e) / (p_0 + p_e)) + trace(s.epsp) - s.gap;
}

/// Soil on its floor of p_c, pulled apart, sheared and closed again, strain by strain.
template <class Model>
void expect_volume_is_kept(const Model& model, const std::map<std::string, double>& constants, double floor) {
  std::vector<Problem> problems;
  auto s = model.template initial_state<6>(isotropic<double, 6>(0.3 * floor), 0.3 * floor,
                                           {{"R_b", 1.0}, {"p_c", floor}}, problems);
  ASSERT_TRUE(problems.empty());
  std::mt19937 generator(46);
  auto eps = Sym<double, 6>::zero();
  int open = 0, closed = 0;
  for (int i = 0; i < 400; ++i) {
    const auto deps = random_tensor<6>(generator, 5e-4) - isotropic<double, 6>((i / 20) % 2 ? -2e-3 : 2e-3);
    const bool before = s.gap > 0;
    const auto report = integrate<DormandPrince>(model, s, Increment<double, 6>{deps, 1.0}, {1e-8, 1e-9});
    ASSERT_EQ(report.end, IntegrationEnd::done) << i;
    eps = eps + deps;
    EXPECT_EQ(report.flags.separated && s.gap > 0, s.gap > 0);
    EXPECT_EQ(s.gap > 0 ? norm(s.sigma) + norm(s.a) : 0, 0);
    open += !before && s.gap > 0;
    closed += before && s.gap == 0;
    EXPECT_NEAR(trace(eps), volume(s, 0.3 * floor, constants), 2e-7 * (i + 1)) << i;
  }
  EXPECT_TRUE(open >= 2 && closed >= 2) << open << " " << closed;
}

TEST(Gap, SubloadingPointsOpenAndClose) {
  const double floor = 0.01 * 101.325;
  expect_volume_is_kept(subloading(full_constants()), full_constants(), floor);
  auto constants = full_constants();
  constants.insert({{"mu", 30}, {"n", 2}, {"R_m", 1.6}});
  expect_volume_is_kept(std::get<ViscoplasticSubloading>(made("viscoplastic-subloading", constants)), constants, floor);
}

// The rate alone, as the laboratory takes it under constraints: what is left after contact compresses the point.
TEST(Gap, TheRateOfAnOpenPointClosesIt) {
  const auto model = subloading(full_constants());
  Subloading::State<double, 6> s{};
  s.p_c = 1.01325;
  s.R_b = 1;
  s.gap = 1e-3;
  const Sym<double, 6> deps{{1e-3, 2e-3, 0, 1e-3, 0, 0}};
  const auto rate = model.rate(s, deps);
  EXPECT_TRUE(rate.sound);
  EXPECT_EQ(rate.change.gap, -3e-3);
  EXPECT_EQ(norm(rate.change.sigma) + norm(rate.change.epsp), 0);
  auto end = advanced(s, 1.0, rate.change);
  EXPECT_TRUE(model.accept(end, 1e-4).sound);
  EXPECT_EQ(end.gap, 0);
  EXPECT_NEAR(mean(end.sigma), 3 * std::expm1(2e-3 / 0.015), 1e-12);
}

}  // namespace
}  // namespace scarp::test::plastic
