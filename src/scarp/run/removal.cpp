#include "scarp/run/removal.hpp"

#include <cstdint>
#include <limits>

#include "scarp/base/error.hpp"
#include "scarp/base/exact_sum.hpp"
#include "scarp/comm/alone.hpp"

namespace scarp::run {

template <int Dim>
Removal<Dim>::Removal(const input::RemovalInputOf<Dim>& input, double start)
    : input_(input), start_(start), box_(bounds(input.shape())) {}

template <int Dim>
double Removal<Dim>::next_time() const {
  if (finished()) return std::numeric_limits<double>::infinity();
  return input_.lifts == 1 ? start_ : start_ + input_.over * done_ / (input_.lifts - 1);
}

template <int Dim>
void Removal<Dim>::take_due(double time, Body<Dim>& body, Ledger<Dim>& ledger) {
  constexpr int up = Dim - 1;
  const int before = done_;
  while (!finished() && next_time() <= time) ++done_;
  if (done_ == before) return;
  // A lift takes away what stands above its bottom; the last one everything inside, whatever round-off says of the
  // bottom.
  const double bottom = finished() ? -std::numeric_limits<double>::infinity()
                                   : box_.high[up] - (box_.high[up] - box_.low[up]) * done_ / input_.lifts;
  std::int64_t count = 0;
  ExactSum mass, kinetic_energy;
  for (auto& block : body.blocks()) {
    const auto& points = block.points;
    std::vector<std::uint8_t> gone(points.mass.size(), 0);
    for (int i = 0; i < block.size(); ++i) {
      const auto x = position_of(points, i);
      if (x[up] < bottom || !contains(input_.shape(), x)) continue;
      gone[i] = 1;
      ++count;
      mass.add(points.mass[i]);
      kinetic_energy.add(kinetic_energy_of(points, i));
    }
    remove_points(block, gone);
  }
  ledger.removed_points += comm::sum_of_all(count);
  ledger.removed_mass += comm::sum_of_all(mass);
  ledger.removed_kinetic_energy += comm::sum_of_all(kinetic_energy);
  if (comm::sum_of_all(std::int64_t{body.point_count()}) == 0) {
    throw RunError("the removal of this stage leaves no soil", "", "make it smaller");
  }
  reorder(body);
}

template class Removal<2>;
template class Removal<3>;

}  // namespace scarp::run
