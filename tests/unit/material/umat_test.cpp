// Models from shared libraries: UMATs of our own in C and Fortran (tests/data/umat) give what the same law gives when
// it is built in, get what docs/models/umat.md says, and their mistakes are reported.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "umats.hpp"

namespace scarp::test {
namespace {

/// The largest difference between the built-in elastic law and an elastic UMAT along 200 random increments, of the
/// stress.
template <int N>
double elastic_difference(const std::string& name) {
  const auto model = umat(name, {2e4, 0.3});
  const LinearElastic built_in({2e4, 0.3});
  auto s = start<N>(model, some_stress<N>());
  LinearElastic::State<double, N> t{some_stress<N>()};
  std::mt19937 generator(1);
  double worst = 0;
  for (int i = 0; i < 200; ++i) {
    const auto deps = random_tensor<N>(generator, 1e-3);
    const Rotation<double, N> turn(Spin<double, N>{{0.01}});
    rotate(model, s, turn);
    rotate(built_in, t, turn);
    EXPECT_EQ((integrate<DormandPrince>(model, s, deps, {1e-8, 1e-7}).end), IntegrationEnd::done);
    integrate<DormandPrince>(built_in, t, deps, {1e-8, 1e-7});
    worst = std::max(worst, norm(s.sigma - t.sigma) / norm(t.sigma));
    EXPECT_NEAR(model.p_wave_modulus(s) / built_in.p_wave_modulus(t), 1, 1e-14);
  }
  return worst;
}

// Band: rounding of 200 additions.
TEST(Umat, ElasticInCIsTheBuiltInLaw) {
  EXPECT_LT(elastic_difference<4>("elastic_c"), 1e-12);
  EXPECT_LT(elastic_difference<6>("elastic_c"), 1e-12);
}

std::vector<Record> four_scalars() {
  return {variable("kinc"), variable("clock"), variable("stran22"), variable("letter")};
}

TEST(Umat, GetsTimeIncrementStrainAndName) {
  const auto model = umat("elastic_c", {2e4, 0.3, 5, -1}, four_scalars(), {{"cmname", "CLAY"}});
  auto s = start<6>(model, some_stress<6>());
  for (int i = 0; i < 3; ++i) {
    const Increment<double, 6> step{Sym<double, 6>{{1e-5, 2e-5, 3e-5, 4e-5, 5e-5, 6e-5}}, 0.25};
    EXPECT_EQ((integrate<ModifiedEuler>(model, s, step, {1e-4, 1e-7}).end), IntegrationEnd::done);
  }
  EXPECT_EQ(s.values[0], 3);
  EXPECT_DOUBLE_EQ(s.values[1], 0.75);
  EXPECT_DOUBLE_EQ(s.values[2], -6e-5);  // tension positive
  EXPECT_EQ(s.values[3], 'C');
  EXPECT_DOUBLE_EQ(s.strain[4], 15e-5);
}

// An isotropic law cannot tell 13 from 23: here the routine shows what it got in its own order. scarp's is xy, yz, zx.
TEST(Umat, GetsComponentsInTheOrderOfAbaqus) {
  auto state = four_scalars();
  state.push_back(variable("fifth"));
  state.push_back(variable("tensor", "tensor"));   // STATEV(6..11): 13 is STATEV(10)
  state.push_back(variable("strains", "strain"));  // STATEV(12..17): 13 is STATEV(16)
  const auto model = umat("elastic_c", {2e4, 0.3, 6, -1}, state);
  const std::vector<double> list{.1, .2, .3, .4, .5, .6};
  auto s = start<6>(model, to_mandel<6>({50, 60, 70, 1, 2, 3}), {{"tensor", list}, {"strains", list}});
  s = attempt<ModifiedEuler>(model, s, to_mandel<6>({1e-5, 2e-5, 3e-5, 4e-5, 5e-5, 6e-5}), 1e-4).state;
  EXPECT_DOUBLE_EQ(s.values[0], -2 * 6e-5);
  EXPECT_DOUBLE_EQ(s.values[1], -2 * 5e-5);
  EXPECT_DOUBLE_EQ(s.values[2], -(3 + 2e4 / 1.3 * 6e-5));
  EXPECT_DOUBLE_EQ(s.values[3], 0.6);
  EXPECT_DOUBLE_EQ(s.values[4], 2 * 0.6);
}

// A UMAT that takes time into account is called where time passes without strain.
TEST(Umat, TimeAloneIsAnIncrement) {
  const auto model = umat("elastic_c", {2e4, 0.3});
  auto s = start<4>(model, some_stress<4>());
  integrate<ModifiedEuler>(model, s, Increment<double, 4>{Sym<double, 4>::zero(), 2.0}, {1e-4, 1e-7});
  EXPECT_EQ(s.time, 2);
  EXPECT_EQ(s.increments, 1);
}

// PNEWDT < 1 where |Δε22| > 1e-4: ten times that is cut until it is small enough, with the same answer.
TEST(Umat, PnewdtMakesSubsteps) {
  const auto model = umat("elastic_c", {2e4, 0.3, 4, -1});
  auto s = start<4>(model, some_stress<4>());
  const Sym<double, 4> deps{{0, 1e-3, 0, 0}};
  const auto report = integrate<ModifiedEuler>(model, s, deps, {1e-4, 1e-7});
  EXPECT_EQ(report.end, IntegrationEnd::done);
  EXPECT_GE(report.substeps, 10);
  EXPECT_NEAR(s.sigma[1], 100 + 1e-3 * LinearElastic({2e4, 0.3}).p_wave_modulus(LinearElastic::State<double, 4>{}),
              1e-11);
}

TEST(Umat, NanIsNotTakenAndSaidOnce) {
  const auto model = umat("elastic_c", {2e4, 0.3, 1, -1}, {}, {{"cmname", "CLAY"}});
  auto s = start<4>(model, some_stress<4>());
  const auto before = s.sigma.c;
  testing::internal::CaptureStderr();
  const auto report = integrate<ModifiedEuler>(model, s, Sym<double, 4>{{0, 1e-3, 0, 0}}, {1e-4, 1e-3});
  const auto text = testing::internal::GetCapturedStderr();
  EXPECT_EQ(report.end, IntegrationEnd::unstable);
  EXPECT_EQ(s.sigma.c, before);
  EXPECT_NE(text.find("the UMAT of the material CLAY"), std::string::npos) << text;
  EXPECT_NE(text.find("STRESS(2) = nan"), std::string::npos) << text;
  EXPECT_EQ(text.find("STRESS(2)"), text.rfind("STRESS(2)")) << text;
}

TEST(Umat, XitIsAnErrorThatNamesTheMaterial) {
  const auto text = error_of(umat("elastic_c", {2e4, 0.3, 2, -1}, {}, {{"cmname", "CLAY"}}));
  EXPECT_NE(text.find("the UMAT of the material CLAY"), std::string::npos) << text;
  EXPECT_NE(text.find("elastic_c.so) ends the analysis; found it called XIT"), std::string::npos) << text;
}

TEST(Umat, WritingBeyondTheDeclaredStateIsAnError) {
  const auto text = error_of(umat("elastic_c", {2e4, 0.3, 3, -1}, {variable("one"), variable("beta", "tensor")}));
  EXPECT_NE(text.find("writes beyond its state; found STATEV(6) = 1, with NSTATV = 5"), std::string::npos) << text;
  EXPECT_NE(text.find("list every variable of STATEV"), std::string::npos) << text;
}

TEST(Umat, AConstantTooFewShowsAtTheStart) {
  const auto problem = problem_of(umat("elastic_c", {2e4}));
  EXPECT_NE(problem.what.find("does not take the initial state"), std::string::npos) << problem.what;
  EXPECT_NE(problem.value.find("= nan"), std::string::npos) << problem.value;
  EXPECT_NE(problem.remedy.find("NPROPS = 1"), std::string::npos) << problem.remedy;
}

TEST(Umat, NoStiffnessNeedsAWaveModulus) {
  EXPECT_EQ(problem_of(umat("elastic_c", {0, 0.3})).key, "wave_modulus");
  Values settings{{"library", library("elastic_c")}, {"constants", std::vector<double>{0, 0.3}}};
  const auto model = std::get<Umat>(made("umat", {{"wave_modulus", 3e4}}, settings));
  EXPECT_EQ(model.p_wave_modulus(start<4>(model, some_stress<4>())), 3e4);
}

TEST(Umat, InitialValuesAreByName) {
  const auto model = umat("elastic_c", {2e4, 0.3},
                          {variable("p_c"),
                           variable("beta", "tensor"),
                           {{{"name", "gamma"}, {"kind", "strain"}, {"initial", std::vector<double>{1, 2, 3, 4}}}}});
  EXPECT_EQ(model.statev_size<4>(), 9);
  EXPECT_EQ(model.statev_size<6>(), 13);
  const auto s = start<4>(model, some_stress<4>(), {{"p_c", 80.0}, {"beta", std::vector<double>{.1, .2, .3, .4}}});
  EXPECT_EQ(s.values[0], 80);
  EXPECT_EQ(s.values[2], 0.2);
  EXPECT_DOUBLE_EQ(s.values[4], 0.4 * sqrt2);
  EXPECT_DOUBLE_EQ(s.values[8], 4 * sqrt2);
  EXPECT_EQ(problem_of(model, {{"beta", 3.0}}).key, "beta");
  EXPECT_EQ(problem_of(model, {{"p_c", "big"}}).key, "p_c");
  const auto description = description_of(model);
  EXPECT_EQ(description.state.back().key, "gamma");
  EXPECT_EQ(description.initial.size(), 3u);
}

// Refused when the model is made: key, a part of what, value and remedy.
TEST(Umat, KeysThatAreRefused) {
  const auto expect = [](const std::string& key, const Value& value, const Problem& expected) {
    auto settings = sample("umat").settings;
    settings[key] = value;
    const auto problems = make_model("umat", {}, settings).problems;
    ASSERT_FALSE(problems.empty()) << expected.what;
    EXPECT_EQ(problems[0].key, expected.key);
    EXPECT_NE(problems[0].what.find(expected.what), std::string::npos) << problems[0].what;
    EXPECT_NE(problems[0].value.find(expected.value), std::string::npos) << problems[0].value;
    EXPECT_NE(problems[0].remedy.find(expected.remedy), std::string::npos) << problems[0].remedy;
  };
  expect("library", "nowhere.so", {"library", "is not there", "nowhere.so", "from the folder of the case file"});
  expect("library", __FILE__, {"library", "cannot be loaded", "umat_test.cpp", "-shared -fPIC"});
  expect("library", library("no_umat"), {"symbol", "no such routine", "none of umat_, umat, UMAT", "nm -D"});
  expect("symbol", "vumat", {"symbol", "no such routine", "none of vumat, vumat_", "symbol = "});
  expect("calls", "both", {"calls", "calls is", "\"both\"", "serial"});
  expect("cmname", std::string(81, 'A'), {"cmname", "at most 80", "81", "shorten"});
  using Records = std::vector<Record>;
  expect("state", Records{{}}, {"state", "state[0]: a variable has a name", "", "name ="});
  expect("state", Records{variable("a"), variable("a")}, {"state", "state[1]: each", "\"a\" twice", "rename"});
  expect("state", Records{variable("stress")}, {"state", "an output of scarp", "stress", "another"});
  expect("state", Records{variable("a b")}, {"state", "letters, digits", "a b", "name ="});
  expect("state", Records{variable("a", "vector")}, {"state", "kind is", "vector", "kind ="});
  expect("state", Records{{{{"name", "a"}, {"sort", "b"}}}}, {"state", "has the keys name", "sort", "name ="});
  expect("state", Records{{{{"name", "a"}, {"initial", "b"}}}}, {"state", "is a number", "", "a number"});
  Records many;
  for (int i = 0; i < 11; ++i) many.push_back(variable(std::string(1, static_cast<char>('a' + i)), "tensor"));
  expect("state", many, {"state", "at most 64", "66 (NSTATV = 44 in plane strain)", "most_statev"});
}

#ifdef SCARP_FORTRAN_UMATS
TEST(Umat, ElasticInFortranIsTheBuiltInLaw) {
  EXPECT_LT(elastic_difference<4>("elastic_f"), 1e-12);
  EXPECT_LT(elastic_difference<6>("elastic_f"), 1e-12);
}

Umat kinematic() {
  return umat("kinematic_f", {2e4, 0.3, 50, 3e3},
              {variable("alpha", "tensor"), variable("epsp", "strain"), variable("epsp_q")});
}

// Its own XIT-like message, through Fortran's hidden lengths of texts.
TEST(Umat, WrongNumberOfStateVariablesIsTheRoutinesOwnComplaint) {
  const auto problem = problem_of(umat("kinematic_f", {2e4, 0.3, 50, 3e3}, {variable("alpha", "tensor")}));
  EXPECT_NE(problem.what.find("ends the analysis"), std::string::npos) << problem.what;
  EXPECT_EQ(problem.value, "the state takes 9 values, not 4");
}

// Uniaxial strain from an isotropic state, tension positive. Closed form of von Mises with Prager's hardening: elastic
// up to 2G ε = σ_y, and from there q grows with 2G H / (2G + 2H/3) × 2/3 ... in terms of ε_p (lateral −ε_p/2): q = 2G
// (ε − 3/2 ε_p) = σ_y + H ε_p, so ε_p = (2G ε − σ_y) / (3G + H).
TEST(Umat, KinematicHardeningHasItsClosedForm) {
  const auto model = kinematic();
  const double G = 2e4 / 2.6, K = 2e4 / 1.2, e = 0.01;
  auto s = start<6>(model, Sym<double, 6>::zero());
  for (int i = 0; i < 7; ++i) integrate<ModifiedEuler>(model, s, Sym<double, 6>{{0, e / 7, 0, 0, 0, 0}}, {1e-4, 1e-7});
  const double ep = (2 * G * e - 50) / (3 * G + 3e3);
  EXPECT_NEAR(deviatoric_stress(s.sigma), 50 + 3e3 * ep, 1e-10);
  EXPECT_NEAR(mean(s.sigma), K * e, 1e-10);
  EXPECT_NEAR(s.values[1], -2.0 / 3 * 3e3 * ep, 1e-10);  // alpha_yy, signs of the UMAT
  EXPECT_NEAR(s.values[7], -ep, 1e-14);                  // epsp_yy
  EXPECT_NEAR(s.values[12], ep, 1e-14);
}

template <int N>
std::vector<double> components(const Umat::State<double, N>& s) {
  std::vector<double> all;
  for_each_component([&](const double& x) { all.push_back(x); }, s);
  return all;
}

/// Largest difference between turning the state first and straining in turned directions, and straining first.
template <int N>
double turned_difference(const Spin<double, N>& spin, const Umat& model = kinematic()) {
  const Rotation<double, N> q(spin);
  auto s = start<N>(model, Sym<double, N>::zero()), turned = s;
  std::mt19937 generator(2);
  double worst = 0;
  for (int i = 0; i < 20; ++i) {
    const auto deps = random_tensor<N>(generator, 5e-3);
    rotate(model, turned, q);
    s = attempt<ModifiedEuler>(model, s, deps, 1e-4).state;
    auto b = s;
    rotate(model, b, q);
    auto a = attempt<ModifiedEuler>(model, turned, q(deps), 1e-4).state;
    const auto x = components<N>(a), y = components<N>(b);
    for (std::size_t c = 0; c < x.size(); ++c) worst = std::max(worst, std::abs(x[c] - y[c]) / norm(s.sigma));
    turned = s;
  }
  EXPECT_GT(s.values[static_cast<std::size_t>(2 * N)], 0.01);  // plastic straining
  EXPECT_GT(std::abs(s.values[0]), 1);                         // and a back stress that matters
  return worst;
}

// Superposed rotation: a tensor of the state that stayed behind, or turned in the wrong order of components or with the
// wrong factor of its shear, would show here. Band: rounding of the rotation of some 200 kPa.
TEST(Umat, TensorStateTurnsWithTheBody) {
  EXPECT_LT(turned_difference<4>({{0.7}}), 1e-13);
  EXPECT_LT(turned_difference<6>({{0.7, -0.3, 1.1}}), 1e-13);
}

// The test above can fail: the same numbers declared as scalars stay behind.
TEST(Umat, ScalarsDoNotTurn) {
  std::vector<Record> scalars;
  for (char name = 'a'; name <= 'i'; ++name) scalars.push_back(variable(std::string(1, name)));
  EXPECT_GT(turned_difference<4>({{0.7}}, umat("kinematic_f", {2e4, 0.3, 50, 3e3}, scalars)), 1e-3);
}

// A full turn in 1000 parts under no strain brings all back; half a turn about z changes the sign of zx and yz only.
TEST(Umat, HalfATurnIsKnown) {
  const auto model = kinematic();
  auto s = start<6>(model, Sym<double, 6>::zero());
  s = attempt<ModifiedEuler>(model, s, Sym<double, 6>{{.01, -.02, .005, .01, -.02, .03}}, 1e-4).state;
  auto t = s;
  const double angle = 2 * std::tan(std::numbers::pi / 2 / 1000);  // the Cayley transform turns by 2 atan(w/2)
  for (int i = 0; i < 1000; ++i) rotate(model, t, Rotation<double, 6>(Spin<double, 6>{{angle, 0, 0}}));
  for (std::size_t c = 0; c < 13; ++c) {
    const double sign = c % 6 == 4 || c % 6 == 5 ? -1 : 1;
    EXPECT_NEAR(t.values[c], sign * s.values[c], 1e-10) << c;
  }
}

TEST(Umat, PlaneStrainIsThreeDimensionsAndTheBatchIsDouble) {
  const auto model = kinematic();
  auto s4 = start<4>(model, Sym<double, 4>::zero());
  auto s6 = start<6>(model, Sym<double, 6>::zero());
  Umat::State<Batch, 4> many;
  for_each_component([](Batch& b, const double& x) { b = Batch(x); }, many, s4);
  std::mt19937 generator(3);
  for (int i = 0; i < 20; ++i) {
    const auto deps = random_tensor<4>(generator, 2e-3);
    const Sym<double, 6> deps6{{deps[0], deps[1], deps[2], deps[3], 0, 0}};
    Increment<Batch, 4> wide{{}, Batch(0.0)};
    for (int c = 0; c < 4; ++c) wide.deps[c] = Batch(deps[c]);
    s4 = attempt<ModifiedEuler>(model, s4, deps, 1e-4).state;
    s6 = attempt<ModifiedEuler>(model, s6, deps6, 1e-4).state;
    many = attempt<ModifiedEuler>(model, many, wide, 1e-4).state;
  }
  for (int c = 0; c < 4; ++c) EXPECT_NEAR(s4.sigma[c], s6.sigma[c], 1e-12 * norm(s4.sigma));
  for (std::size_t c = 0; c < 4; ++c) EXPECT_NEAR(s4.values[c], s6.values[c], 1e-12 * norm(s4.sigma));
  EXPECT_NEAR(s4.values[8], s6.values[12], 1e-12);
  for_each_component([](const double& x, const Batch& b) { EXPECT_EQ(b.get(batch_lanes - 1), x); }, s4, many);
}
#endif

}  // namespace
}  // namespace scarp::test
