#include "scarp/points/overburden.hpp"

#include <algorithm>
#include <utility>

namespace scarp {

template <int Dim>
OverburdenOf<Dim>::OverburdenOf(std::vector<Layer> layers, double gravity)
    : layers_(std::move(layers)), gravity_(gravity) {}

template <int Dim>
double OverburdenOf<Dim>::vertical_stress(const Vec<Dim>& x) const {
  double stress = 0;
  for (const auto& layer : layers_) {
    for (const auto& cut : cuts_through(layer.region, x)) {
      stress += layer.density * gravity_ * std::max(0.0, cut[1] - std::max(cut[0], x[Dim - 1]));
    }
  }
  return stress;
}

template class OverburdenOf<2>;
template class OverburdenOf<3>;

}  // namespace scarp
