// What the tests of every constitutive model share: a model with its sample, a general state, random increments.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "samples.hpp"
#include "scarp/material/integrate/embedded.hpp"

namespace scarp::test {

/// A strain over a time of one unit, in which the laws of samples.hpp that depend on time flow by about a strain of
/// 1e-4.
template <class T, int N>
Increment<T, N> in_time(const Sym<T, N>& deps) {
  return {deps, T(1.0)};
}

template <class M>
class Conformance : public testing::Test {
 public:
  template <int N>
  using State = typename M::template State<double, N>;

  Conformance()
      : sample_(sample(M::description().name)),
        model_(std::get<M>(made(M::description().name, sample_.constants, sample_.settings))) {}

  /// A state in compression that a few random increments have made general; in plane strain for N = 4 or `flat`.
  template <int N>
  State<N> general_state(unsigned seed, bool flat = false) {
    std::mt19937 generator(seed);
    Sym<double, N> sigma = Sym<double, N>::zero();
    for (int i = 0; i < 4; ++i) sigma[i] = std::array<double, 4>{62, 100, 66, 9}[static_cast<std::size_t>(i)];
    std::vector<Problem> problems;
    auto s = model_.template initial_state<N>(sigma, 100, sample_.initial, problems);
    EXPECT_TRUE(problems.empty());
    for (int i = 0; i < 10; ++i) {
      auto deps = increment<N>(generator, 2e-4, flat);
      deps[1] += 3e-4;
      EXPECT_EQ((integrate<DormandPrince>(model_, s, in_time(deps), {1e-8, 1e-7}).end), IntegrationEnd::done);
    }
    return s;
  }

  template <int N>
  Sym<double, N> increment(std::mt19937& generator, double size, bool flat = false) {
    auto deps = random_tensor<N>(generator, size);
    if (flat)
      for (int i = 4; i < N; ++i) deps[i] = 0;
    return deps;
  }

  Sample sample_;
  M model_;
};

TYPED_TEST_SUITE_P(Conformance);

/// Every scalar of a state, sigma first.
template <class State>
std::vector<double> components(const State& s) {
  std::vector<double> all;
  for_each_component([&](const double& x) { all.push_back(x); }, s);
  return all;
}

/// Size of a − b against the size of a, component by component of the same member.
template <class State>
double relative_difference(const State& a, const State& b) {
  double worst = 0;
  State::each(
      [&](const auto& x, const auto& y) {
        if constexpr (is_sym<std::decay_t<decltype(x)>>::value) {
          worst = std::max(worst, norm(x - y) / (norm(x) + 1e-12));
        } else {
          worst = std::max(worst, std::abs(x - y) / (std::abs(x) + 1e-12));
        }
      },
      a, b);
  return worst;
}

}  // namespace scarp::test
