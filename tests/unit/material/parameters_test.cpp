// make_model: what each model declares of its constants is what it takes.
#include <gtest/gtest.h>
#include <algorithm>
#include <limits>
#include <set>

#include "material/samples.hpp"

namespace scarp::test {
namespace {

bool names(const std::vector<Problem>& problems, const std::string& key) {
  return std::any_of(problems.begin(), problems.end(), [&](const Problem& p) { return p.key == key; });
}

/// Expects `value` for `key` to be refused under that key, with a reason and a remedy.
void expect_refused(const ModelDescription& model, const std::string& key, double value) {
  auto constants = sample(model.name).constants;
  constants[key] = value;
  const auto result = make_model(model.name, constants, sample(model.name).settings);
  EXPECT_FALSE(result.model) << model.name << ' ' << key << " = " << value;
  ASSERT_TRUE(names(result.problems, key)) << model.name << ' ' << key << " = " << value;
  EXPECT_FALSE(result.problems.front().what.empty());
  EXPECT_FALSE(result.problems.front().remedy.empty());
}

/// Expects no complaint about the bounds of `key`; what holds between constants may still be violated.
void expect_within_bounds(const ModelDescription& model, const std::string& key, double value) {
  auto constants = sample(model.name).constants;
  constants[key] = value;
  for (const auto& problem : make_model(model.name, constants, sample(model.name).settings).problems)
    EXPECT_EQ(problem.what.find("must satisfy"), std::string::npos) << key << " = " << value << ": " << problem.what;
}

TEST(Parameters, SamplesAreValid) {
  for (const auto& model : model_descriptions()) {
    const auto result = make_model(model.name, sample(model.name).constants, sample(model.name).settings);
    EXPECT_TRUE(result.model) << model.name;
    EXPECT_TRUE(result.problems.empty());
    EXPECT_TRUE(result.warnings.empty());
  }
}

TEST(Parameters, BoundsAreThoseDeclared) {
  for (const auto& model : model_descriptions()) {
    for (const auto& info : model.parameters) {
      const double inf = std::numeric_limits<double>::infinity();
      for (double bad : {inf, -inf, std::numeric_limits<double>::quiet_NaN()}) expect_refused(model, info.key, bad);
      if (info.low) {
        expect_refused(model, info.key, std::nextafter(info.low->value, -inf));
        if (info.low->open) expect_refused(model, info.key, info.low->value);
        expect_within_bounds(model, info.key, info.low->open ? std::nextafter(info.low->value, inf) : info.low->value);
      }
      if (info.high) {
        expect_refused(model, info.key, std::nextafter(info.high->value, inf));
        if (info.high->open) expect_refused(model, info.key, info.high->value);
        expect_within_bounds(model, info.key,
                             info.high->open ? std::nextafter(info.high->value, -inf) : info.high->value);
      }
    }
  }
}

// The bounds that constitutive.md lists, key by key: a bound left out of the declaration shows here.
TEST(Parameters, BoundsOfTheSubloadingModel) {
  const auto model = Subloading::description();
  for (const char* positive : {"kappa", "lambda", "M", "M_c", "alpha", "c_R", "p_atm", "R_min"}) {
    expect_refused(model, positive, 0);
    expect_refused(model, positive, -1);
  }
  for (const char* from_zero : {"nu", "p_e", "xi", "c_beta", "c_b", "c_a", "delta", "p_c_floor"}) {
    expect_refused(model, from_zero, -1e-9);
    expect_within_bounds(model, from_zero, 0);
  }
  expect_refused(model, "nu", 0.5);
  expect_refused(model, "xi", 0.5);
  expect_refused(model, "k", 0.5);
  expect_refused(model, "k", 1.01);
  expect_refused(model, "R_bf", 0.99);
  expect_refused(model, "R_min", 1);
  expect_refused(model, "delta", 1);
}

TEST(Parameters, KappaIsLessThanLambda) {
  auto constants = full_constants();
  constants["kappa"] = constants["lambda"];
  const auto result = make_model("subloading", constants);
  EXPECT_FALSE(result.model);
  EXPECT_TRUE(names(result.problems, "kappa"));
}

TEST(Parameters, AClampedAnisotropicLimitIsAWarning) {
  auto constants = full_constants();
  constants["M"] = 0.9;  // k M_c = 0.857
  const auto result = make_model("subloading", constants);
  EXPECT_TRUE(result.model);
  EXPECT_TRUE(names(result.warnings, "M"));
}

TEST(Parameters, WithoutAStandardValueAKeyIsRequired) {
  for (const auto& model : model_descriptions()) {
    for (const auto& info : model.parameters) {
      auto constants = sample(model.name).constants;
      // A residual strength that is given needs the strain that it is reached at, standard value or not.
      for (const auto& other : model.parameters)
        if (!other.standard_key.empty()) constants.erase(other.key);
      constants.erase(info.key);
      const bool standard = info.standard || !info.standard_key.empty();
      const auto result = make_model(model.name, constants, sample(model.name).settings);
      EXPECT_EQ(result.model.has_value(), standard) << info.key;
      EXPECT_EQ(names(result.problems, info.key), !standard) << info.key;
    }
  }
}

// No soil constant is invented: a standard value is numerical, or leaves a feature out (no softening, no cut-off before
// the apex; soil at residual strength shears at constant volume).
TEST(Parameters, OnlyNumericalConstantsAndFeaturesLeftOutHaveStandardValues) {
  const std::set<std::string> features{"epsp_residual", "tension", "psi_residual"};
  for (const auto& model : model_descriptions())
    for (const auto& info : model.parameters)
      EXPECT_TRUE(!info.standard || features.contains(info.key) || info.meaning.starts_with("numerical")) << info.key;
}

TEST(Parameters, StandardValueOfAnotherConstant) {
  const auto result = make_model("tresca", {{"E", 1e4}, {"nu", 0.4}, {"s_u", 30}});
  ASSERT_TRUE(result.model);
  EXPECT_EQ(std::get<Tresca>(*result.model).parameters().s_u.residual, 30);
  for (const auto& model : model_descriptions())
    for (const auto& info : model.parameters) {
      if (info.standard_key.empty()) continue;
      EXPECT_FALSE(info.standard) << info.key;
      EXPECT_TRUE(std::any_of(model.parameters.begin(), model.parameters.end(), [&](const auto& other) {
        return other.key == info.standard_key && other.standard_key.empty();
      })) << info.key;
    }
}

TEST(Parameters, UnknownNamesAreProblems) {
  auto constants = full_constants();
  constants["kapa"] = 0.01;
  EXPECT_TRUE(names(make_model("subloading", constants).problems, "kapa"));
  const auto result = make_model("subloding", full_constants());
  ASSERT_TRUE(names(result.problems, "model"));
  EXPECT_NE(result.problems.front().remedy.find("subloading"), std::string::npos);
}

/// Expects `key` to be refused under its name, with a part of the reason and of the value found.
void expect_setting_refused(const std::string& model, const std::map<std::string, double>& constants,
                            const Values& settings, const Problem& expected) {
  const auto result = make_model(model, constants, settings);
  EXPECT_FALSE(result.model) << expected.key;
  ASSERT_FALSE(result.problems.empty());
  const auto& problem = result.problems.front();
  EXPECT_EQ(problem.key, expected.key);
  EXPECT_NE(problem.what.find(expected.what), std::string::npos) << problem.what;
  EXPECT_NE(problem.value.find(expected.value), std::string::npos) << problem.value;
  EXPECT_NE(problem.remedy.find(expected.remedy), std::string::npos) << problem.remedy;
}

TEST(Parameters, SettingsHaveTheirKind) {
  auto some = sample("umat").settings;
  some["library"] = 3.0;
  expect_setting_refused("umat", {}, some, {"library", "library is a text", "the number 3", "library: "});
  some = sample("umat").settings;
  some["constants"] = "1, 2";
  expect_setting_refused("umat", {}, some, {"constants", "is a list of numbers", "the text \"1, 2\"", "PROPS"});
  expect_setting_refused("umat", {}, {}, {"library", "is missing", "", "add library = ..., a text"});
  expect_setting_refused("umat", {{"library", 3}}, {}, {"library", "library is a text", "the number 3", "library: "});
}

TEST(Parameters, ATextForANumberIsRefused) {
  auto constants = full_constants();
  constants.erase("nu");
  const auto problems = make_model("subloading", constants, {{"nu", "0.3"}, {"file", "a"}}).problems;
  EXPECT_TRUE(names(problems, "nu") && names(problems, "file"));
  const auto at =
      std::find_if(problems.begin(), problems.end(), [](const Problem& p) { return p.value == "the text \"0.3\""; });
  ASSERT_NE(at, problems.end());
  EXPECT_EQ(at->what, "nu is a number");
}

TEST(Parameters, EveryProblemIsNamedAtOnce) {
  auto constants = full_constants();
  constants["kappa"] = -1;
  constants["nu"] = 0.7;
  constants.erase("M");
  const auto problems = make_model("subloading", constants).problems;
  EXPECT_TRUE(names(problems, "kappa") && names(problems, "nu") && names(problems, "M"));
}

}  // namespace
}  // namespace scarp::test
