// Laboratory tests as files: what a good one says, and what is refused where.
#include "scarp/input/lab_test.hpp"

#include "refusal.hpp"
#include "scarp/input/csv.hpp"

namespace scarp::input::test {
namespace {

const std::string good = R"([material]
model = "subloading"
kappa = 0.02
lambda = 0.12
nu = 0.3
p_e = 5.0
M = 1.0
M_c = 1.3
k = 0.78
alpha = 1.0
xi = 0.01
c_R = 60.0
c_beta = 5.0
c_b = 20.0
R_bf = 1.0
c_a = 3.0
p_atm = 101.325

[initial]
stress = [60.0, 60.0, 100.0, 0.0, 0.0, 0.0]
p_c = 250.0
R_b = 3.0
beta = [0.0, 0.0, 0.0, 0.0, 0.0, 0.0]
a = 0.5

[integration]
tolerance = 1e-9
scheme = "modified-euler"

[[stage]]
type = "oedometer"
sig_a = 300.0
increments = 7

[[stage]]
type = "simple-shear"
drained = false
gamma = [0.01, -0.02]
cycles = 3
stop = { u = 50.0 }

[[stage]]
type = "constraints"
E = [[1, 0, 0, 0, 0, 0], [0, 1, 0, 0, 0, 0], [0, 0, 1, 0, 0, 0], [0, 0, 0, 1, 0, 0], [0, 0, 0, 0, 1, 0], [0, 0, 0, 0, 0, 0]]
S = [[0, 0, 0, 0, 0, 0], [0, 0, 0, 0, 0, 0], [0, 0, 0, 0, 0, 0], [0, 0, 0, 0, 0, 0], [0, 0, 0, 0, 0, 0], [0, 0, 0, 0, 0, 1]]
b = [0.0, 0.0, 0.001, 0.0, 0.0, 3.0]
increments = 2
duration = 10.0
)";

LabTest read_lab(const std::string& text, const std::vector<std::string>& overrides = {}) {
  const CaseFile file(text);
  return read_lab_test(file.path(), overrides);
}

TEST(LabTests, AGoodOne) {
  const auto input = read_lab(good);
  const auto& test = input.test;
  EXPECT_EQ(test.stress, (lab::Six{60, 60, 100, 0, 0, 0}));
  EXPECT_EQ(test.tolerance, 1e-9);
  EXPECT_EQ(test.scheme, lab::Scheme::modified_euler);
  EXPECT_EQ(std::get<Subloading>(test.model).parameters().R_min, 0.01);
  ASSERT_EQ(test.stages.size(), 3u);
  EXPECT_EQ(test.stages[0].increments, 7);
  const auto& oedometer = std::get<lab::Constraints>(test.stages[0].path);
  EXPECT_EQ(oedometer.targets, std::vector<double>{300});
  EXPECT_EQ(oedometer.forms[5].S, (lab::Six{0, 0, 1, 0, 0, 0}));
  EXPECT_FALSE(oedometer.from_start || oedometer.cell);
  const auto& shear = std::get<lab::Constraints>(test.stages[1].path);
  EXPECT_EQ(shear.targets, (std::vector<double>{0.01, -0.02, 0.01, -0.02, 0.01, -0.02}));
  EXPECT_EQ(shear.cell, std::size_t{2});
  ASSERT_EQ(test.stages[1].stops.size(), 1u);
  EXPECT_EQ(test.stages[1].stops[0].column, "u");
  const auto& set = std::get<lab::Constraints>(test.stages[2].path);
  EXPECT_TRUE(set.targets.empty());
  EXPECT_EQ(set.b[5], 3);
  EXPECT_EQ(test.stages[2].duration, 10);
  EXPECT_EQ(read_lab(good, {"material.c_b=7", "stage.0.sig_a=200"}).test.stages.size(), 3u);
}

TEST(LabTests, BadOnes) {
  const std::vector<Bad> all{
      {"kappa = 0.02", "kappa = 0.02\n@kapa = 0.02", "no constant kapa", "0.02", "scarp models"},
      {"kappa = 0.02", "@kappa = 0.2", "kappa is less than lambda", "0.2", "elastic slope"},
      {"[initial]\n", "[initial]\n@p_d = 3.0\n", "no initial value p_d", "3", "did you mean p_c?"},
      {"p_c = 250.0", "@p_c = 50.0", "R <= 1", "", "enlarge p_c"},
      {"stress = [60.0, 60.0, 100.0, 0.0, 0.0, 0.0]", "@stress = [60.0, 60.0, 100.0]", "stress is a list of 6 numbers",
       "3 items", "commas"},
      {"tolerance = 1e-9", "@tolerance = 0.5", "tolerance must satisfy", "0.5", "bounds"},
      {"\"modified-euler\"", "\"euler\"", "scheme is", "euler", "dormand-prince", "scheme"},
      {"\"oedometer\"", "\"odometer\"", "no such type of stage", "odometer", "oedometer", "type = \"odometer\""},
      {"sig_a = 300.0\n", "", "needs what drives it", "", "eps_a, sig_a", "[[stage]]"},
      {"sig_a = 300.0", "eps_a = 0.1\n@sig_a = 300.0", "one quantity drives", "eps_a", "remove one"},
      {"cycles = 3\n", "", "two limits of gamma", "no cycles", "cycles", "gamma"},
      {"gamma = [0.01, -0.02]", "@gamma = 0.01", "has its two limits", "0.01", "gamma = ["},
      {"stop = { u = 50.0 }", "stop = { @w = 50.0 }", "a column of the curve", "w", "sig_xx"},
      {"increments = 7", "@increments = 0", "increments", "0", "bounds"},
      {"b = [0.0, 0.0, 0.001, 0.0, 0.0, 3.0]", "@b = [0.0]", "b is a list of 6 numbers", "1 item", "commas"},
      {"[0, 0, 0, 0, 0, 0], [0, 0, 0, 0, 0, 1]]", "[0, 0, 0, 0, 0, 0], [0, 0, 0, 0, 0, 0]]", "says something", "row 6",
       "give it a strain or a stress", "[0, 0, 0, 0, 0, 0]]\nS"},
      {"duration = 10.0", "@duration = -1.0", "duration must satisfy", "-1", "bounds"},
  };
  for (const auto& bad : all) expect_refused(good, bad, [](const std::string& path) { read_lab_test(path); });
}

TEST(LabTests, DependentConstraintsAreRefused) {
  const auto text = replaced(good, "[0, 1, 0, 0, 0, 0], [0, 0, 1", "[2, 0, 0, 0, 0, 0], [0, 0, 1");
  try {
    read_lab(text);
    ADD_FAILURE() << "no error";
  } catch (const InputError& error) {
    EXPECT_NE(error.problem().find("independent"), std::string::npos) << error.what();
  }
}

/// Columns a and b of a CSV text.
std::vector<std::vector<double>> columns(const std::string& text) {
  const CaseFile file(text);
  return read_columns(file.path(), {"a", "b"});
}

TEST(Csv, ColumnsByNameOrInOrder) {
  const std::vector<std::vector<double>> expected{{1, 2}, {-3.5e-2, 4}};
  EXPECT_EQ(columns("a,b\n1,2\n-3.5e-2,4\n"), expected);
  EXPECT_EQ(columns("x, b ,a\n9,2,1\n# comment\n\n9,+4,-0.035"), expected);
  EXPECT_EQ(columns("1,2\r\n-3.5e-2,4\r\n"), expected);
}

TEST(Csv, WhatIsNoNumberIsRefusedAtItsPlace) {
  struct Bad {
    std::string text, problem;
    int line, column;
  };
  const std::vector<Bad> all{{"a,b\n1,2\n3,x\n", "finite number", 3, 3},
                             {"a,b\n1,nan\n", "finite number", 2, 3},
                             {"a,b\n1,2\n3\n", "as many values", 3, 0},
                             {"a,c\n1,2\n", "no column b", 1, 1},
                             {"a,b\n", "no rows", 0, 0},
                             {"", "no rows", 0, 0},
                             {"a,b\n1,1e999\n", "finite number", 2, 3}};
  for (const auto& bad : all) {
    SCOPED_TRACE(bad.text);
    try {
      columns(bad.text);
      ADD_FAILURE() << "no error";
    } catch (const InputError& error) {
      EXPECT_NE(error.problem().find(bad.problem), std::string::npos) << error.what();
      EXPECT_EQ(error.position().line, bad.line);
      EXPECT_EQ(error.position().column, bad.column);
      EXPECT_FALSE(error.remedy().empty());
    }
  }
}

}  // namespace
}  // namespace scarp::input::test
