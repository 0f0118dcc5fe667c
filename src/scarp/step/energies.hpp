// The terms of the balance of energy, declared once: a member of Energies and its line in energy_terms. What a step
// books, a run adds up, history.csv has columns for and plots and documents show follows from these.
#pragma once

#include <array>

namespace scarp {

/// Energies [kJ; per metre of thickness in plane strain, per radian in a body of revolution] of a step or a run.
struct Energies {
  double work_gravity = 0, work_stress = 0, work_release = 0, work_boundary = 0, work_interaction = 0;
  double dissipation_damping = 0, dissipation_friction = 0, dissipation_pic = 0, dissipation_waves = 0;
  double dissipation_absorbing = 0, stored_sides = 0;
  double energy_reweighted = 0;

  Energies& operator+=(const Energies& other);
};

struct EnergyTerm {
  /// Which runs have use for a term, and a column for it in history.csv.
  enum class Use { always, release, absorbing, interaction };

  const char* key;  ///< column of history.csv
  double Energies::*sum;
  int sign;  ///< the change of kinetic energy by it is so many times its sum; 0: no part of the balance
  Use use;
  const char* meaning;
};

inline constexpr std::array energy_terms{
    EnergyTerm{"work_gravity", &Energies::work_gravity, 1, EnergyTerm::Use::always, "work of gravity"},
    EnergyTerm{"work_stress", &Energies::work_stress, -1, EnergyTerm::Use::always,
               "work of stress on strain: stored and dissipated in the soil"},
    EnergyTerm{"work_release", &Energies::work_release, 1, EnergyTerm::Use::release,
               "work of the forces that hold the initial imbalance back; where a stage has `release`"},
    EnergyTerm{"work_boundary", &Energies::work_boundary, 1, EnergyTerm::Use::absorbing,
               "work of the forces with which absorbing sides were held; where there are such sides"},
    EnergyTerm{"work_interaction", &Energies::work_interaction, 1, EnergyTerm::Use::interaction,
               "work of fields of velocity on each other; where a body has several"},
    EnergyTerm{"dissipation_damping", &Energies::dissipation_damping, -1, EnergyTerm::Use::always,
               "taken by local damping"},
    EnergyTerm{"dissipation_friction", &Energies::dissipation_friction, -1, EnergyTerm::Use::always,
               "taken by walls with friction: along them by friction, across them by impact"},
    EnergyTerm{"dissipation_pic", &Energies::dissipation_pic, -1, EnergyTerm::Use::always,
               "taken by the PIC share of the velocity update"},
    EnergyTerm{"dissipation_waves", &Energies::dissipation_waves, -1, EnergyTerm::Use::always,
               "taken by the damping of stress rates"},
    EnergyTerm{"dissipation_absorbing", &Energies::dissipation_absorbing, -1, EnergyTerm::Use::absorbing,
               "taken by the dashpots of absorbing sides; where there are such sides"},
    EnergyTerm{"stored_sides", &Energies::stored_sides, -1, EnergyTerm::Use::absorbing,
               "stored in the springs of absorbing sides; where there are such sides"},
    EnergyTerm{"energy_reweighted", &Energies::energy_reweighted, 0, EnergyTerm::Use::always,
               "stored energy that points brought in or took along where they changed element; no part of the balance "
               "([theory.md](theory.md#energy-ledger))"}};
static_assert(sizeof(Energies) == energy_terms.size() * sizeof(double), "each energy has its line");

inline Energies& Energies::operator+=(const Energies& other) {
  for (const auto& term : energy_terms) this->*term.sum += other.*term.sum;
  return *this;
}

}  // namespace scarp
