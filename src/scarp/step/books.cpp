#include "scarp/step/books.hpp"

#include <algorithm>

namespace scarp {

template <int Dim>
StepBooks<Dim>& StepBooks<Dim>::operator+=(const StepBooks& other) {
  using B = StepBooks;
  Energies::operator+=(other);
  for (double B::*sum : {&B::unbalanced_force, &B::weight, &B::kinetic_energy_before, &B::kinetic_energy, &B::mass,
                         &B::removed_energy, &B::removed_mass})
    this->*sum += other.*sum;
  for (std::int64_t B::*sum : {&B::removed, &B::massless_nodes, &B::changed_element, &B::left_mesh})
    this->*sum += other.*sum;
  for (int j = 0; j < Dim; ++j) momentum[j] += other.momentum[j];
  for (int i = 0; i < phases; ++i) seconds[i] += other.seconds[i];
  max_velocity = std::max(max_velocity, other.max_velocity);
  stress += other.stress;
  search += other.search;
  return *this;
}

template struct StepBooks<2>;
template struct StepBooks<3>;

}  // namespace scarp
