#include "scarp/run/rest_watch.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace scarp::run {

template <int Dim>
double weight_energy(const Body<Dim>& body) {
  double low = std::numeric_limits<double>::infinity(), high = -low, mass = 0;
  for (const auto& block : body.blocks) {
    for (int i = 0; i < block.size(); ++i) {
      low = std::min(low, block.points.x[Dim - 1][i]);
      high = std::max(high, block.points.x[Dim - 1][i]);
      mass += block.points.mass[i];
    }
  }
  double g2 = 0;
  for (const double g : body.gravity) g2 += g * g;
  return mass * std::sqrt(g2) * (high - low);
}

template double weight_energy<2>(const Body<2>&);
template double weight_energy<3>(const Body<3>&);

}  // namespace scarp::run
