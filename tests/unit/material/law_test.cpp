// The rate form of the subloading law against its slow twin, and its consistency by dual numbers.
#include <gtest/gtest.h>
#include <cmath>

#include "material/dual.hpp"
#include "material/lanes.hpp"
#include "material/plain_law.hpp"
#include "material/samples.hpp"

namespace scarp::test {
namespace {

std::vector<Subloading> soils() {
  const auto full = full_constants();
  return {subloading(full), subloading(full, {{"alpha", 1.0}, {"xi", 0.2}, {"M", 1.1}}),
          subloading(full, {{"alpha", std::sqrt(2.0) + 1e-3}, {"k", 1.0}, {"R_bf", 1.5}}),
          subloading(full, {{"delta", 0.0}, {"c_a", 50}, {"c_beta", 80}, {"p_e", 30}}),
          subloading(cam_clay_constants())};
}

double difference(const Sym<double, 6>& a, const Matrix& b) {
  return norm(a - from_matrix<6>(b));
}

struct Case {
  Subloading model;
  Subloading::State<double, 6> state;
  Sym<double, 6> deps;
};

std::vector<Case> cases() {
  std::mt19937 generator(11);
  std::vector<Case> all;
  for (const auto& model : soils())
    for (int i = 0; i < 60; ++i)
      all.push_back({model, random_state<6>(generator, model), random_tensor<6>(generator, 1e-4)});
  return all;
}

TEST(Law, IsItsSlowTwin) {
  int plastic = 0, elastic = 0;
  for (const auto& [model, s, deps] : cases()) {
    const auto fast = model.rate(s, deps);
    const auto slow = plain_rate(model.parameters(), to_plain(s), to_matrix(deps));
    EXPECT_NEAR(model.homothety(s).R, slow.R, 1e-11);
    if (!fast.sound) continue;  // unstable softening: both multipliers mean nothing
    (slow.plastic ? plastic : elastic) += 1;
    // Bisection gives R to 1e-15 times the condition of the root; the stress is of size 1e-4 K.
    const double scale = std::max(norm(fast.change.sigma), 1e-2 * norm(from_matrix<6>(slow.sigma)));
    EXPECT_LT(difference(fast.change.sigma, slow.sigma), 1e-9 * scale);
    EXPECT_LT(difference(fast.change.a, slow.a), 1e-9 * (scale + norm(fast.change.a)));
    EXPECT_LT(difference(fast.change.epsp, slow.epsp), 1e-13);
    EXPECT_LT(difference(fast.change.beta, slow.beta), 1e-9 * (1e-4 + norm(fast.change.beta)));
    EXPECT_NEAR(fast.change.p_c, slow.p_c, 1e-9 * (scale + std::abs(slow.p_c)));
    EXPECT_NEAR(fast.change.R_b, slow.R_b, 1e-9 * (1e-4 + std::abs(slow.R_b)));
  }
  EXPECT_GT(plastic, 80);
  EXPECT_GT(elastic, 80);
}

TEST(Law, BothFormsOfTheHardeningModulusAgree) {
  for (const auto& [model, s, deps] : cases()) {
    const auto slow = plain_rate(model.parameters(), to_plain(s), to_matrix(deps));
    EXPECT_NEAR(slow.H_short, slow.H_long, 1e-9 * (std::abs(slow.H_long) + 1e2 * s.p_c * s.p_c));
  }
}

/// The state with the derivative of each of its components in the direction of `change`.
template <int N>
Subloading::State<Dual, N> along(const Subloading::State<double, N>& s, const Subloading::State<double, N>& change) {
  auto sym = [](const Sym<double, N>& v, const Sym<double, N>& d) {
    Sym<Dual, N> r;
    for (int i = 0; i < N; ++i) r[i] = Dual(v[i], d[i]);
    return r;
  };
  return {sym(s.sigma, change.sigma), sym(s.beta, change.beta), sym(s.a, change.a),
          sym(s.epsp, change.epsp),   Dual(s.p_c, change.p_c),  Dual(s.R_b, change.R_b)};
}

// The strongest single check of H: R follows from the state, and along the law's own change it must move as eq. 31
// says (plastic) or as dR = N:D:dε / N:(σ_y − a) (elastic). Any term missing from H breaks it.
TEST(Law, RMovesAsItsHardeningLawSays) {
  for (const auto& [model, s, deps] : cases()) {
    const auto fast = model.rate(s, deps);
    if (!fast.sound) continue;
    const double moved = model.homothety(along(s, fast.change)).R.d;
    const auto& c = model.parameters();
    const double R = model.homothety(s).R;
    const double size = norm(fast.change.epsp);
    const double expected = size > 0 ? -c.c_R * std::log((R - c.R_min) / (1 - c.R_min)) * size
                                     : plain_rate(c, to_plain(s), to_matrix(deps)).R_change;
    EXPECT_NEAR(moved, expected, 1e-10 * (std::abs(expected) + 1e-2)) << R;
  }
}

TEST(Law, TheHomotheticImageLiesOnTheYieldSurface) {
  for (const auto& [model, s, deps] : cases()) {
    const double R = model.homothety(s).R;
    const auto y = s.a + (1 / R) * (s.sigma - s.a);
    EXPECT_NEAR(yield_function(model.parameters(), to_matrix(y), to_matrix(s.beta), s.p_c), 0, 1e-11 * dot(y, y));
  }
}

// The law on dual numbers is the law on doubles with its exact derivative: central differences of the rate along its
// own change, error 1e-9 of the second derivative and of rounding each.
TEST(Law, DualNumbersGiveTheDerivativeOfTheRate) {
  std::mt19937 generator(12);
  const Subloading model = subloading(full_constants());
  for (int i = 0; i < 40; ++i) {
    const auto s = random_state<6>(generator, model);
    const auto deps = random_tensor<6>(generator, 1e-4);
    const auto fast = model.rate(s, deps);
    if (!fast.sound || norm(fast.change.epsp) == 0) continue;
    Sym<Dual, 6> dual_deps;
    for (int c = 0; c < 6; ++c) dual_deps[c] = Dual(deps[c]);
    const auto dual = model.rate(along(s, fast.change), dual_deps);
    const double step = 1e-2;
    const auto ahead = model.rate(advanced(s, step, fast.change), deps).change;
    const auto behind = model.rate(advanced(s, -step, fast.change), deps).change;
    for (int c = 0; c < 6; ++c) {
      const double slope = (ahead.sigma[c] - behind.sigma[c]) / (2 * step);
      EXPECT_NEAR(dual.change.sigma[c].d, slope, 1e-4 * std::abs(slope) + 1e-5 * norm(fast.change.sigma));
      EXPECT_NEAR(dual.change.sigma[c].v, fast.change.sigma[c], 1e-12 * norm(fast.change.sigma));
    }
  }
}

// Ordinary states that divide by zero in a careless form: σ = a, the apex C = 0, s̄ = 0, all of them at once.
TEST(Law, DegenerateStatesAreOrdinary) {
  const Subloading model = subloading(full_constants()), clay = subloading(cam_clay_constants());
  const auto none = Sym<double, 6>::zero();
  const Sym<double, 6> deps{{1e-4, 0, 2e-4, 0, 1e-5, 0}};
  const auto p100 = isotropic<double, 6>(100.0);
  Subloading::State<double, 6> s{p100, none, p100, none, 250.0, 2.0};
  EXPECT_EQ(model.homothety(s).R, 0);  // σ = a
  EXPECT_TRUE(model.rate(s, deps).sound);
  s.a = isotropic<double, 6>(-model.parameters().xi * s.p_c);  // a on the apex
  EXPECT_NEAR(model.homothety(s).R, (100 + 0.75) / 250.0, 1e-12);
  EXPECT_TRUE(model.rate(s, deps).sound);
  Subloading::State<double, 6> t{p100, none, none, none, 200.0, 1.0};
  EXPECT_DOUBLE_EQ(clay.homothety(t).R, 0.5);  // C = 0 and s̄ = 0 in the Modified Cam Clay limit
  EXPECT_TRUE(clay.rate(t, deps).sound);
  t.sigma = none;
  EXPECT_EQ(clay.homothety(t).R, 0);  // σ = a = 0
  t.sigma = isotropic<double, 6>(-1.0);
  EXPECT_FALSE(clay.admissible(t));  // no tension without ξ
}

template <int N>
void expect_batch_is_double() {
  std::mt19937 generator(13);
  const Subloading model = subloading(full_constants());
  std::array<Subloading::State<double, N>, batch_lanes> s;
  std::array<Sym<double, N>, batch_lanes> deps;
  for (std::size_t i = 0; i < batch_lanes; ++i) {
    s[i] = random_state<N>(generator, model);
    deps[i] = random_tensor<N>(generator, 1e-4);
  }
  Subloading::State<Batch, N> many;
  auto* const lanes = reinterpret_cast<double*>(s.data());
  int c = 0;
  for_each_component(
      [&](auto& x) {
        std::array<double, batch_lanes> values;
        for (std::size_t i = 0; i < batch_lanes; ++i) values[i] = lanes[i * state_size<Subloading, N>() + c];
        x = pack(values);
        ++c;
      },
      many);
  const auto r = model.rate(many, pack<N>(deps));
  for (std::size_t i = 0; i < batch_lanes; ++i) {
    const auto one = model.rate(s[i], deps[i]).change;
    EXPECT_LT(norm(lane(r.change.sigma, i) - one.sigma), 1e-12 * (1 + norm(one.sigma)));
    EXPECT_LT(norm(lane(r.change.a, i) - one.a), 1e-12 * (1 + norm(one.a)));
    EXPECT_NEAR(lane(r.change.p_c, i), one.p_c, 1e-12 * (1 + std::abs(one.p_c)));
  }
}

TEST(Law, BatchGivesWhatDoubleGives) {
  expect_batch_is_double<4>();
  expect_batch_is_double<6>();
}

}  // namespace
}  // namespace scarp::test
