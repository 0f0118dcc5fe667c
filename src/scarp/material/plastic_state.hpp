// The states of the linear-elastic, plastic laws (elastoplastic.hpp), of which some part from the body at no stress.
#pragma once

#include <cmath>

#include "scarp/material/gap.hpp"
#include "scarp/material/state.hpp"

namespace scarp {

template <class T, int N>
struct PlasticState {
  Sym<T, N> sigma;
  Sym<T, N> epsp;  ///< plastic strain
  T kappa;         ///< accumulated plastic deviatoric strain ∫ √(2/3) ‖dev dε^p‖

  template <class F, class... States>
  static void each(F&& f, States&... s) {
    f(s.sigma...);
    f(s.epsp...);
    f(s.kappa...);
  }
};

/// The state of a law whose points part from the body at an apex at zero stress. Of the plastic strain there, what the
/// surfaces around the apex can flow along is theirs (shear, with its dilation); the rest is an isotropic opening:
///   dε^p = dε^flow − (dgap/3) I,  dε^flow on the boundary of their cone of flow directions.
/// So the gap grows exactly where the stress stays at the apex, and what would lead away from it closes the gap first.
template <class T, int N>
struct PartingState : PlasticState<T, N> {
  T gap = T(0.0);

  template <class F, class... States>
  static void each(F&& f, States&... s) {
    PlasticState<T, N>::each(f, s...);
    f(s.gap...);
  }
};

template <class State>
concept HasGap = requires(const State& s) {
  s.gap;
};

/// The volume that a point will have when its gap has closed, over its present one, 1 where it is not open.
inline double volume_when_closed(double gap) {
  return std::exp(-gap);
}
template <class State>
double volume_when_closed(const State& s) {
  if constexpr (HasGap<State>) return volume_when_closed(s.gap);
  return 1;
}

}  // namespace scarp
