#include "scarp/run/removal.hpp"

#include <limits>

#include "scarp/base/error.hpp"

namespace scarp::run {

Removal::Removal(const input::RemovalInput& input, double start)
    : input_(input), start_(start), box_(bounds(input.polygon)) {}

double Removal::next_time() const {
  if (finished()) return std::numeric_limits<double>::infinity();
  return input_.lifts == 1 ? start_ : start_ + input_.over * done_ / (input_.lifts - 1);
}

void Removal::take_due(double time, Body<2>& body, Ledger& ledger) {
  const int before = done_;
  while (!finished() && next_time() <= time) ++done_;
  if (done_ == before) return;
  // A lift takes away what stands above its bottom; the last one everything inside, whatever round-off says of the
  // bottom.
  const double bottom = finished() ? -std::numeric_limits<double>::infinity()
                                   : box_.high[1] - (box_.high[1] - box_.low[1]) * done_ / input_.lifts;
  for (auto& block : body.blocks) {
    const auto& points = block.points;
    std::vector<std::uint8_t> gone(points.mass.size(), 0);
    for (int i = 0; i < block.size(); ++i) {
      const Vec<2> x{points.x[0][i], points.x[1][i]};
      if (x[1] < bottom || !contains(input_.polygon, x)) continue;
      gone[i] = 1;
      ++ledger.removed_points;
      ledger.removed_mass += points.mass[i];
      ledger.removed_kinetic_energy +=
          0.5 * points.mass[i] * (points.v[0][i] * points.v[0][i] + points.v[1][i] * points.v[1][i]);
    }
    remove_points(block, gone);
  }
  if (body.point_count() == 0) {
    throw RunError("the removal of this stage leaves no soil", "", "make its polygon smaller");
  }
  reorder(body);
}

}  // namespace scarp::run
