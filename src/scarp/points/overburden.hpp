// The weight of the soil above a point, in sloping and layered ground.
#pragma once

#include <vector>

#include "scarp/base/solid.hpp"

namespace scarp {

/// Vertical stress from the weight of all soil straight above: exact for regions of uniform density. Soil above a gap
/// counts too.
template <int Dim>
class OverburdenOf {
 public:
  struct Layer {
    Region<Dim> region;
    double density;
  };

  /// `gravity` is the size of the gravitational acceleration, which acts along −y in two dimensions, −z in three.
  OverburdenOf(std::vector<Layer> layers, double gravity);

  /// Compression positive, in the unit of density × gravity × length.
  double vertical_stress(const Vec<Dim>& x) const;

 private:
  std::vector<Layer> layers_;
  double gravity_;
};
using Overburden = OverburdenOf<2>;

}  // namespace scarp
