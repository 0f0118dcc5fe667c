#include "scarp/material/von_mises.hpp"

namespace scarp {

ModelDescription VonMises::description() {
  const Bound zero{0.0, true};
  return elastoplastic::described(
      "von-mises", "linear elasticity with von Mises' strength, softening: undrained clay in total stress",
      {elastoplastic::young(),
       elastoplastic::poisson(),
       {"s_u", "s_u", "stress", "undrained shear strength in plane strain and simple shear, peak", zero, {}, {}},
       {"s_u_residual", "s_u,r", "stress", "residual undrained shear strength", zero, {}, {}, "s_u"},
       elastoplastic::softening_strain()});
}

VonMises VonMises::from_values(const std::map<std::string, double>& v, std::vector<Problem>& problems,
                               std::vector<Problem>&) {
  const VonMises law({v.at("E"), v.at("nu"), {v.at("s_u"), v.at("s_u_residual"), v.at("epsp_residual")}});
  elastoplastic::check_softening("s_u", law.parameters_.s_u, problems);
  // Δκ' = √3 s_u'/3G < 1
  elastoplastic::check_slope("s_u", law.parameters_.s_u.slope(), sqrt3 * law.elasticity_.G, problems);
  return law;
}

}  // namespace scarp
