// Is the body at rest?
#pragma once

#include <vector>

#include "scarp/input/case.hpp"
#include "scarp/run/ledger.hpp"
#include "scarp/step/body.hpp"

namespace scarp::run {

/// Height of the points [m].
template <int Dim>
double height(const Body<Dim>& body);

/// The energy that the weight of the body has over its height [kJ]: the measure of a small energy.
template <int Dim>
double weight_energy(const Body<Dim>& body);

/// Watches whether the body is at rest for long enough, and does not creep.
template <int Dim>
class RestWatch {
 public:
  RestWatch(const input::RestInput& rest, const Body<Dim>& body);

  /// Looks at the body after a step.
  bool at_rest(const Ledger<Dim>& ledger, const Body<Dim>& body);

  /// Kinetic energy in parts of the weight's.
  double kinetic(const Ledger<Dim>& ledger) const { return energy_ > 0 ? ledger.last.kinetic_energy / energy_ : 0; }
  /// The largest displacement of a point over `hold` seconds, or a tenth of √(height/g) where that is longer,
  /// in heights of the body per second, when forces and energy were last small for so long; infinite if they never
  /// were.
  double rate() const { return rate_; }

  /// f(Entry, member) for each that a checkpoint keeps (archive.hpp).
  template <class Self, class F>
  static void each_saved(Self& w, F&& f) {
    f(Entry{"energy", "kJ", "of the body's weight over its height, at the start of the stage"}, w.energy_);
    f(Entry{"height", "m", "of the body, at the start of the stage"}, w.height_);
    f(Entry{"window", "s", "how long it must be calm"}, w.window_);
    f(Entry{"watching", "", "1 where forces and energy were small in the last step"}, w.watching_);
    f(Entry{"calm_for", "s", "how long they have been"}, w.calm_for_);
    f(Entry{"moved_for", "s", "how long ago points were at `place`"}, w.moved_for_);
    f(Entry{"rate", "1/s", "last rate of displacement found, in heights of the body"}, w.rate_);
    f(Entry{"place", "m", "where the points were, by their ids"}, w.place_);
  }

 private:
  void remember(const Body<Dim>& body);
  double largest_path(const Body<Dim>& body) const;

  input::RestInput rest_;
  double energy_, height_, window_;
  bool watching_ = false;                ///< were forces and energy small in the last step?
  double calm_for_ = 0, moved_for_ = 0;  ///< how long they have been, and since when `place_` is known [s]
  double rate_;
  std::vector<Vec<Dim>> place_;  ///< of each point by its number, where it was `moved_for_` ago
};

}  // namespace scarp::run
