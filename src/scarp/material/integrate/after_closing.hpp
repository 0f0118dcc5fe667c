// The step of a pair from a state that may be open: what closes the gap does not load the point.
#pragma once

#include "scarp/material/gap.hpp"
#include "scarp/material/integrate/embedded.hpp"

namespace scarp {

/// For laws whose rate() leaves an open point without stress, and whose gap takes all volumetric strain. The increment
/// is divided at the instant of contact, where the rate has a jump that an error estimate from smooth rates would miss.
template <class Pair, class Law, class State, class T, int N>
Trial<State, T> after_closing(const Law& law, const State& s, const Increment<T, N>& step, double tolerance) {
  if (!any(s.gap > T(0.0))) return attempt_pair<Pair>(law, s, step, tolerance);  // as nearly all
  const Closing<T> closing(s.gap, -trace(step.deps));
  State contact = s;
  contact.gap = closing.gap;
  auto trial = attempt_pair<Pair>(law, contact, (T(1.0) - closing.share) * step, tolerance);
  trial.state = select_state(closing.stays, contact, trial.state);
  trial.error = select(closing.stays, T(0.0), trial.error);
  return trial;
}

}  // namespace scarp
