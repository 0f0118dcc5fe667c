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
  work_gravity += books.work_gravity;
  work_stress += books.work_stress;
  dissipation_damping += books.dissipation_damping;
  dissipation_friction += books.dissipation_friction;
  dissipation_pic += books.dissipation_pic;
  dissipation_waves += books.dissipation_waves;
  removed_kinetic_energy += books.removed_energy;
  removed_mass += books.removed_mass;
  removed_points += books.removed;
  for (int i = 0; i < phases; ++i) seconds[i] += books.seconds[i];
  failures += books.stress.failures;
  corrected += books.stress.corrected;
  substeps += books.stress.substeps;
}

template struct Ledger<2>;
template struct Ledger<3>;

}  // namespace scarp::run
