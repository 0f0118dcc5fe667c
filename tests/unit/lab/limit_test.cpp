// Where soil has no strength left to give: strain control goes on, a stress beyond the strength ends at the limit
// point.
#include <gtest/gtest.h>
#include <cmath>
#include <ctime>

#include "material/samples.hpp"
#include "scarp/lab/driver.hpp"
#include "unit/lab/curve.hpp"

namespace scarp::lab {
namespace {

using scarp::test::made;
using scarp::test::named;
using scarp::test::run;

using Constants = std::map<std::string, double>;
constexpr double degree = 0.017453292519943295769;

Test isotropic_test(const std::string& model, const Constants& constants, double cell, const Values& initial,
                    std::vector<Stage> stages) {
  return {made(model, constants), {cell, cell, cell, 0, 0, 0}, initial, Scheme::dormand_prince, 1e-8,
          std::move(stages)};
}

/// The clay of examples/lab.
Constants clay() {
  return {{"kappa", .02}, {"lambda", .12}, {"nu", .3},   {"p_e", 5},  {"M", 1},
          {"M_c", 1.3},   {"k", .78},      {"alpha", 1}, {"xi", .01}, {"c_R", 60},
          {"c_beta", 5},  {"c_b", 20},     {"R_bf", 1},  {"c_a", 3},  {"p_atm", 101.325}};
}

/// Drucker and Prager's cone through triaxial compression.
struct Cone {
  double M, k;
  Cone(double c, double phi) {
    const double sin_phi = std::sin(phi * degree);
    M = 6 * sin_phi / (3 - sin_phi);
    k = 6 * c * std::cos(phi * degree) / (3 - sin_phi);
  }
  /// q of drained triaxial compression: q = M (cell + q/3) + k
  double q(double cell) const { return (M * cell + k) / (1 - M / 3); }
};

// At critical state stress and volume stand still while the soil shears on; whatever the increments, held stresses
// hold.
TEST(Limit, StrainControlGoesOnAtCriticalState) {
  struct Case {
    std::string type;
    double to;
  };
  for (const auto& [type, to] : {Case{"triaxial-drained", -3}, Case{"triaxial-drained", 3},
                                 Case{"triaxial-undrained", 5}, Case{"constant-p", 3}}) {
    for (const int increments : {50, 130, 200, 300, 1000}) {
      SCOPED_TRACE(type + " " + std::to_string(to) + " in " + std::to_string(increments));
      const auto curve = run(isotropic_test("subloading", clay(), 80, {{"p_c", 250.0}, {"R_b", 3.0}, {"a", 0.5}},
                                            {named(type, "eps_a", {to}, increments)}));
      ASSERT_EQ(curve.problem, "");
      ASSERT_EQ(curve.rows, static_cast<std::size_t>(increments));
      EXPECT_NEAR(curve.last("eps_zz"), to, 1e-9);
      const std::size_t before = curve.rows * 9 / 10;
      EXPECT_NEAR(curve.last("q"), curve["q"][before], 1e-4 * curve.last("q"));
      EXPECT_NEAR(curve.last("eps_v"), curve["eps_v"][before], 1e-5);
      for (std::size_t i = 0; type == "triaxial-drained" && i < curve.rows; ++i) {
        ASSERT_NEAR(curve["sig_xx"][i], 80, 1e-6);
      }
    }
  }
}

TEST(Limit, TheViscousSoilGoesOnAtCriticalState) {
  auto constants = clay();
  constants.insert({{"mu", 100}, {"n", 1}, {"R_m", 1.5}});
  auto stage = named("triaxial-drained", "eps_a", {2.0}, 200);
  stage.duration = 1e4;
  const auto curve = run(
      isotropic_test("viscoplastic-subloading", constants, 80, {{"p_c", 250.0}, {"R_b", 3.0}, {"a", 0.5}}, {stage}));
  ASSERT_EQ(curve.problem, "");
  EXPECT_NEAR(curve.last("q"), curve["q"][180], 1e-4 * curve.last("q"));
  EXPECT_NEAR(curve.last("sig_xx"), 80, 1e-6);
}

// Drained simple shear of perfectly plastic, dilating soil: ε_xx = ε_yy = 0, so that flow alone sets ε_zz. Mohr and
// Coulomb: ε_zz = −γ tan ψ and τ = (σ_zz sin φ cos ψ + c cos φ cos ψ)/(1 − sin φ sin ψ) (Davis 1968); Drucker and
// Prager: ε_v = −M_ψ ε_q with ε_q² = 4/9 ε_zz² + γ²/3.
TEST(Limit, PerfectPlasticityShearsOnAndDilates) {
  const double phi = 30, c = 5;
  for (const double psi : {0.0, 10.0, 30.0}) {
    for (const std::string model : {"mohr-coulomb", "drucker-prager"}) {
      for (const int increments : {50, 656}) {
        for (const double sense : {1.0, -1.0}) {
          SCOPED_TRACE(model + ", psi " + std::to_string(psi) + ", increments " + std::to_string(increments));
          const auto curve =
              run(isotropic_test(model, {{"E", 2e4}, {"nu", 0.3}, {"c", c}, {"phi", phi}, {"psi", psi}}, 100, {},
                                 {named("simple-shear-drained", "gamma", {0.8 * sense}, increments),
                                  named("simple-shear-drained", "gamma", {0.1 * sense}, increments)}));
          ASSERT_EQ(curve.problem, "");
          ASSERT_EQ(curve.rows, 2u * static_cast<unsigned>(increments));
          for (double x : curve["sig_zz"]) ASSERT_NEAR(x, 100, 1e-5);
          const auto middle = static_cast<std::size_t>(increments) - 1;
          const double rate = (curve.last("eps_zz") - curve["eps_zz"][middle]) / 0.1;
          const double M_psi = Cone(0, psi).M;
          const bool mohr = model == "mohr-coulomb";
          const double expected = mohr ? std::tan(psi * degree) : M_psi / std::sqrt(3 - 4.0 / 3 * M_psi * M_psi);
          EXPECT_NEAR(rate, -expected, 1e-5);
          const double s = std::sin(phi * degree);
          const double tau =
              (100 * s + c * std::cos(phi * degree)) * std::cos(psi * degree) / (1 - s * std::sin(psi * degree));
          if (mohr) {
            EXPECT_NEAR(curve.last("sig_zx"), sense * tau, 1e-4 * tau);
          }
        }
      }
    }
  }
}

// Where softening ends the response has a corner. docs/models/drucker-prager.md#picture
TEST(Limit, StrainControlGoesOnWhereSofteningEnds) {
  const Constants constants{
      {"E", 3e4},           {"nu", 0.25},          {"c", 5}, {"phi", 38}, {"psi", 8}, {"c_residual", 0},
      {"phi_residual", 32}, {"epsp_residual", 0.1}};
  for (const double cell : {50.0, 100.0, 400.0}) {
    for (const int increments : {50, 200, 400}) {
      SCOPED_TRACE(std::to_string(cell) + " in " + std::to_string(increments));
      const auto curve = run(isotropic_test("drucker-prager", constants, cell, {},
                                            {named("triaxial-drained", "eps_a", {0.25}, increments)}));
      ASSERT_EQ(curve.problem, "");
      ASSERT_EQ(curve.rows, static_cast<std::size_t>(increments));
      EXPECT_NEAR(curve.last("q"), Cone(0, 32).q(cell), 1e-5 * cell);
      EXPECT_NEAR(curve.last("sig_xx"), cell, 1e-6 * cell);
    }
  }
}

/// A number of the state in a message.
double found(const std::string& what, const std::string& message) {
  const auto at = message.find(" " + what);
  return at == std::string::npos ? std::nan("") : std::stod(message.substr(at + 1 + what.size()));
}

// A stress beyond the strength: every row below the strength is there, the message has the limit point, and it does not
// take long. MCC from its normal line comes to critical state, q = M (cell + q/3), from below.
TEST(Limit, AStressBeyondTheStrengthEndsAtTheLimitPoint) {
  const double s_u = 40, phi = 30, c = 5, cell = 100;
  const double s = std::sin(phi * degree);
  const Constants sand{{"E", 2e4}, {"nu", 0.3}, {"c", c}, {"phi", phi}, {"psi", 0}};
  const Constants undrained{{"E", 2e4}, {"nu", 0.3}, {"s_u", s_u}};
  struct Case {
    std::string model;
    Constants constants;
    Values initial;
    double strength, most_strain;
  };
  const std::vector<Case> cases{
      {"von-mises", undrained, {}, std::sqrt(3.0) * s_u, 0.01},
      {"tresca", undrained, {}, 2 * s_u, 0.01},
      {"mohr-coulomb", sand, {}, (2 * cell * s + 2 * c * std::cos(phi * degree)) / (1 - s), 0.02},
      {"drucker-prager", sand, {}, Cone(c, phi).q(cell), 0.02},
      {"modified-cam-clay",
       {{"kappa", .02}, {"lambda", .1}, {"nu", .25}, {"p_e", 0}, {"M", 1.2}, {"p_atm", 101.325}},
       {{"OCR", 1.0}},
       1.2 * cell / (1 - 0.4),
       2}};
  for (const auto& law : cases) {
    for (const int increments : {10, 100, 400}) {
      SCOPED_TRACE(law.model + " in " + std::to_string(increments));
      const double target = 4.6 * law.strength;
      const auto start = std::clock();
      const auto curve = run(isotropic_test(law.model, law.constants, cell, law.initial,
                                            {named("triaxial-drained", "q", {target}, increments)}));
      const double seconds = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
      EXPECT_LT(seconds, 5);  // of this thread: 0.1 in a fast build; it was minutes
      EXPECT_EQ(curve.rows, static_cast<std::size_t>(law.strength / (target / increments)));
      EXPECT_NE(curve.problem.find("limit point"), std::string::npos) << curve.problem;
      // "found p = 172.4, q = 217.3, ...": the state that was reached, without strain that only rounding asks for
      EXPECT_NEAR(found("q = ", curve.problem), law.strength, 2e-4 * law.strength);
      EXPECT_LT(found("eps_q = ", curve.problem), law.most_strain);
    }
  }
}

// The perfectly plastic soil holds its strength, gives it back and takes it again; more it does not take.
TEST(Limit, StressIsHeldLoweredAndRaisedAgainAtTheStrength) {
  const auto shear = [](double to) { return named("triaxial-drained", "q", {to}, 20); };
  Constraints held;
  for (const auto& test : named_tests()) {
    if (test.type == "creep") std::copy(test.held.begin(), test.held.end(), held.forms.begin());
  }
  const double strength = Cone(5, 30).q(100);
  for (const std::string model : {"mohr-coulomb", "drucker-prager"}) {
    const auto curve = run(isotropic_test(model, {{"E", 2e4}, {"nu", 0.3}, {"c", 5}, {"phi", 30}, {"psi", 5}}, 100, {},
                                          {named("triaxial-drained", "eps_a", {0.05}, 40),
                                           {"creep", held, 3, 0, {}},
                                           shear(20),
                                           shear(0.999 * strength),
                                           shear(strength + 1)}));
    SCOPED_TRACE(model);
    ASSERT_GE(curve.rows, 83u);
    EXPECT_NEAR(curve["q"][39], strength, 1e-6 * strength);
    EXPECT_EQ(curve["q"][42], curve["q"][39]);
    EXPECT_NEAR(curve["eps_zz"][42], 0.05, 1e-15);
    EXPECT_NEAR(curve["eps_zz"][62], 0.05 - (strength - 20) / 2e4, 1e-9);  // elastic
    EXPECT_NEAR(curve["eps_zz"][82], 0.05 - 0.001 * strength / 2e4, 1e-9);
    EXPECT_NE(curve.problem.find("stage 5"), std::string::npos) << curve.problem;
    EXPECT_NE(curve.problem.find("prescribe a strain"), std::string::npos) << curve.problem;
  }
}

// On a softening branch a falling stress can be met by failing further, too: the soil unloads.
TEST(Limit, SofteningSoilWithAReturnUnloadsWhenItsStressIsLowered) {
  const Constants constants{{"E", 2e4}, {"nu", 0.3}, {"s_u", 40}, {"s_u_residual", 20}, {"epsp_residual", 0.2}};
  for (const std::string model : {"von-mises", "tresca"}) {
    const auto curve =
        run(isotropic_test(model, constants, 100, {},
                           {named("triaxial-drained", "eps_a", {0.08}, 80), named("triaxial-drained", "q", {30}, 10)}));
    SCOPED_TRACE(model);
    ASSERT_EQ(curve.problem, "");
    EXPECT_NEAR(curve.last("eps_zz"), 0.08 - (curve["q"][79] - 30) / 2e4, 1e-9);
  }
}

// Softening by more than E over the plastic axial strain snaps back at constant lateral stress: no axial strain that
// grows has an answer, whatever the increments, and no stress was driven. The peak is Mohr and Coulomb's circle.
TEST(Limit, ASnapBackUnderStrainControlIsNamed) {
  const Constants constants{{"E", 2e4}, {"nu", 0.3}, {"s_u", 40}, {"s_u_residual", 1}, {"epsp_residual", 0.0035}};
  for (const int increments : {7, 50, 300}) {
    const auto curve =
        run(isotropic_test("tresca", constants, 100, {}, {named("triaxial-drained", "eps_a", {0.02}, increments)}));
    EXPECT_NE(curve.problem.find("limit point"), std::string::npos) << curve.problem;
    EXPECT_NE(curve.problem.find("q = 80,"), std::string::npos) << curve.problem;
    EXPECT_NE(curve.problem.find("hold strains in their place"), std::string::npos) << curve.problem;
  }
}

// The same where plastic straining sets in: before it the soil has an answer, and just behind it none.
TEST(Limit, ASnapBackAtTheOnsetOfPlasticStrainIsNamed) {
  const Constants constants{{"kappa", .05}, {"lambda", .25}, {"nu", .19},   {"p_e", 3}, {"M", .73},
                            {"M_c", .9},    {"k", .82},      {"alpha", .8}, {"xi", 0},  {"c_R", 77},
                            {"c_beta", 0},  {"c_b", 28},     {"R_bf", 1},   {"c_a", 6}, {"p_atm", 101.325}};
  for (const int increments : {50, 841}) {
    const auto curve = run(isotropic_test("subloading", constants, 340, {{"R_b", 3.3}, {"OCR", 1.05}, {"a", 0.13}},
                                          {named("triaxial-drained", "eps_a", {-0.2}, increments)}));
    EXPECT_NE(curve.problem.find("limit point"), std::string::npos) << curve.problem;
    EXPECT_NE(curve.problem.find("hold strains in their place"), std::string::npos) << curve.problem;
  }
}

}  // namespace
}  // namespace scarp::lab
