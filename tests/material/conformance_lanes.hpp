// A model on a batch of states is the model on each of them.
#pragma once

#include "conformance_fixture.hpp"
#include "lanes.hpp"

namespace scarp::test {

template <int N, class Fixture>
void expect_batch_is_double(Fixture& f) {
  using Model = decltype(f.model_);
  std::mt19937 generator(5);
  std::array<typename Model::template State<double, N>, batch_lanes> s;
  std::array<Sym<double, N>, batch_lanes> deps;
  for (std::size_t i = 0; i < batch_lanes; ++i) {
    s[i] = f.template general_state<N>(static_cast<unsigned>(i));
    deps[i] = f.template increment<N>(generator, 1e-4);
  }
  const auto many = packed<Model, N>(s);
  const auto trial = attempt<ModifiedEuler>(f.model_, many, in_time(pack<N>(deps)), 1e-4);
  const Batch modulus = f.model_.p_wave_modulus(many);
  for (std::size_t i = 0; i < batch_lanes; ++i) {
    const auto one = attempt<ModifiedEuler>(f.model_, s[i], in_time(deps[i]), 1e-4);
    auto out = one.state;
    for_each_component([&](double& x, const Batch& b) { x = lane(b, i); }, out, trial.state);
    EXPECT_LT(relative_difference(one.state, out), 1e-12);
    EXPECT_NEAR(lane(trial.error, i), one.error, 1e-10 * one.error + 1e-15);
    EXPECT_EQ(trial.flags.sound.get(i), one.flags.sound);
    EXPECT_NEAR(lane(modulus, i) / f.model_.p_wave_modulus(s[i]), 1, 1e-14);
  }
}

TYPED_TEST_P(Conformance, BatchGivesWhatDoubleGives) {
  expect_batch_is_double<4>(*this);
  expect_batch_is_double<6>(*this);
}

// One lane rests, others unload, others load: each goes its own way, and the idle one keeps its state to the last bit.
template <int N, class Fixture>
void expect_mixed_lanes(Fixture& f, std::size_t idle) {
  using Model = decltype(f.model_);
  std::array<typename Model::template State<double, N>, batch_lanes> s;
  std::array<Sym<double, N>, batch_lanes> deps;
  std::array<double, batch_lanes> dt;
  for (std::size_t i = 0; i < batch_lanes; ++i) {
    s[i] = f.template general_state<N>(static_cast<unsigned>(i));
    deps[i] = Sym<double, N>::zero();
    if (i != idle) deps[i][1] = i % 2 == idle % 2 ? -1e-4 : 1e-4;  // against the straining of before, or on with it
    dt[i] = i == idle ? 0 : 1;
  }
  const auto trial =
      attempt<ModifiedEuler>(f.model_, packed<Model, N>(s), Increment<Batch, N>{pack<N>(deps), pack(dt)}, 1e-4);
  for (std::size_t i = 0; i < batch_lanes; ++i) {
    const auto one = attempt<ModifiedEuler>(f.model_, s[i], Increment<double, N>{deps[i], dt[i]}, 1e-4);
    auto out = one.state;
    for_each_component([&](double& x, const Batch& b) { x = lane(b, i); }, out, trial.state);
    EXPECT_LT(relative_difference(one.state, out), 1e-12);
    EXPECT_EQ(trial.flags.sound.get(i), one.flags.sound);
    if (i == idle && !(HasUpdate<Model> && TimeDependent<Model>)) {  // a law of others counts its calls
      EXPECT_EQ(components(out), components(s[i]));
      EXPECT_EQ(lane(trial.error, i), 0);
    }
  }
}

TYPED_TEST_P(Conformance, LanesInDifferentBranches) {
  for (std::size_t idle = 0; idle < batch_lanes; ++idle) {
    expect_mixed_lanes<4>(*this, idle);
    expect_mixed_lanes<6>(*this, idle);
  }
}

}  // namespace scarp::test
