#include "scarp/run/ledger.hpp"

namespace scarp::run {

template <int Dim>
void Ledger<Dim>::add(double step, int points, const StepTotals<Dim>& totals) {
  time += step;
  dt = step;
  ++steps;
  point_steps += points;
  last = totals;
  search += totals.search;
  Energies::operator+=(totals);
  removed_kinetic_energy += totals.removed_energy;
  removed_mass += totals.removed_mass;
  removed_points += totals.removed;
  left_mesh += totals.removed;
  for (int i = 0; i < phases; ++i) seconds[i] += totals.seconds[i];
  failures += totals.stress.failures;
  corrected += totals.stress.corrected;
  substeps += totals.stress.substeps;
}

template <int Dim>
double Ledger<Dim>::energy_error() const {
  double balanced = 0;
  for (const auto& term : energy_terms) {
    if (term.sign != 0) balanced += term.sign * this->*term.sum;
  }
  return last.kinetic_energy - initial_kinetic_energy + removed_kinetic_energy - balanced;
}

template struct Ledger<2>;
template struct Ledger<3>;

}  // namespace scarp::run
