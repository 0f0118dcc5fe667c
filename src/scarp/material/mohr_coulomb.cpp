#include "scarp/material/mohr_coulomb.hpp"

namespace scarp {
namespace {

constexpr double degree = 0.017453292519943295769;

}  // namespace

MohrCoulomb::MohrCoulomb(const Parameters& p)
    : ElastoplasticLaw(p.E, p.nu),
      parameters_(p),
      softens_(p.c.active() || p.phi.active() || p.psi.active()),
      sin_phi_(std::sin(degree * p.phi.peak)),
      cos_phi_(std::cos(degree * p.phi.peak)),
      sin_psi_(std::sin(degree * p.psi.peak)) {}

ModelDescription MohrCoulomb::description() {
  const Bound from_zero{0.0, false}, right{90.0, true};
  return elastoplastic::described_parting(
      "mohr-coulomb", "linear elasticity with Mohr and Coulomb's strength, dilation, tension cut-off and softening",
      {elastoplastic::young(),
       elastoplastic::poisson(),
       {"c", "c", "stress", "cohesion, peak", from_zero, {}, {}},
       {"phi", "φ", "degrees", "angle of friction, peak", from_zero, right, {}},
       {"psi", "ψ", "degrees", "angle of dilation, no larger than phi", from_zero, right, {}},
       {"tension", "t", "stress", "tensile strength, no larger than the apex c cot φ is taken", from_zero, {}, 1e30},
       {"c_residual", "c_r", "stress", "residual cohesion", from_zero, {}, {}, "c"},
       {"phi_residual", "φ_r", "degrees", "residual angle of friction", from_zero, right, {}, "phi"},
       {"psi_residual", "ψ_r", "degrees", "angle of dilation at residual strength", from_zero, right, 0.0},
       elastoplastic::softening_strain()});
}

MohrCoulomb MohrCoulomb::from_values(const std::map<std::string, double>& v, std::vector<Problem>& problems,
                                     std::vector<Problem>&) {
  const double over = v.at("epsp_residual");
  const MohrCoulomb law({v.at("E"),
                         v.at("nu"),
                         {v.at("c"), v.at("c_residual"), over},
                         {v.at("phi"), v.at("phi_residual"), over},
                         {v.at("psi"), v.at("psi_residual"), over},
                         v.at("tension")});
  const auto& p = law.parameters_;
  elastoplastic::check_softening("c", p.c, problems);
  elastoplastic::check_softening("phi", p.phi, problems);
  elastoplastic::check_frictional(p.c, p.phi, p.psi, problems);
  // At p = 0; the part of φ grows with p, and shows as a failure of the update there.
  const double fall = over > 0 ? (law.strength(over).cohesion - law.strength(0.0).cohesion) / over : 0.0;
  elastoplastic::check_slope("2 c cos phi", fall, 3.0 * law.elasticity_.G, problems);
  return law;
}

}  // namespace scarp
