#include "scarp/run/energy_check.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

namespace scarp::run {
namespace {

/// A body that a load strikes starts with an error of the order of its first step's energy, which twenty steps leave
/// far below a per cent: ¼ (a dt)² against ½ (20 a dt)².
constexpr int first_steps = 20;

}  // namespace

template <int Dim>
EnergyCheck::EnergyCheck(const Ledger<Dim>& ledger, double quiet_energy) : quiet_energy_(quiet_energy) {
  start(ledger);
}

template <int Dim>
void EnergyCheck::start(const Ledger<Dim>& ledger) {
  start_error_ = last_error_ = ledger.energy_error();
  start_work_ = ledger.work_gravity;
  last_kinetic_ = ledger.last.kinetic_energy + ledger.removed_kinetic_energy;
  scale_ = std::max(quiet_energy_, ledger.last.kinetic_energy);
  steps_ = 0;
  ratio_ = 0;
}

template <int Dim>
void EnergyCheck::step(const Ledger<Dim>& ledger) {
  const double kinetic = ledger.last.kinetic_energy + ledger.removed_kinetic_energy;
  const double error = last_error_ + 0.5 * (kinetic - last_kinetic_) - start_error_;
  last_error_ = ledger.energy_error();
  last_kinetic_ = kinetic;
  scale_ = std::max({scale_, ledger.last.kinetic_energy, std::abs(ledger.work_gravity - start_work_)});
  if (++steps_ < first_steps || !(scale_ > 0)) return;
  ratio_ = std::abs(error) / scale_;
  if (ratio_ <= largest_ratio_) return;
  largest_ratio_ = ratio_;
  largest_at_ = ledger.time;
}

template <int Dim>
double EnergyCheck::relative(const Ledger<Dim>& ledger) const {
  const double work = std::abs(ledger.work_gravity - start_work_);
  return work > 0 ? std::abs(ledger.energy_error() - start_error_) / work : 0.0;
}

std::string energy_warning(const EnergyCheck& check) {
  return fmt::format(
      "the books of energy do not close: {:.2g} % of the run's energies are unaccounted for at t = {:.4g} s, {:.2g} % "
      "now (right: below {:g} %); {}",
      100 * check.largest_ratio(), check.largest_at(), 100 * check.ratio(), 100 * EnergyCheck::worth_a_warning,
      energy_remedy);
}

template EnergyCheck::EnergyCheck(const Ledger<2>&, double);
template EnergyCheck::EnergyCheck(const Ledger<3>&, double);
template void EnergyCheck::start(const Ledger<2>&);
template void EnergyCheck::start(const Ledger<3>&);
template void EnergyCheck::step(const Ledger<2>&);
template void EnergyCheck::step(const Ledger<3>&);
template double EnergyCheck::relative(const Ledger<2>&) const;
template double EnergyCheck::relative(const Ledger<3>&) const;

}  // namespace scarp::run
