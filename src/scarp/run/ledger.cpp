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
  for (const auto& term : balance()) this->*term.sum += books.*term.of_step;
  energy_reweighted += books.energy_reweighted;
  removed_kinetic_energy += books.removed_energy;
  removed_mass += books.removed_mass;
  removed_points += books.removed;
  for (int i = 0; i < phases; ++i) seconds[i] += books.seconds[i];
  failures += books.stress.failures;
  corrected += books.stress.corrected;
  substeps += books.stress.substeps;
}

template <int Dim>
auto Ledger<Dim>::balance() -> const std::array<Term, terms>& {
  using L = Ledger;
  using B = StepBooks<Dim>;
  static constexpr std::array<Term, terms> list = {{
      {"work_gravity", &L::work_gravity, &B::work_gravity, 1},
      {"work_stress", &L::work_stress, &B::work_stress, -1},
      {"work_release", &L::work_release, &B::work_release, 1, Use::release},
      {"work_boundary", &L::work_boundary, &B::work_boundary, 1, Use::absorbing},
      {"dissipation_damping", &L::dissipation_damping, &B::dissipation_damping, -1},
      {"dissipation_friction", &L::dissipation_friction, &B::dissipation_friction, -1},
      {"dissipation_pic", &L::dissipation_pic, &B::dissipation_pic, -1},
      {"dissipation_waves", &L::dissipation_waves, &B::dissipation_waves, -1},
      {"dissipation_absorbing", &L::dissipation_absorbing, &B::dissipation_absorbing, -1, Use::absorbing},
      {"stored_sides", &L::stored_sides, &B::stored_sides, -1, Use::absorbing},
  }};
  return list;
}

template <int Dim>
double Ledger<Dim>::energy_error() const {
  double balanced = 0;
  for (const auto& term : balance()) balanced += term.sign * this->*term.sum;
  return last.kinetic_energy - initial_kinetic_energy + removed_kinetic_energy - balanced;
}

template struct Ledger<2>;
template struct Ledger<3>;

}  // namespace scarp::run
