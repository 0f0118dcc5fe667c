#include "scarp/material/tresca.hpp"

namespace scarp {

ModelDescription Tresca::description() {
  const Bound zero{0.0, true};
  return elastoplastic::described(
      "tresca", "linear elasticity with Tresca's strength, softening: undrained clay in total stress",
      {elastoplastic::young(),
       elastoplastic::poisson(),
       {"s_u", "s_u", "stress", "undrained shear strength, (σ1 − σ3)/2 at failure, peak", zero, {}, {}},
       {"s_u_residual", "s_u,r", "stress", "residual undrained shear strength", zero, {}, {}, "s_u"},
       elastoplastic::softening_strain()});
}

Tresca Tresca::from_values(const std::map<std::string, double>& v, std::vector<Problem>& problems,
                           std::vector<Problem>&) {
  const Tresca law({v.at("E"), v.at("nu"), {v.at("s_u"), v.at("s_u_residual"), v.at("epsp_residual")}});
  elastoplastic::check_softening("s_u", law.parameters_.s_u, problems);
  // Δκ' = 2 s_u'/3G < 1 on an edge, less on the plane
  elastoplastic::check_slope("s_u", law.parameters_.s_u.slope(), 1.5 * law.elasticity_.G, problems);
  return law;
}

}  // namespace scarp
