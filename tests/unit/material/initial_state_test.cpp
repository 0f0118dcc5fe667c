// The initial state of the subloading model: the R that its rules promise, and its complaints.
#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>

#include "material/plain_law.hpp"
#include "material/samples.hpp"

namespace scarp::test {
namespace {

const Sym<double, 4> ground{{60, 100, 60, 14}};  // σ_yy vertical

Subloading::State<double, 4> state(const Subloading& model, const Values& keys) {
  std::vector<Problem> problems;
  const auto s = model.initial_state<4>(ground, 100, keys, problems);
  for (const auto& p : problems) ADD_FAILURE() << p.key << ": " << p.what << ' ' << p.value;
  return s;
}

TEST(InitialState, TheYieldSurfaceThroughAStress) {
  for (double xi : {0.0, 0.003, 0.2}) {
    const auto model = subloading(full_constants(), {{"xi", xi}});
    const Sym<double, 4> beta{{-0.1, 0.2, -0.1, 0.05}};
    const double p_c = model.p_c_through(ground, beta);
    EXPECT_NEAR(yield_function(model.parameters(), to_matrix(ground), to_matrix(beta), p_c), 0, 1e-13 * p_c * p_c);
  }
}

// With a = f σ the image of σ on the yield surface is OCR σ = f σ + (1 − f) σ / R.
TEST(InitialState, OCRGivesItsR) {
  const auto model = subloading(full_constants());
  for (double f : {0.0, 0.3, 0.9}) {
    for (double OCR : {1.0, 1.5, 4.0}) {
      for (const char* beta : {"isotropic", "K0"}) {
        const auto s = state(model, {{"R_b", 2.0}, {"OCR", OCR}, {"a", f}, {"beta", beta}});
        EXPECT_NEAR(model.homothety(s).R, (1 - f) / (OCR - f), 1e-12) << f << ' ' << OCR;
        EXPECT_EQ(s.R_b, 2.0);
      }
    }
  }
}

TEST(InitialState, POPGivesTheOCROfTheVerticalStress) {
  const auto model = subloading(full_constants());
  const auto s = state(model, {{"R_b", 1.0}, {"POP", 50.0}, {"a", 0.5}});
  EXPECT_NEAR(model.homothety(s).R, (1 - 0.5) / (1.5 - 0.5), 1e-12);  // 1 + 50/100
}

TEST(InitialState, RIsWhatWasAskedFor) {
  const auto model = subloading(full_constants());
  for (double R : {0.05, 0.4, 1.0}) {
    EXPECT_NEAR(model.homothety(state(model, {{"R_b", 1.0}, {"R", R}, {"a", 0.4}, {"beta", "K0"}})).R, R, 1e-12);
    const std::vector<double> centre{20, 30, 25, 5, 0, 0};
    EXPECT_NEAR(model.homothety(state(model, {{"R_b", 1.0}, {"R", R}, {"a", centre}})).R, R, 1e-12);
  }
}

TEST(InitialState, TheLargestOfSeveralSizesIsTaken) {
  const auto model = subloading(full_constants());
  const double normal = model.p_c_through(ground, Sym<double, 4>::zero());
  auto size = [&](double OCR, double POP, double p_c) {
    return state(model, {{"R_b", 1.0}, {"OCR", OCR}, {"POP", POP}, {"p_c", p_c}}).p_c / normal;
  };
  EXPECT_NEAR(size(1.2, 10, 1), 1.2, 1e-12);
  EXPECT_NEAR(size(1.2, 40, 1), 1.4, 1e-12);
  EXPECT_NEAR(size(1.2, 40, 3 * normal), 3, 1e-12);
}

TEST(InitialState, BetaFromK0IsTheLimitOfItsLawButNoFurtherThanTheStress) {
  const auto model = subloading(full_constants());
  const auto s = state(model, {{"R_b", 1.0}, {"OCR", 1.5}, {"beta", "K0"}});
  const auto dev = deviator(ground);
  const double eta = std::min(model.eta_beta_cs(1.2 * willam_warnke(cos_3_lode(dev), 5.0 / 7)),
                              deviatoric_stress(ground) / mean(ground));
  EXPECT_NEAR(std::sqrt(1.5) * norm(s.beta), eta, 1e-14);
  EXPECT_NEAR(dot(s.beta, dev), norm(s.beta) * norm(dev), 1e-12);  // along s
  std::vector<Problem> problems;
  const auto near_isotropic =
      model.initial_state<4>({{100, 101, 100, 0}}, 101, {{"R_b", 1.0}, {"OCR", 1.5}, {"beta", "K0"}}, problems);
  EXPECT_NEAR(std::sqrt(1.5) * norm(near_isotropic.beta), 1.0 / (301.0 / 3), 1e-12);  // q/p
}

TEST(InitialState, GivenTensorsAreTakenAsTensorComponents) {
  const auto model = subloading(full_constants());
  const std::vector<double> beta{-0.05, 0.1, -0.05, 0.02, 0, 0}, a{20, 30, 22, 4, 0, 0};
  const auto s = state(model, {{"R_b", 1.0}, {"OCR", 2.0}, {"beta", beta}, {"a", a}});
  EXPECT_DOUBLE_EQ(from_mandel(s.beta)[3], 0.02);
  EXPECT_DOUBLE_EQ(from_mandel(s.a)[3], 4);
  EXPECT_DOUBLE_EQ(s.a[1], 30);
}

TEST(InitialState, AFreeSurfaceStandsOnTheFloorOfPc) {
  const auto model = subloading(full_constants());
  std::vector<Problem> problems;
  const auto s =
      model.initial_state<4>(Sym<double, 4>::zero(), 0, {{"R_b", 1.0}, {"OCR", 1.5}, {"POP", 20.0}}, problems);
  EXPECT_TRUE(problems.empty());
  EXPECT_NEAR(s.p_c, 0.01 * 101.325, 1e-12);
  EXPECT_TRUE(model.admissible(s));
}

struct Complaint {
  const char* about;
  const char* key;   ///< that the problem must stand under
  const char* says;  ///< part of its text
  Values keys;
};

void expect_complaint(const Complaint& c, const Sym<double, 4>& sigma, double p_e = 3) {
  std::vector<Problem> problems;
  subloading(full_constants(), {{"p_e", p_e}}).initial_state<4>(sigma, 100, c.keys, problems);
  const bool found = std::any_of(problems.begin(), problems.end(), [&](const Problem& p) {
    return p.key == c.key && p.what.find(c.says) != std::string::npos && !p.remedy.empty();
  });
  EXPECT_TRUE(found) << c.about << (problems.empty() ? ": nothing said" : ": " + problems.front().what);
}

TEST(InitialState, Complaints) {
  using List = std::vector<double>;
  const std::vector<Complaint> all = {
      {"no R_b", "R_b", "missing", {{"OCR", 1.5}}},
      {"R_b too small", "R_b", "R_b >= 1", {{"R_b", 0.9}, {"OCR", 1.5}}},
      {"R_b a word", "R_b", "is a number", {{"R_b", "two"}, {"OCR", 1.5}}},
      {"no size", "OCR", "missing", {{"R_b", 1.0}}},
      {"OCR too small", "OCR", "OCR >= 1", {{"R_b", 1.0}, {"OCR", 0.5}}},
      {"POP negative", "POP", "POP >= 0", {{"R_b", 1.0}, {"POP", -1.0}}},
      {"p_c not positive", "p_c", "p_c > 0", {{"R_b", 1.0}, {"p_c", 0.0}}},
      {"p_c too small", "p_c", "R <= 1", {{"R_b", 1.0}, {"p_c", 20.0}}},
      {"R above one", "R", "0 < R <= 1", {{"R_b", 1.0}, {"R", 1.1}}},
      {"R zero", "R", "0 < R <= 1", {{"R_b", 1.0}, {"R", 0.0}}},
      {"R and OCR", "R", "instead of", {{"R_b", 1.0}, {"R", 0.5}, {"OCR", 2.0}}},
      {"beta a number", "beta", "isotropic", {{"R_b", 1.0}, {"OCR", 1.5}, {"beta", 0.1}}},
      {"beta another word", "beta", "isotropic", {{"R_b", 1.0}, {"OCR", 1.5}, {"beta", "k0"}}},
      {"beta not deviatoric", "beta", "deviatoric", {{"R_b", 1.0}, {"OCR", 1.5}, {"beta", List{.1, 0, 0, 0, 0, 0}}}},
      {"beta too short", "beta", "6 components", {{"R_b", 1.0}, {"OCR", 1.5}, {"beta", List{.1, -.1, 0}}}},
      {"beta out of plane", "beta", "6 components", {{"R_b", 1.0}, {"OCR", 1.5}, {"beta", List{0, 0, 0, 0, .1, 0}}}},
      {"a share of one", "a", "0 <= a < 1", {{"R_b", 1.0}, {"OCR", 1.5}, {"a", 1.0}}},
      {"a negative", "a", "0 <= a < 1", {{"R_b", 1.0}, {"OCR", 1.5}, {"a", -0.1}}},
      {"a word", "a", "6 numbers", {{"R_b", 1.0}, {"OCR", 1.5}, {"a", "middle"}}},
      {"a outside", "a", "inside the yield surface", {{"R_b", 1.0}, {"OCR", 1.5}, {"a", List{500, 500, 500, 0, 0, 0}}}},
  };
  for (const auto& complaint : all) expect_complaint(complaint, ground);
  expect_complaint({"no stiffness", "p_e", "p + p_e > 0", {{"R_b", 1.0}, {"p_c", 100.0}}}, Sym<double, 4>::zero(), 0);
}

TEST(InitialState, ThreeDimensionsTakeSixComponents) {
  std::vector<Problem> problems;
  const auto model = subloading(full_constants());
  const Sym<double, 6> sigma{{60, 60, 100, 0, 0, 0}};
  model.initial_state<6>(sigma, 100, {{"R_b", 1.0}, {"OCR", 1.5}, {"beta", std::vector<double>{-.05, -.05, .1, 0}}},
                         problems);
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_EQ(problems[0].key, "beta");
}

}  // namespace
}  // namespace scarp::test
