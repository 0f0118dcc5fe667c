// What every constitutive model must satisfy. A model that is added to AnyModel is tested here by being listed; it
// brings constants and initial values to samples.hpp, or these tests fail. The models are dealt out to a few source
// files, conformance_*.cpp, that the compiler takes one by one.
#pragma once

#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

#include "lanes.hpp"
#include "samples.hpp"
#include "scarp/material/integrate/embedded.hpp"

namespace scarp::test {

constexpr std::size_t conformance_groups = 4;

/// Of the n models of a list, those with the numbers `group`, `group` + conformance_groups, ...
constexpr std::size_t group_size(std::size_t n, std::size_t group) {
  return (n + conformance_groups - 1 - group) / conformance_groups;
}

template <std::size_t group, class Numbers = std::make_index_sequence<group_size(std::variant_size_v<AnyModel>, group)>>
struct Group;
template <std::size_t group, std::size_t... i>
struct Group<group, std::index_sequence<i...>> {
  using type = testing::Types<std::variant_alternative_t<group + i * conformance_groups, AnyModel>...>;
};

constexpr std::size_t models_in_groups() {
  std::size_t sum = 0;
  for (std::size_t g = 0; g < conformance_groups; ++g) sum += group_size(std::variant_size_v<AnyModel>, g);
  return sum;
}
static_assert(models_in_groups() == std::variant_size_v<AnyModel>, "a model is in no group");

struct ModelName {
  template <class M>
  static std::string GetName(int) {
    auto name = M::description().name;
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
  }
};

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

TYPED_TEST_P(Conformance, DescribesItself) {
  const auto d = description_of(this->model_);
  std::set<std::string> keys;
  for (const auto& p : d.parameters) {
    EXPECT_TRUE(keys.insert(p.key).second) << p.key << " twice";
    EXPECT_FALSE(p.symbol.empty() || p.unit.empty() || p.meaning.empty()) << p.key;
  }
  std::size_t scalars = 6;
  for (const auto& f : d.state) scalars += f.kind == FieldKind::tensor ? 6 : 1;
  const auto s = this->template general_state<6>(1);
  EXPECT_EQ(6 + state_columns<6>(this->model_), scalars) << "description().state and State::each differ";
  EXPECT_EQ(components(s).size(), static_cast<std::size_t>(state_size<TypeParam, 6>()));
  EXPECT_EQ(this->model_.derived(s).size(), d.derived.size());
}

TYPED_TEST_P(Conformance, ZeroIncrementChangesNothing) {
  auto s = this->template general_state<6>(2);
  const auto before = s;
  const auto report = integrate<ModifiedEuler>(this->model_, s, Sym<double, 6>::zero(), {1e-4, 1e-7});
  EXPECT_EQ(report.end, IntegrationEnd::done);
  EXPECT_EQ(components(s), components(before));  // to the last bit
  if constexpr (HasUpdate<TypeParam> && !TimeDependent<TypeParam>) {
    const auto trial = attempt<ModifiedEuler>(this->model_, s, Sym<double, 6>::zero(), 1e-4);
    EXPECT_TRUE(trial.notes.sound);
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
    const auto notes = this->model_.accept(s, 1e-4);
    EXPECT_TRUE(notes.sound);
    EXPECT_FALSE(notes.corrected);
    EXPECT_EQ(components(s), components(before));
  }
}

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

template <int N, class Fixture>
void expect_batch_is_double(Fixture& f) {
  using Model = decltype(f.model_);
  std::mt19937 generator(5);
  std::array<typename Model::template State<double, N>, batch_lanes> s;
  std::array<Sym<double, N>, batch_lanes> deps;
  typename Model::template State<Batch, N> many;
  for (std::size_t i = 0; i < batch_lanes; ++i) {
    s[i] = f.template general_state<N>(static_cast<unsigned>(i));
    deps[i] = f.template increment<N>(generator, 1e-4);
  }
  std::size_t c = 0;
  for_each_component(
      [&](Batch& x) {
        std::array<double, batch_lanes> values;
        for (std::size_t i = 0; i < batch_lanes; ++i) values[i] = components(s[i])[c];
        x = pack(values);
        ++c;
      },
      many);
  const auto trial = attempt<ModifiedEuler>(f.model_, many, in_time(pack<N>(deps)), 1e-4);
  const Batch modulus = f.model_.p_wave_modulus(many);
  for (std::size_t i = 0; i < batch_lanes; ++i) {
    const auto one = attempt<ModifiedEuler>(f.model_, s[i], in_time(deps[i]), 1e-4);
    auto out = one.state;
    for_each_component([&](double& x, const Batch& b) { x = lane(b, i); }, out, trial.state);
    EXPECT_LT(relative_difference(one.state, out), 1e-12);
    EXPECT_NEAR(lane(trial.error, i), one.error, 1e-10 * one.error + 1e-15);
    EXPECT_EQ(trial.notes.sound.get(i), one.notes.sound);
    EXPECT_NEAR(lane(modulus, i) / f.model_.p_wave_modulus(s[i]), 1, 1e-14);
  }
}

TYPED_TEST_P(Conformance, BatchGivesWhatDoubleGives) {
  expect_batch_is_double<4>(*this);
  expect_batch_is_double<6>(*this);
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
  EXPECT_TRUE(trial.notes.sound);
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

/// The sample's constants with `key` at x, and what only shows between constants put right: a residual strength is no
/// larger than the peak, dilation no larger than friction, and what softens does so over some strain.
inline std::map<std::string, double> with_constant(std::map<std::string, double> all, const std::string& key,
                                                   double x) {
  all[key] = x;
  if (all.contains(key + "_residual")) all[key + "_residual"] = x;
  if (key == "phi") all["psi"] = 0;
  if (key == "epsp_residual")
    std::erase_if(all, [&](const auto& v) { return v.first != key && v.first.ends_with("_residual"); });
  return all;
}

/// The problems that say that a constant is out of its bounds.
inline std::vector<Problem> bound_problems(const std::string& model, const Sample& sample, const std::string& key,
                                           double x) {
  auto all = make_model(model, with_constant(sample.constants, key, x), sample.settings).problems;
  std::erase_if(all, [&](const Problem& p) { return p.what.find(key + " must satisfy") != 0; });
  return all;
}

inline void expect_refused(const std::string& model, const Sample& sample, const std::string& key, double x) {
  const auto problems = bound_problems(model, sample, key, x);
  ASSERT_GE(problems.size(), 1u) << model << " takes " << key << " = " << x;
  EXPECT_EQ(problems[0].key, key);
  if (std::isfinite(x)) {
    EXPECT_EQ(std::strtod(problems[0].value.c_str(), nullptr), x);
  }
  EXPECT_FALSE(problems[0].value.empty() || problems[0].remedy.empty()) << key;
  EXPECT_FALSE(make_model(model, with_constant(sample.constants, key, x), sample.settings).model);
}

inline void expect_bound(const std::string& model, const Sample& sample, const std::string& key, const Bound& bound,
                         double outward) {
  const double x = bound.value;
  expect_refused(model, sample, key, std::nextafter(x, outward));
  expect_refused(model, sample, key, x + std::copysign(1 + std::abs(x), outward));
  if (bound.open) {
    expect_refused(model, sample, key, x);
    EXPECT_TRUE(bound_problems(model, sample, key, std::nextafter(x, -outward)).empty()) << model << ": " << key;
  } else {
    const auto made = make_model(model, with_constant(sample.constants, key, x), sample.settings);
    EXPECT_TRUE(made.model) << model << " refuses " << key << " = " << x << ": "
                            << (made.problems.empty() ? "" : made.problems[0].what);
  }
}

// At a closed bound a constant is taken; at an open one, beyond and where not finite it is refused by its name, with
// the value and what to do.
TYPED_TEST_P(Conformance, ConstantsAtAndBeyondTheirBounds) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const auto d = TypeParam::description();
  for (const auto& p : d.parameters) {
    if (p.low) expect_bound(d.name, this->sample_, p.key, *p.low, -infinity);
    if (p.high) expect_bound(d.name, this->sample_, p.key, *p.high, infinity);
    for (double x : {infinity, -infinity, std::nan("")}) expect_refused(d.name, this->sample_, p.key, x);
  }
}

/// States of several doubles, one in each lane.
template <class Model, int N>
auto packed(const std::array<typename Model::template State<double, N>, batch_lanes>& s) {
  typename Model::template State<Batch, N> many;
  std::size_t c = 0;
  for_each_component(
      [&](Batch& x) {
        std::array<double, batch_lanes> values;
        for (std::size_t i = 0; i < batch_lanes; ++i) values[i] = components(s[i])[c];
        x = pack(values);
        ++c;
      },
      many);
  return many;
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
    EXPECT_EQ(trial.notes.sound.get(i), one.notes.sound);
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

// A state is kept as columns of numbers, in the order of the description, and comes back from them.
TYPED_TEST_P(Conformance, StateComesBackFromItsColumns) {
  auto s = this->template general_state<6>(10);
  typename TypeParam::template State<double, 6> back{};
  const auto columns = components(s);
  std::size_t c = 0;
  for_each_component([&](double& x) { x = columns[c++]; }, back);
  EXPECT_EQ(c, columns.size());
  EXPECT_EQ(components(back), columns);
  EXPECT_TRUE(this->model_.admissible(back));
  const auto deps = in_time(Sym<double, 6>{{1e-4, -2e-5, 3e-5, 1e-5, 2e-5, -4e-5}});
  integrate<DormandPrince>(this->model_, s, deps, {1e-8, 1e-7});
  integrate<DormandPrince>(this->model_, back, deps, {1e-8, 1e-7});
  EXPECT_EQ(components(back), components(s));
  if constexpr (!requires { this->model_.own_description(); }) {
    std::vector<FieldKind> kinds;
    std::decay_t<decltype(s)>::each(
        [&](const auto& x) {
          kinds.push_back(is_sym<std::decay_t<decltype(x)>>::value ? FieldKind::tensor : FieldKind::scalar);
        },
        s);
    std::vector<FieldKind> described{FieldKind::tensor};  // of sigma
    for (const auto& field : TypeParam::description().state) described.push_back(field.kind);
    EXPECT_EQ(kinds, described);
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

REGISTER_TYPED_TEST_SUITE_P(Conformance, DescribesItself, ZeroIncrementChangesNothing,
                            AcceptLeavesAnAdmissibleStateAlone, Objectivity, FourComponentsAreSixInPlaneStrain,
                            BatchGivesWhatDoubleGives, WaveModulusIsTheStiffnessOfUnloading,
                            RateIsHomogeneousOfDegreeOne, TimeAloneMattersOnlyToLawsThatDependOnIt,
                            IncrementsOfHalfTheSizeAgree, ConstantsAtAndBeyondTheirBounds, LanesInDifferentBranches,
                            StateComesBackFromItsColumns, PlasticStrainDissipates, RateIsTheDerivativeOfTheIncrement);

}  // namespace scarp::test
