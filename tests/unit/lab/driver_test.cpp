// The laboratory: what a test is driven by is what it does; where it cannot go on it says so.
#include "scarp/lab/driver.hpp"

#include <gtest/gtest.h>
#include <cmath>

#include "material/reference.hpp"
#include "material/samples.hpp"
#include "scarp/lab/named_tests.hpp"
#include "unit/lab/curve.hpp"

namespace scarp::lab {
namespace {

using scarp::test::Curve;
using scarp::test::made;
using scarp::test::named;
using scarp::test::run;

Test clay(std::vector<Stage> stages) {
  const Six stress{60, 60, 100, 0, 0, 0};
  return {made("subloading", scarp::test::full_constants()),
          stress,
          {{"R_b", 2.0}, {"p_c", 240.0}, {"a", 0.5}},
          Scheme::dormand_prince,
          1e-8,
          std::move(stages)};
}

Test elastic(std::vector<Stage> stages) {
  return {made("linear-elastic", {{"E", 2e4}, {"nu", 0.3}}),
          {50, 50, 50, 0, 0, 0},
          {},
          Scheme::dormand_prince,
          1e-8,
          std::move(stages)};
}

// What each named test holds, on a soil with every feature. Bands: the tolerance, over some hundred substeps.
TEST(NamedTests, HoldWhatTheyHold) {
  struct Case {
    std::string type, key;
    double target;
    std::vector<std::pair<std::string, double>> held;  ///< column and value along the whole curve
    std::string driven;
    double reached;
  };
  const double p0 = 220.0 / 3;
  const std::vector<Case> cases{
      {"isotropic", "p", 300, {{"q", 40}, {"eps_xy", 0}}, "p", 300},
      {"isotropic", "eps_v", 0.02, {{"q", 40}}, "eps_v", 0.02},
      {"oedometer", "eps_a", 0.05, {{"eps_xx", 0}, {"eps_yy", 0}}, "eps_zz", 0.05},
      {"oedometer", "sig_a", 300, {{"eps_xx", 0}, {"u", 0}}, "sig_zz", 300},
      {"triaxial-drained", "eps_a", 0.05, {{"sig_xx", 60}, {"sig_yy", 60}, {"u", 0}}, "eps_zz", 0.05},
      {"triaxial-drained", "eps_a", -0.05, {{"sig_xx", 60}, {"sig_yy", 60}}, "eps_zz", -0.05},
      {"triaxial-drained", "q", 70, {{"sig_xx", 60}}, "q", 70},
      {"triaxial-undrained", "eps_a", 0.05, {{"eps_v", 0}}, "eps_zz", 0.05},
      {"triaxial-undrained", "eps_a", -0.05, {{"eps_v", 0}}, "eps_zz", -0.05},
      {"constant-p", "eps_a", 0.05, {{"p", p0}}, "eps_zz", 0.05},
      {"simple-shear-drained", "gamma", 0.1, {{"sig_zz", 100}, {"eps_xx", 0}, {"eps_yy", 0}, {"u", 0}}, "eps_zx", 0.05},
      {"simple-shear-undrained", "gamma", 0.1, {{"eps_v", 0}, {"eps_zz", 0}}, "eps_zx", 0.05},
      {"simple-shear-undrained", "tau", 15, {{"eps_v", 0}}, "sig_zx", 15},
  };
  for (const auto& c : cases) {
    const auto curve = run(clay({named(c.type, c.key, {c.target}, 20)}));
    SCOPED_TRACE(c.type + " " + c.key);
    ASSERT_EQ(curve.problem, "");
    ASSERT_EQ(curve.rows, 20u);
    EXPECT_NEAR(curve.last(c.driven), c.reached, 1e-6 * std::abs(c.reached));
    for (const auto& [column, value] : c.held) {
      for (double x : curve[column]) ASSERT_NEAR(x, value, 1e-6 * (1 + std::abs(value))) << column;
    }
  }
}

// Total stress is constant on the cell, so u is what the effective stress there has lost; it goes on over undrained
// stages and is gone once water may leave.
TEST(NamedTests, PorePressure) {
  const auto curve =
      run(clay({named("triaxial-undrained", "eps_a", {0.02}, 10), named("triaxial-undrained", "eps_a", {0.02}, 10),
                named("simple-shear-drained", "gamma", {0.01}, 10)}));
  for (std::size_t i = 0; i < 20; ++i) EXPECT_NEAR(curve["u"][i], 60 - curve["sig_xx"][i], 1e-9);
  EXPECT_GT(std::abs(curve["u"][19]), 1);
  for (std::size_t i = 20; i < 30; ++i) EXPECT_EQ(curve["u"][i], 0);
}

TEST(NamedTests, CyclesBetweenStrainLimits) {
  const auto curve = run(clay({named("simple-shear-undrained", "gamma", {0.01, -0.01, 0.01, -0.01}, 5)}));
  ASSERT_EQ(curve.rows, 20u);
  for (std::size_t leg = 0; leg < 4; ++leg) {
    EXPECT_NEAR(2 * curve["eps_zx"][5 * leg + 4], leg % 2 ? -0.01 : 0.01, 1e-12);
  }
}

TEST(NamedTests, HundredCyclesBetweenStressLimitsStayWithinThem) {
  std::vector<double> targets;
  for (int i = 0; i < 100; ++i) targets.insert(targets.end(), {30.0, -20.0});
  const auto curve = run(clay({named("triaxial-undrained", "q", targets, 10)}));
  ASSERT_EQ(curve.problem, "");
  ASSERT_EQ(curve.rows, 2000u);
  for (std::size_t i = 0; i < curve.rows; ++i) {
    const double q = curve["sig_zz"][i] - curve["sig_xx"][i];
    ASSERT_LE(q, 40 + 1e-6);  // where it starts
    ASSERT_GE(q, -20 - 1e-6);
    ASSERT_GT(curve["p"][i], 0);
    ASSERT_LE(curve["R"][i], 1 + 1e-6);
    ASSERT_NEAR(curve["eps_v"][i], 0, 1e-9);
  }
}

TEST(NamedTests, CreepAndRelaxationOfASoilWithoutTimeDoNothing) {
  for (const char* type : {"creep", "relaxation"}) {
    for (const auto& test : named_tests()) {
      if (test.type != type) continue;
      Constraints constraints;
      std::copy(test.held.begin(), test.held.end(), constraints.forms.begin());
      const auto curve = run(clay({{type, constraints, 3, 60, {}}}));
      EXPECT_EQ(curve.last("sig_zz"), 100);
      EXPECT_EQ(curve.last("eps_zz"), 0);
      EXPECT_NEAR(curve.last("time"), 60, 1e-12);
    }
  }
}

// Held at a stress below its strength, a soil of the viscoplastic law creeps ever more slowly and comes to rest.
TEST(NamedTests, CreepOfASoilWithTimeEnds) {
  auto constants = scarp::test::full_constants();
  constants.insert({{"mu", 100}, {"n", 1}, {"R_m", 1.5}});
  auto loading = named("triaxial-drained", "q", {50}, 10);
  loading.duration = 1;
  Constraints held;
  for (const auto& test : named_tests()) {
    if (test.type == "creep") std::copy(test.held.begin(), test.held.end(), held.forms.begin());
  }
  auto test = clay({loading, {"creep", held, 10, 1e4, {}}});
  test.model = made("viscoplastic-subloading", constants);
  const auto curve = run(test);
  ASSERT_EQ(curve.problem, "");
  const auto& eps = curve["eps_zz"];
  const std::size_t start = curve.rows - 11;  // where the creep starts
  EXPECT_GT(eps[start + 1], eps[start] * 1.01);
  for (std::size_t i = start + 1; i < curve.rows; ++i) {
    EXPECT_NEAR(curve["sig_zz"][i], curve["sig_zz"][start], 1e-6);
    EXPECT_GE(eps[i], eps[i - 1] - 1e-12);
  }
  EXPECT_NEAR(curve.last("eps_zz"), eps[curve.rows - 2], 1e-9);
  EXPECT_NEAR(curve.last("R"), curve.last("R_s"), 1e-9);
}

// Hooke's law: E of uniaxial stress, the constrained modulus, G; large increments in one.
TEST(Constrained, ElasticModuli) {
  const double E = 2e4, nu = 0.3, G = E / (2 * (1 + nu));
  const auto uniaxial = run(elastic({named("triaxial-drained", "eps_a", {1e-3}, 1)}));
  EXPECT_NEAR(uniaxial.last("sig_zz"), 50 + E * 1e-3, 1e-9);
  EXPECT_NEAR(uniaxial.last("eps_xx"), -nu * 1e-3, 1e-15);
  const auto confined = run(elastic({named("oedometer", "sig_a", {100}, 1)}));
  EXPECT_NEAR(confined.last("eps_zz"), 50 * (1 + nu) * (1 - 2 * nu) / (E * (1 - nu)), 1e-12);
  const auto shear = run(elastic({named("simple-shear-drained", "tau", {10}, 1)}));
  EXPECT_NEAR(2 * shear.last("eps_zx"), 10 / G, 1e-15);
}

// An oblique set: σ_xx + 2 ε_xy·1000 = given, and forms that mix shear components, each counted once.
TEST(Constrained, MixedFormsCountShearOnce) {
  Constraints c;
  const double stiffness = 1000;
  c.forms[0] = {{0, 0, 0, stiffness, 0, 0}, {1, 0, 0, 0, 0, 0}};
  c.forms[1] = {{0, 0, 0, 1, 1, 0}, {}};
  c.forms[2] = {{0, 0, 0, 0, 0, 0}, {0, 0, 0, 0, 1, 0}};
  c.forms[3] = {{0, 1, 0, 0, 0, 0}, {}};
  c.forms[4] = {{0, 0, 1, 0, 0, 0}, {}};
  c.forms[5] = {{0, 0, 0, 0, 0, 1}, {}};
  c.b = {7, 2e-3, 0.5, 1e-4, 0, 3e-4};
  const auto curve = run(elastic({{"constraints", c, 4, 0, {}}}));
  EXPECT_NEAR(curve.last("sig_xx") - 50 + stiffness * curve.last("eps_xy"), 7, 1e-9);
  EXPECT_NEAR(curve.last("eps_xy") + curve.last("eps_yz"), 2e-3, 1e-14);
  EXPECT_NEAR(curve.last("sig_yz"), 0.5, 1e-10);
  EXPECT_NEAR(curve.last("sig_xy") / curve.last("eps_xy"), 2e4 / 1.3, 1e-6);
}

// The independent curves under their own programs of constraints (not the strain replay): stresses and strains.
TEST(Constrained, ReferenceProgramsAreFollowed) {
  for (const auto& name : scarp::test::reference_names()) {
    const auto reference = scarp::test::read_reference(name);
    SCOPED_TRACE(name);
    auto values = [](const Sym<double, 6>& a) {
      const auto t = from_mandel(a);
      return std::vector<double>(t.begin(), t.end());
    };
    lab::Test test{made("subloading", reference.constants),
                   from_mandel(reference.initial.sigma),
                   {{"R_b", reference.initial.R_b},
                    {"p_c", reference.initial.p_c},
                    {"a", values(reference.initial.a)},
                    {"beta", values(reference.initial.beta)}},
                   Scheme::dormand_prince,
                   1e-8,
                   {}};
    for (const auto& stage : reference.program) {
      Constraints c;
      for (std::size_t row = 0; row < 6; ++row) {
        for (std::size_t i = 0; i < 6; ++i) {
          c.forms[row].E[i] = stage.constraints[row][i];
          c.forms[row].S[i] = stage.constraints[row][6 + i];
        }
        c.b[row] = stage.constraints[row][12];
      }
      test.stages.push_back({stage.label, c, stage.outputs, 0, {}});
    }
    const auto curve = run(test);
    ASSERT_EQ(curve.problem, "");
    ASSERT_EQ(curve.rows + 1, reference.curve.size());
    double strain = 0, stress = 0, most_strain = 0, most_stress = 0;
    for (std::size_t i = 1; i < reference.curve.size(); ++i) {
      for (std::size_t k = 0; k < 6; ++k) {
        const std::string component = component_names[k];
        strain = std::max(strain, std::abs(curve["eps_" + component][i - 1] - reference.curve[i][k]));
        stress = std::max(stress, std::abs(curve["sig_" + component][i - 1] - reference.curve[i][6 + k]));
        most_strain = std::max(most_strain, std::abs(reference.curve[i][k]));
        most_stress = std::max(most_stress, std::abs(reference.curve[i][6 + k]));
      }
    }
    EXPECT_LT(stress, 1e-6 * most_stress);  // found: 1e-7 or less at tolerance 1e-8
    EXPECT_LT(strain, 1e-5 * most_strain);  // cyclic stress near R_min is soft: 2e-6
  }
}

TEST(Driver, AStrainPathReachesEachRow) {
  const std::vector<Six> path{{0, 0, 0, 0, 0, 0}, {1e-3, 0, 2e-3, 0, 0, 1e-3}, {1e-3, -1e-3, 4e-3, 0, 5e-4, 0}};
  const auto curve = run(clay({{"strain-path", StrainPath{path}, 1, 0, {}}}));
  ASSERT_EQ(curve.rows, 3u);
  EXPECT_EQ(curve["sig_zz"][0], 100);
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 6; ++k) {
      EXPECT_NEAR(curve[std::string("eps_") + component_names[k]][i], path[i][k], 1e-17);
    }
  }
}

TEST(Driver, StopsWhereItIsTold) {
  auto stage = named("triaxial-undrained", "eps_a", {0.1}, 100);
  stage.stops = {{"q", 60}, {"eps_q", 0.5}};
  const auto curve = run(clay({stage, named("triaxial-undrained", "eps_a", {0.001}, 1)}));
  const auto& q = curve["q"];
  ASSERT_GT(curve.rows, 2u);
  ASSERT_LT(curve.rows, 100u);
  EXPECT_GE(q[curve.rows - 2], 60);
  EXPECT_LT(q[curve.rows - 3], 60);
  EXPECT_EQ(curve["stage"].back(), 2);
}

TEST(Driver, ALimitPointUnderStressControlIsNamedAndRowsBeforeItKept) {
  const auto strong = run(clay({named("triaxial-undrained", "eps_a", {1.0}, 1000)}));
  const double peak = *std::max_element(strong["q"].begin(), strong["q"].end());
  const auto curve = run(clay({named("triaxial-undrained", "q", {2 * peak}, 100)}));
  EXPECT_NE(curve.problem.find("stage 1 (triaxial-undrained) stops in increment"), std::string::npos) << curve.problem;
  EXPECT_NE(curve.problem.find("limit point"), std::string::npos) << curve.problem;
  ASSERT_GT(curve.rows, 10u);
  EXPECT_NEAR(curve.last("q"), peak, 0.02 * peak);
}

// Bonds that break faster than the elastic law can follow: no strain has an answer, whatever drives the test.
TEST(Driver, AnInstabilityOfTheSoilIsNoLimitPoint) {
  auto constants = scarp::test::full_constants();
  constants["c_b"] = 1000;
  for (const char* type : {"triaxial-undrained", "oedometer", "triaxial-drained"}) {
    auto test = clay({named(type, "eps_a", {0.05}, 10)});
    test.model = made("subloading", constants);
    const auto curve = run(test);
    EXPECT_NE(curve.problem.find("the soil is unstable"), std::string::npos) << type << ": " << curve.problem;
  }
}

// After the peak a falling stress can be met by unloading and by failing further: the soil unloads.
TEST(Driver, ASofteningSoilUnloadsWhenItsStressIsLowered) {
  const auto curve =
      run(clay({named("triaxial-undrained", "eps_a", {0.08}, 80), named("triaxial-undrained", "q", {20}, 10)}));
  ASSERT_EQ(curve.problem, "");
  EXPECT_LT(curve.last("eps_zz"), 0.08);
  EXPECT_NEAR(curve.last("sig_zz") - curve.last("sig_xx"), 20, 1e-6);
}

TEST(Driver, ConstraintsThatTheSoilCannotMeetAreRefused) {
  Constraints c;  // p and all strains prescribed but one, which p cannot be moved by: undrained shear with p rising
  for (std::size_t i = 0; i < 6; ++i) c.forms[i].E[i] = 1;
  c.forms[2] = {{}, {0, 0, 0, 0, 1, 0}};  // σ_yz in place of ε_zz, with ε_yz held: elastic soil cannot change it
  c.b[2] = 5;
  const auto curve = run(elastic({{"constraints", c, 2, 0, {}}}));
  EXPECT_EQ(curve.rows, 0u);
  EXPECT_NE(curve.problem.find("no strain meets the constraints"), std::string::npos) << curve.problem;
}

TEST(Driver, SchemesAgree) {
  auto test = clay({named("simple-shear-drained", "gamma", {0.2}, 40)});
  const auto fine = run(test);
  test.scheme = Scheme::modified_euler;
  const auto other = run(test);
  for (std::size_t i = 0; i < fine.rows; ++i) {
    EXPECT_NEAR(fine["sig_zx"][i], other["sig_zx"][i], 1e-6 * 100);
    EXPECT_NEAR(fine["eps_zz"][i], other["eps_zz"][i], 1e-7);
  }
}

}  // namespace
}  // namespace scarp::lab
