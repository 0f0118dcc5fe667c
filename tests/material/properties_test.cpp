// Properties that hold at random states and increments (RapidCheck): nothing fails in silence. The seed is fixed, so
// that every run tests the same cases; RC_PARAMS="seed=... max_success=..." asks for others.
#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <cmath>
#include <cstdlib>

#include "samples.hpp"
#include "scarp/material/integrate/embedded.hpp"

namespace scarp::test {
namespace {

class Property : public testing::Test {
 protected:
  static void SetUpTestSuite() { setenv("RC_PARAMS", "seed=20160321 max_success=400", 0); }
};

/// A number within [low, high], from integers so that RapidCheck can shrink it.
double number(double low, double high) {
  return low + (high - low) * *rc::gen::inRange(0, 1000001) * 1e-6;
}

std::map<std::string, double> random_constants() {
  const double kappa = number(0.002, 0.05), M_c = number(0.7, 1.6), k = number(0.55, 1);
  return {{"kappa", kappa},
          {"lambda", kappa + number(0.01, 0.25)},
          {"nu", number(0, 0.45)},
          {"p_e", number(0.1, 20)},
          {"M", M_c * number(0.6, 1.1)},
          {"M_c", M_c},
          {"k", k},
          {"alpha", number(0.6, 1.5)},
          {"xi", number(0, 0.2)},
          {"c_R", number(1, 300)},
          {"c_beta", number(0, 30)},
          {"c_b", number(0, 30)},
          {"c_a", number(0, 30)},
          {"R_bf", number(1, 2)},
          {"p_atm", 101.325}};
}

Sym<double, 6> random_strain(double size) {
  Sym<double, 6> e;
  for (int i = 0; i < 6; ++i) e[i] = number(-size, size);
  return e;
}

Subloading::State<double, 6> random_start(const Subloading& model) {
  std::mt19937 generator(*rc::gen::arbitrary<unsigned>());
  return random_state<6>(generator, model);
}

bool finite(const Subloading::State<double, 6>& s) {
  bool all_finite = true;
  for_each_component([&](const double& x) { all_finite = all_finite && std::isfinite(x); }, s);
  return all_finite;
}

// What a step of the material point method may count on after every increment, done or not.
template <class Pair>
void stays_sound(double size, double tolerance) {
  const auto model = subloading(random_constants());
  auto s = random_start(model);
  const double floor = 0.01 * 101.325;
  for (int i = 0; i < 10; ++i) {
    const auto before = s;
    const auto report = integrate<Pair>(model, s, random_strain(size), {tolerance, 1e-4});
    RC_ASSERT(finite(s));
    RC_ASSERT(s.p_c >= floor);
    RC_ASSERT(s.R_b >= 1);
    RC_ASSERT(model.admissible(s));
    const double R = model.homothety(s).R;
    RC_ASSERT(R >= 0 && R <= 1 + tolerance);
    RC_ASSERT(std::abs(trace(s.beta)) < 1e-12);
    if (report.end != IntegrationEnd::done) {
      RC_ASSERT(report.reached < 1);  // never both
      if (report.reached == 0) RC_ASSERT(norm(s.sigma - before.sigma) == 0);
      return;
    }
    RC_ASSERT(report.reached == 1);
    RC_ASSERT(report.flags.sound);
  }
}

TEST_F(Property, SmallIncrementsLeaveASoundState) {
  EXPECT_TRUE(rc::check("increments of 1e-4", [] { stays_sound<ModifiedEuler>(1e-4, 1e-4); }));
}

TEST_F(Property, LargeIncrementsLeaveASoundState) {
  EXPECT_TRUE(rc::check("increments of 5e-3", [] { stays_sound<ModifiedEuler>(5e-3, 1e-4); }));
}

}  // namespace
}  // namespace scarp::test
