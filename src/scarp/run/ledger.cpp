#include "scarp/run/ledger.hpp"

namespace scarp::run {

template <int Dim>
void Ledger<Dim>::add(double step, int points, const StepBooks<Dim>& books) {
  time += step;
  dt = step;
  ++steps;
  point_steps += points;
  last = books;
  search += books.search;
  Energies::operator+=(books);
  removed_kinetic_energy += books.removed_energy;
  removed_mass += books.removed_mass;
  removed_points += books.removed;
  for (int i = 0; i < phases; ++i) seconds[i] += books.seconds[i];
  failures += books.stress.failures;
  corrected += books.stress.corrected;
  substeps += books.stress.substeps;
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
