// A model knows no directions, and plane strain is a case of space.
#pragma once

#include "conformance_fixture.hpp"

namespace scarp::test {

// A body with its state turned and strained in turned directions answers with the turned answer.
template <int N, class Fixture>
void expect_objective(Fixture& f, const Spin<double, N>& spin) {
  std::mt19937 generator(3);
  const Rotation<double, N> q(spin);
  for (int i = 0; i < 20; ++i) {
    auto s = f.template general_state<N>(static_cast<unsigned>(i));
    const auto deps = f.template increment<N>(generator, 1e-4);
    auto turned = s;
    rotate(f.model_, turned, q);
    const auto a = attempt<ModifiedEuler>(f.model_, turned, in_time(q(deps)), 1e-4).state;
    auto b = attempt<ModifiedEuler>(f.model_, s, in_time(deps), 1e-4).state;
    rotate(f.model_, b, q);
    EXPECT_LT(relative_difference(a, b), 1e-11);  // rounding of the rotation, amplified by the state's stiffness
  }
}

TYPED_TEST_P(Conformance, Objectivity) {
  expect_objective<4>(*this, {{0.7}});
  expect_objective<6>(*this, {{0.7, -0.3, 1.1}});
}

TYPED_TEST_P(Conformance, FourComponentsAreSixInPlaneStrain) {
  std::mt19937 generator(4);
  for (int i = 0; i < 20; ++i) {
    auto s4 = this->template general_state<4>(static_cast<unsigned>(i));
    typename TypeParam::template State<double, 6> s6{};
    TypeParam::template State<double, 6>::each(
        [](auto& x, const auto& y) {
          if constexpr (is_sym<std::decay_t<decltype(x)>>::value) {
            for (int c = 0; c < 6; ++c) x[c] = c < 4 ? y[c] : 0.0;
          } else {
            x = y;
          }
        },
        s6, s4);
    const auto deps = this->template increment<4>(generator, 1e-4);
    s4 = attempt<DormandPrince>(this->model_, s4, in_time(deps), 1e-4).state;
    s6 = attempt<DormandPrince>(this->model_, s6, in_time(Sym<double, 6>{{deps[0], deps[1], deps[2], deps[3], 0, 0}}),
                                1e-4)
             .state;
    EXPECT_NEAR(s6.sigma[4], 0, 1e-14);
    EXPECT_NEAR(s6.sigma[5], 0, 1e-14);
    for (int c = 0; c < 4; ++c) EXPECT_NEAR(s4.sigma[c], s6.sigma[c], 1e-12 * norm(s4.sigma));
  }
}

}  // namespace scarp::test
