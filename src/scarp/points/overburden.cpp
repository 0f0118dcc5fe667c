#include "scarp/points/overburden.hpp"

#include <algorithm>
#include <utility>

namespace scarp {

Overburden::Overburden(std::vector<Layer> layers, double gravity) : layers_(std::move(layers)), gravity_(gravity) {}

double Overburden::vertical_stress(const Vec<2>& x) const {
  double stress = 0;
  for (const auto& layer : layers_) {
    for (const auto& cut : vertical_cuts(layer.polygon, x[0])) {
      stress += layer.density * gravity_ * std::max(0.0, cut[1] - std::max(cut[0], x[1]));
    }
  }
  return stress;
}

}  // namespace scarp
