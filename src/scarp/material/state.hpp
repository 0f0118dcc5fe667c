// What all constitutive models share: arithmetic on states and the types that a law answers with.
//
// A model is a class with
//   State<T, N>           sigma and the internal variables, compression positive; its each(f, states...) calls f with
//                         a member of every state, sigma first: arithmetic, rotation, storage and output follow it
//   description()         keys, symbols, units, bounds, meanings; state fields in the order of each()
//   from_values(...)      constants from the input keys
//   rate(s, deps)         the change of the state for a strain increment, to first order: d(state) = F(state) deps; or
//   rate(s, deps, dt)     the same for a law that depends on time; or
//   update(s, increment, tolerance)  a one-step integration of the law's own (a return to the yield surface), in place
//                         of rate(): answers what attempt() of integrate/embedded.hpp does, with an error estimate that
//                         falls as the square of the increment, 0 where it is exact; update<Pair>(...) where it
//                         advances by the pair that the caller chose
//   admissible(s)         may a law be evaluated here?
//   error_norm(s, e)      size of a state error e relative to s
//   accept(s, tol)        corrections to the end of an increment, whether it is admissible, and what to count
//   p_wave_modulus(s)     K + 4G/3 of the present stiffness
//   initial_state(...)    the state for an initial stress and the region's keys
//   derived(s)            quantities for output, in the order of the description
// A model whose state only its constants tell (umat) also has state_columns<N>(), rotate_own(s, turn) and
// own_description().
// T is double or a SIMD batch, N 4 (plane strain) or 6 components. Models have no mutable members.
#pragma once

#include <type_traits>
#include <utility>

#include "scarp/tensor/rotation.hpp"
#include "scarp/tensor/sym.hpp"

namespace scarp {

/// The change of a state, and where it is sound: the state admissible and the law solvable (N:D:G + H > 0).
template <class State, class T>
struct Rate {
  State change;
  Mask<T> sound;
};

/// What happened to a point at the end of an increment.
template <class T>
struct UpdateFlags {
  Mask<T> corrected;  ///< stress pulled back to the yield surface
  Mask<T> on_floor;   ///< a hardening variable stands at its floor
  Mask<T> separated;  ///< no tensile strength left: stress set to zero
  Mask<T> sound;      ///< the state is admissible
};

/// One trial over the whole of an increment.
template <class State, class T>
struct Trial {
  State state;
  T error;               ///< relative, in the model's norm
  UpdateFlags<T> flags;  ///< `sound` there: every stage and the end admissible, and the law solvable
};

template <class T>
struct is_sym : std::false_type {};
template <class T, int N>
struct is_sym<Sym<T, N>> : std::true_type {};

/// f(component of a, component of b, ...) for each scalar component of a state, in order.
template <class F, class State, class... States>
inline void for_each_component(F&& f, State& first, States&... others) {
  std::decay_t<State>::each(
      [&](auto& x, auto&... y) {
        if constexpr (is_sym<std::decay_t<decltype(x)>>::value) {
          for (int i = 0; i < std::decay_t<decltype(x)>::size; ++i) f(x[i], y[i]...);
        } else {
          f(x, y...);
        }
      },
      first, others...);
}

/// s + w k
template <class State, class T>
inline State advanced(const State& s, const T& w, const State& k) {
  State r = s;
  for_each_component([&](auto& x, const auto& dx) { x = x + w * dx; }, r, k);
  return r;
}

/// yes where the mask is set, otherwise no, component by component.
template <class State, class M>
inline State select_state(const M& mask, const State& yes, const State& no) {
  State r = no;
  for_each_component([&](auto& x, const auto& y) { x = select(mask, y, x); }, r, yes);
  return r;
}

/// Turns every tensor of a state with the body (eqs 12, 13: sigma, beta and a alike).
template <class State, class T, int N>
inline void rotate(State& s, const Rotation<T, N>& turn) {
  State::each(
      [&](auto& x) {
        if constexpr (is_sym<std::decay_t<decltype(x)>>::value) x = turn(x);
      },
      s);
}

/// The same for the state of a model that keeps tensors as columns of numbers, beside members that are tensors.
/// Wherever a model is at hand, turn with this one.
template <class Model, class State, class T, int N>
inline void rotate(const Model& model, State& s, const Rotation<T, N>& turn) {
  rotate(s, turn);
  if constexpr (requires { model.rotate_own(s, turn); }) model.rotate_own(s, turn);
}

/// Number of scalar components of a model's state, sigma included.
template <class Model, int N>
constexpr int state_size() {
  using State = typename Model::template State<double, N>;
  return static_cast<int>(sizeof(State) / sizeof(double));
}

/// Number of scalar components without sigma that are in use: what is kept of a point. A model may leave some at the
/// end of its state unused.
template <int N, class Model>
constexpr int state_columns(const Model& model) {
  if constexpr (requires { model.template state_columns<N>(); }) {
    return model.template state_columns<N>();
  } else {
    return state_size<Model, N>() - N;
  }
}

}  // namespace scarp
