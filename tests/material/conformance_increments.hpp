// What an increment of strain and time does, and what it does not.
#pragma once

#include "conformance_fixture.hpp"

namespace scarp::test {

TYPED_TEST_P(Conformance, ZeroIncrementChangesNothing) {
  auto s = this->template general_state<6>(2);
  const auto before = s;
  const auto report = integrate<ModifiedEuler>(this->model_, s, Sym<double, 6>::zero(), {1e-4, 1e-7});
  EXPECT_EQ(report.end, IntegrationEnd::done);
  EXPECT_EQ(components(s), components(before));  // to the last bit
  if constexpr (HasUpdate<TypeParam> && !TimeDependent<TypeParam>) {
    const auto trial = attempt<ModifiedEuler>(this->model_, s, Sym<double, 6>::zero(), 1e-4);
    EXPECT_TRUE(trial.flags.sound);
    EXPECT_EQ(trial.error, 0);
    EXPECT_EQ(components(trial.state), components(before));
  } else if constexpr (!HasUpdate<TypeParam>) {
    const auto rate = rate_of(this->model_, s, as_increment(Sym<double, 6>::zero()));
    for (double x : components(rate.change)) EXPECT_EQ(x, 0);
  }
}

// What is corrected at the end of an increment is corrected once.
TYPED_TEST_P(Conformance, AcceptLeavesAnAdmissibleStateAlone) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    auto s = this->template general_state<6>(seed);
    const auto before = s;
    const auto flags = this->model_.accept(s, 1e-4);
    EXPECT_TRUE(flags.sound);
    EXPECT_FALSE(flags.corrected);
    EXPECT_EQ(components(s), components(before));
  }
}

/// n⊗n of the principal direction n of the least compression: the square of (‖σ‖ I − σ), again and again.
inline Sym<double, 6> least_compressed_direction(const Sym<double, 6>& sigma) {
  Matrix m = to_matrix(isotropic<double, 6>(norm(sigma)) - sigma);
  for (int i = 0; i < 20; ++i) {
    m = m * m;
    const double size = m[0][0] + m[1][1] + m[2][2];
    for (auto& row : m)
      for (double& x : row) x /= size;
  }
  return from_matrix<6>(m);
}

// An explicit step's critical time rests on this: unloading along an axis meets K + 4G/3. Where the stiffness has
// directions (elasticity at large strain) the modulus is that of the stiffest, along the largest stretch.
TYPED_TEST_P(Conformance, WaveModulusIsTheStiffnessOfUnloading) {
  const auto s = this->template general_state<6>(6);
  const double h = 1e-9;
  double tangent = 0;
  for (const auto& nn : {Sym<double, 6>{{0, 1, 0, 0, 0, 0}}, least_compressed_direction(s.sigma)}) {
    auto unloaded = s;
    const auto report = integrate<DormandPrince>(this->model_, unloaded, -h * nn, {1e-10, 1e-7});
    ASSERT_EQ(report.end, IntegrationEnd::done);
    tangent = std::max(tangent, dot(nn, s.sigma - unloaded.sigma) / h);
  }
  EXPECT_NEAR(this->model_.p_wave_modulus(s) / tangent, 1, 1e-5);  // cancellation: 1e-16 of σ over h times the modulus
}

/// The change of a state in one attempt; one piece of machine code, so that equal increments give equal bits.
template <class Fixture, class State>
[[gnu::noinline]] State change_in_one_attempt(Fixture& f, const State& s, const Increment<double, 6>& i) {
  const auto trial = attempt<ModifiedEuler>(f.model_, s, i, 1e-4);
  EXPECT_TRUE(trial.flags.sound);
  return advanced(trial.state, -1.0, s);
}

// The change of state is of degree one in the increment: of strain, or of strain and time together. An update() has a
// finite increment's curvature, of second order, and takes no notice of time.
template <class Fixture, class State>
void expect_update_is_homogeneous(Fixture& f, const State& s, std::mt19937& generator) {
  constexpr double h = 1e-7;
  const auto change = [&](const Increment<double, 6>& i) { return change_in_one_attempt(f, s, i); };
  for (int i = 0; i < 20; ++i) {
    const auto deps = f.template increment<6>(generator, h);
    const auto one = change({deps, 0.0}), three = change({3.0 * deps, 0.0}), slow = change({deps, 1e6});
    EXPECT_EQ(components(one), components(slow));
    // Stress turns by 2G ‖Δε‖/‖s‖ ~ 1e-4 on the way, and a share of that is the curvature; cancellation is 1e-16 of the
    // state over its change of some 1e-7.
    State::each(
        [&](const auto& x, const auto& y) {
          if constexpr (is_sym<std::decay_t<decltype(x)>>::value) {
            EXPECT_LT(norm(x - 3.0 * y), 1e-3 * (norm(x) + norm(3.0 * deps)));
          } else {
            EXPECT_LT(std::abs(x - 3.0 * y), 1e-3 * (std::abs(x) + norm(3.0 * deps)));
          }
        },
        three, one);
  }
}

TYPED_TEST_P(Conformance, RateIsHomogeneousOfDegreeOne) {
  std::mt19937 generator(7);
  const auto s = this->template general_state<6>(7);
  if constexpr (HasUpdate<TypeParam> && TimeDependent<TypeParam>) {
    GTEST_SKIP() << "a law of others, which may be anything";
  } else if constexpr (HasUpdate<TypeParam>) {
    expect_update_is_homogeneous(*this, s, generator);
  } else {
    for (int i = 0; i < 20; ++i) {
      const auto deps = this->template increment<6>(generator, 1e-4);
      const auto one = components(rate_of(this->model_, s, in_time(deps)).change),
                 three = components(rate_of(this->model_, s, 3.0 * in_time(deps)).change);
      for (std::size_t c = 0; c < one.size(); ++c) EXPECT_NEAR(three[c], 3 * one[c], 1e-12 * std::abs(three[c]));
    }
  }
}

// A law that depends on time flows in a time without strain, unless it is at rest; one that does not, cannot tell.
TYPED_TEST_P(Conformance, TimeAloneMattersOnlyToLawsThatDependOnIt) {
  if constexpr (HasUpdate<TypeParam> && TimeDependent<TypeParam>)
    GTEST_SKIP() << "a law of others, which may be anything";
  auto s = this->template general_state<6>(9);
  const auto before = s;
  integrate<DormandPrince>(this->model_, s, in_time(Sym<double, 6>::zero()), {1e-8, 1e-9});
  EXPECT_EQ(components(s) != components(before), TimeDependent<TypeParam>);
  integrate<DormandPrince>(this->model_, s, Increment<double, 6>{Sym<double, 6>::zero(), 1e6}, {1e-8, 1e-9});
  const auto rested = components(s);
  integrate<DormandPrince>(this->model_, s, in_time(Sym<double, 6>::zero()), {1e-8, 1e-9});
  // What drives a flow dies out like a power of time at worst: a millionth of it is left in a millionth of the time.
  for (std::size_t c = 0; c < rested.size(); ++c) {
    EXPECT_NEAR(components(s)[c], rested[c], 2e-6 * std::abs(rested[c]) + 1e-12);
  }
}

// Small increments join up with the rate: the integrator and the law mean the same thing.
TYPED_TEST_P(Conformance, IncrementsOfHalfTheSizeAgree) {
  std::mt19937 generator(8);
  for (int i = 0; i < 20; ++i) {
    auto whole = this->template general_state<6>(static_cast<unsigned>(i));
    auto halves = whole;
    const auto deps = this->template increment<6>(generator, 1e-3);
    integrate<DormandPrince>(this->model_, whole, in_time(deps), {1e-8, 1e-9});
    for (int k = 0; k < 2; ++k) integrate<DormandPrince>(this->model_, halves, 0.5 * in_time(deps), {1e-8, 1e-9});
    EXPECT_LT(norm(whole.sigma - halves.sigma), 1e-6 * norm(whole.sigma));  // 1e-8 for each of some ten substeps
  }
}

// σ : dε^p ≥ 0 where the theory says so: see dissipative() in samples.hpp.
TYPED_TEST_P(Conformance, PlasticStrainDissipates) {
  const auto name = TypeParam::description().name;
  const auto constants = dissipative(name);
  if (!constants) GTEST_SKIP() << "without plastic strain, or a law of others";
  if constexpr (requires(typename TypeParam::template State<double, 6> s) { s.epsp; }) {
    this->sample_ = *constants;
    this->model_ = std::get<TypeParam>(made(name, this->sample_.constants, this->sample_.settings));
    std::mt19937 generator(11);
    int plastic = 0;
    for (unsigned seed = 0; seed < 50; ++seed) {
      auto s = this->template general_state<6>(seed);
      for (int i = 0; i < 10; ++i) {
        const auto before = s;
        integrate<DormandPrince>(this->model_, s, in_time(this->template increment<6>(generator, 1e-4)), {1e-8, 1e-9});
        const auto depsp = s.epsp - before.epsp;
        const double work = 0.5 * dot(before.sigma + s.sigma, depsp);
        plastic += norm(depsp) > 1e-7;
        // The mean stress of an increment of part elastic strain is not that of the plastic part.
        EXPECT_GE(work, -0.5 * norm(s.sigma - before.sigma) * norm(depsp)) << name << ", seed " << seed;
      }
    }
    EXPECT_GE(plastic, 50);
  }
}

// What opens at no stress closes before the point carries load: pulled apart and put together again, cycle by cycle,
// soil is under no more pressure than before. A law that forgets the opening has 3 K · 1 % of it after the first.
TYPED_TEST_P(Conformance, WhatOpensClosesFirst) {
  using State6 = typename TypeParam::template State<double, 6>;
  if constexpr (requires(const State6& s) { s.gap; }) {
    const auto sample = parting(TypeParam::description().name);
    const auto model = std::get<TypeParam>(made(TypeParam::description().name, sample.constants));
    const double p = 0.4;
    std::vector<Problem> problems;
    auto s = model.template initial_state<6>(isotropic<double, 6>(p), p, sample.initial, problems);
    ASSERT_TRUE(problems.empty());
    EXPECT_EQ(s.gap, 0);
    const auto go = [&](double strain) {
      const auto report = integrate<ModifiedEuler>(model, s, in_time(isotropic<double, 6>(strain)), {1e-6, 1e-9});
      EXPECT_EQ(report.end, IntegrationEnd::done);
      return report.flags.separated;
    };
    EXPECT_TRUE(go(-0.01));
    EXPECT_EQ(norm(s.sigma), 0);
    EXPECT_NEAR(s.gap, 0.03, 2e-3);  // less what was elastic: p over the bulk modulus
    const double open = s.gap;
    EXPECT_TRUE(go(0.003));
    EXPECT_EQ(norm(s.sigma), 0);
    EXPECT_NEAR(s.gap, open - 0.009, 1e-15);
    EXPECT_FALSE(go(0.007));
    EXPECT_EQ(s.gap, 0);
    EXPECT_GT(mean(s.sigma), 0);
    EXPECT_LT(mean(s.sigma), p * (1 + 1e-6));
  } else {
    GTEST_SKIP() << "no point of it opens";
  }
}

// rate() is the derivative of what an increment does: of what a strain of 1e-7 does.
TYPED_TEST_P(Conformance, RateIsTheDerivativeOfTheIncrement) {
  using State6 = typename TypeParam::template State<double, 6>;
  constexpr bool has_rate =
      !HasUpdate<TypeParam> || requires(const TypeParam& m, const State6& s, const Sym<double, 6>& deps) {
    m.rate(s, deps);
  };
  if constexpr (has_rate) {
    constexpr double h = 1e-7;
    std::mt19937 generator(12);
    for (unsigned seed = 0; seed < 20; ++seed) {
      const auto s = this->template general_state<6>(seed);
      const auto way = h * in_time(this->template increment<6>(generator, 1));
      const auto rate = rate_of(this->model_, s, way).change;
      const auto change = [&](double share) {
        auto moved = s;
        EXPECT_EQ(integrate<DormandPrince>(this->model_, moved, share * way, {1e-10, 1e-7}).end, IntegrationEnd::done);
        return advanced(moved, -1.0, s);
      };
      // 4 Δ(h/2) − Δ(h): without the part of second order, the law's curvature.
      const auto once = change(1), half = change(0.5);
      const auto derivative = advanced(advanced(half, 3.0, half), -1.0, once);
      std::decay_t<decltype(s)>::each(
          [&](const auto& x, const auto& y, const auto& z) {
            // What overstress grows by is some 2e-3 of itself, and that squared is left; rounding 1e-16 of the value.
            if constexpr (is_sym<std::decay_t<decltype(x)>>::value) {
              EXPECT_LT(norm(x - y), 1e-3 * norm(x) + 1e-14 * norm(z));
            } else {
              EXPECT_LT(std::abs(x - y), 1e-3 * std::abs(x) + 1e-14 * std::abs(z) + 1e-14);
            }
          },
          rate, derivative, s);
    }
  }
}

}  // namespace scarp::test
