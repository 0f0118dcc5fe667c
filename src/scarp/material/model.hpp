// What a constitutive model must have (material/state.hpp says what each is), as concepts: a model that lacks a
// function is told which, in one line, where it is listed in models.hpp.
#pragma once

#include <concepts>
#include <string>
#include <vector>

#include "scarp/material/description.hpp"
#include "scarp/material/increment.hpp"
#include "scarp/material/initial_values.hpp"
#include "scarp/material/state.hpp"

namespace scarp {
namespace model {

template <class M, int N>
using StateOf = typename M::template State<double, N>;

template <class M, int N>
concept HasState = requires(StateOf<M, N> s) {
  s.sigma[N - 1];
  StateOf<M, N>::each([](auto&) {}, s);
};
template <class M>
concept HasDescription = requires {
  { M::description() } -> std::same_as<ModelDescription>;
};
template <class M, int N>
concept HasLaw = TimeDependent<M> || HasUpdate<M> ||
    requires(const M& m, const StateOf<M, N>& s, const Sym<double, N>& deps) {
  m.rate(s, deps);
};
template <class M, int N>
concept HasAdmissible = requires(const M& m, const StateOf<M, N>& s) {
  { m.admissible(s) } -> std::convertible_to<bool>;
};
template <class M, int N>
concept HasErrorNorm = requires(const M& m, const StateOf<M, N>& s) {
  { m.error_norm(s, s) } -> std::convertible_to<double>;
};
template <class M, int N>
concept HasAccept = requires(const M& m, StateOf<M, N>& s) {
  { m.accept(s, 1e-6) } -> std::convertible_to<UpdateFlags<double>>;
};
template <class M, int N>
concept HasStiffness = requires(const M& m, const StateOf<M, N>& s) {
  { m.p_wave_modulus(s) } -> std::convertible_to<double>;
};
template <class M, int N>
concept HasInitialState = requires(const M& m, const Sym<double, N>& sigma, const Values& keys,
                                   std::vector<Problem>& problems) {
  { m.template initial_state<N>(sigma, 1.0, keys, problems) } -> std::convertible_to<StateOf<M, N>>;
};
template <class M, int N>
concept HasDerived = requires(const M& m, const StateOf<M, N>& s) {
  { m.derived(s) } -> std::same_as<std::vector<double>>;
};

/// Names what M lacks.
template <class M, int N>
constexpr bool is_complete() {
  static_assert(HasDescription<M>, "a model needs description(): its name, keys and state fields");
  static_assert(HasState<M, N>, "a model needs State<T, N> with sigma and each(f, states...)");
  static_assert(HasLaw<M, N>, "a model needs rate(s, deps), rate(s, deps, dt) or update(s, increment, tolerance)");
  static_assert(HasAdmissible<M, N>, "a model needs admissible(s): may the law be evaluated here?");
  static_assert(HasErrorNorm<M, N>, "a model needs error_norm(s, e): the size of a state error");
  static_assert(HasAccept<M, N>,
                "a model needs accept(s, tolerance): corrections at the end of an increment, as UpdateFlags");
  static_assert(HasStiffness<M, N>, "a model needs p_wave_modulus(s): K + 4G/3, for the time step");
  static_assert(HasInitialState<M, N>, "a model needs initial_state<N>(sigma, vertical, keys, problems)");
  static_assert(HasDerived<M, N>,
                "a model needs derived(s): what it shows beside its state, in the order of the description");
  return true;
}

}  // namespace model

/// A constitutive model in plane strain and in space.
template <class M>
concept Model = model::HasDescription<M> && model::HasState<M, 4> && model::HasState<M, 6> && model::HasLaw<M, 6> &&
    model::HasAdmissible<M, 6> && model::HasErrorNorm<M, 6> && model::HasAccept<M, 6> && model::HasStiffness<M, 6> &&
    model::HasInitialState<M, 6> && model::HasDerived<M, 6>;

}  // namespace scarp
