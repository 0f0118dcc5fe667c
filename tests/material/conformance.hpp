// What every constitutive model must satisfy. A model that is added to AnyModel is tested here by being listed; it
// brings constants and initial values to samples.hpp, or these tests fail. The models are dealt out to a few source
// files, conformance_*.cpp, that the compiler takes one by one.
#pragma once

#include <utility>

#include "conformance_description.hpp"
#include "conformance_increments.hpp"
#include "conformance_lanes.hpp"
#include "conformance_tensors.hpp"

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

REGISTER_TYPED_TEST_SUITE_P(Conformance, DescribesItself, ZeroIncrementChangesNothing,
                            AcceptLeavesAnAdmissibleStateAlone, Objectivity, FourComponentsAreSixInPlaneStrain,
                            BatchGivesWhatDoubleGives, WaveModulusIsTheStiffnessOfUnloading,
                            RateIsHomogeneousOfDegreeOne, TimeAloneMattersOnlyToLawsThatDependOnIt,
                            IncrementsOfHalfTheSizeAgree, ConstantsAtAndBeyondTheirBounds, LanesInDifferentBranches,
                            StateComesBackFromItsColumns, PlasticStrainDissipates, WhatOpensClosesFirst,
                            RateIsTheDerivativeOfTheIncrement);

}  // namespace scarp::test
