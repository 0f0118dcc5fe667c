// The weight of the soil above a point, in sloping and layered ground.
#pragma once

#include <vector>

#include "scarp/base/polygon.hpp"

namespace scarp {

/// Vertical stress from the weight of all soil straight above: exact for polygons of uniform density. Soil above a gap
/// counts too.
class Overburden {
 public:
  struct Layer {
    Polygon polygon;
    double density;
  };

  /// `gravity` is the size of the gravitational acceleration, which acts along −y.
  Overburden(std::vector<Layer> layers, double gravity);

  /// Compression positive, in the unit of density × gravity × length.
  double vertical_stress(const Vec<2>& x) const;

 private:
  std::vector<Layer> layers_;
  double gravity_;
};

}  // namespace scarp
