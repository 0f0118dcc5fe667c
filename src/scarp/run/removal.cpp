#include "scarp/run/removal.hpp"

#include <limits>

#include "scarp/base/error.hpp"

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
  for (auto& block : body.blocks()) {
    const auto& points = block.points;
    std::vector<std::uint8_t> gone(points.mass.size(), 0);
    for (int i = 0; i < block.size(); ++i) {
      const auto x = position_of(points, i);
      if (x[up] < bottom || !contains(input_.shape(), x)) continue;
      gone[i] = 1;
      ++ledger.removed_points;
      ledger.removed_mass += points.mass[i];
      double v2 = 0;
      for (int j = 0; j < Dim; ++j) v2 += points.v[j][i] * points.v[j][i];
      ledger.removed_kinetic_energy += 0.5 * points.mass[i] * v2;
    }
    remove_points(block, gone);
  }
  if (body.point_count() == 0) {
    throw RunError("the removal of this stage leaves no soil", "", "make it smaller");
  }
  reorder(body);
}

template class Removal<2>;
template class Removal<3>;

}  // namespace scarp::run
