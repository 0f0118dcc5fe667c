#include "scarp/material/linear_elastic.hpp"

namespace scarp {

ModelDescription LinearElastic::description() {
  return {"linear-elastic",
          "isotropic linear elasticity",
          {{"E", "E", "stress", "Young's modulus", Bound{0.0, true}, {}, {}},
           {"nu", "ν", "-", "Poisson's ratio", Bound{-1.0, true}, Bound{0.5, true}, {}}},
          {},
          {},
          {}};
}

LinearElastic LinearElastic::from_values(const std::map<std::string, double>& values, std::vector<Problem>&,
                                         std::vector<Problem>&) {
  return LinearElastic({values.at("E"), values.at("nu")});
}

}  // namespace scarp
