// Watches whether the books of energy close, and says so where they do not.
#pragma once

#include <string>

#include "scarp/run/ledger.hpp"

namespace scarp::run {

/// The energy that nobody accounts for, against the energies of the run, since the cut or since the start of a run
/// without one.
class EnergyCheck {
 public:
  /// Errors are not compared with less energy than `quiet_energy` [kJ].
  template <int Dim>
  EnergyCheck(const Ledger<Dim>& ledger, double quiet_energy);

  /// Counts from here.
  template <int Dim>
  void start(const Ledger<Dim>& ledger);

  /// Looks at the ledger after a step.
  template <int Dim>
  void step(const Ledger<Dim>& ledger);

  /// |error| over |work of gravity|, as the ledger has them (summary.json).
  template <int Dim>
  double relative(const Ledger<Dim>& ledger) const;

  /// |error| over the largest of the kinetic energy and |work of gravity| up to now. The error is taken at the time at
  /// which the work is: velocities are half a step behind, so their energy is the mean of before and after the step.
  double ratio() const { return ratio_; }
  double largest_ratio() const { return largest_ratio_; }  ///< in the whole run
  double largest_at() const { return largest_at_; }        ///< its time [s]

  static constexpr double worth_a_warning = 0.01;

  /// f(Entry, member) for each that a checkpoint keeps (archive.hpp).
  template <class Self, class F>
  static void each_saved(Self& c, F&& f) {
    f(Entry{"quiet_energy", "kJ", "errors are not compared with less"}, c.quiet_energy_);
    f(Entry{"start_error", "kJ", "error of the ledger where the count starts"}, c.start_error_);
    f(Entry{"start_work", "kJ", "work of gravity there"}, c.start_work_);
    f(Entry{"last_error", "kJ", "error of the ledger after the last step"}, c.last_error_);
    f(Entry{"last_kinetic", "kJ", "kinetic energy after the last step, with what was removed"}, c.last_kinetic_);
    f(Entry{"scale", "kJ", "largest energy since the count starts"}, c.scale_);
    f(Entry{"steps", "", "since the count starts"}, c.steps_);
    f(Entry{"ratio", "", "error over that energy, now"}, c.ratio_);
    f(Entry{"largest_ratio", "", "the largest in the run"}, c.largest_ratio_);
    f(Entry{"largest_at", "s", "its time"}, c.largest_at_);
  }

 private:
  double quiet_energy_;
  double start_error_ = 0, start_work_ = 0;   ///< of the ledger where the count starts
  double last_error_ = 0, last_kinetic_ = 0;  ///< of the ledger after the step before; kinetic with what was removed
  double scale_ = 0;
  int steps_ = 0;
  double ratio_ = 0, largest_ratio_ = 0, largest_at_ = 0;
};

/// A warning that the books do not close, with what to try.
std::string energy_warning(const EnergyCheck& check);

/// What may help.
inline constexpr const char* energy_remedy =
    "take a smaller safety in [method], points no farther apart than half an element, or shape = \"gimp\"";

}  // namespace scarp::run
