// What a model says of itself: its description, its state as columns, and the bounds of its constants.
#pragma once

#include <limits>
#include <set>

#include "conformance_fixture.hpp"

namespace scarp::test {

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
  const std::string what = std::isfinite(x) ? " must satisfy" : " is finite";
  std::erase_if(all, [&](const Problem& p) { return p.what.find(key + what) != 0; });
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

}  // namespace scarp::test
