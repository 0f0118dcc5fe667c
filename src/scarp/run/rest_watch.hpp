// Is the body at rest?
#pragma once

#include "scarp/input/case.hpp"
#include "scarp/run/ledger.hpp"
#include "scarp/step/body.hpp"

namespace scarp::run {

/// The energy that the weight of the body has over its height [kJ]: the measure of a small energy.
template <int Dim>
double weight_energy(const Body<Dim>& body);

/// Watches whether the body is at rest for long enough.
class RestWatch {
 public:
  template <int Dim>
  RestWatch(const input::RestInput& rest, const Body<Dim>& body) : rest_(rest), scale_(weight_energy(body)) {}

  template <int Dim>
  bool at_rest(const Ledger<Dim>& ledger) {
    const bool calm = ledger.unbalanced_ratio() <= rest_.unbalanced && kinetic(ledger) <= rest_.kinetic;
    calm_for_ = calm ? calm_for_ + ledger.dt : 0.0;
    return calm && calm_for_ >= rest_.hold;
  }

  /// Kinetic energy in parts of the weight's.
  template <int Dim>
  double kinetic(const Ledger<Dim>& ledger) const {
    return scale_ > 0 ? ledger.last.kinetic_energy / scale_ : 0;
  }

 private:
  const input::RestInput& rest_;
  double scale_;
  double calm_for_ = 0;  ///< [s]
};

}  // namespace scarp::run
