#include "scarp/material/viscoplastic_subloading.hpp"

#include <algorithm>

namespace scarp {

ModelDescription ViscoplasticSubloading::description() {
  auto d = Subloading::description();
  d.name = "viscoplastic-subloading";
  d.summary = "the subloading model with a plastic strain that takes time: overstress above the static ratio R_s";
  const Bound zero{0.0, true}, one{1.0, false}, above_one{1.0, true};
  const std::vector<ParameterInfo> viscous = {
      {"mu",
       "μ",
       "time",
       "viscosity: the time that a unit of plastic strain takes at ⟨R − R_s⟩ⁿ = R_m − R",
       zero,
       {},
       {}},
      {"n", "n", "-", "exponent of the overstress", one, {}, {}},
      {"R_m", "R_m", "-", "ratio R that no stress exceeds, however fast the straining", above_one, {}, {}}};
  const auto numerical =
      std::find_if(d.parameters.begin(), d.parameters.end(), [](const auto& p) { return p.key == "R_min"; });
  d.parameters.insert(numerical, viscous.begin(), viscous.end());
  d.state.push_back({"overstress", "R − R_s", "-", "overstress, which drives the plastic strain", FieldKind::scalar});
  d.derived.insert(d.derived.begin() + 1, {"R_s", "R_s", "-", "static ratio, to which R relaxes", FieldKind::scalar});
  return d;
}

ViscoplasticSubloading ViscoplasticSubloading::from_values(const std::map<std::string, double>& v,
                                                           std::vector<Problem>& problems,
                                                           std::vector<Problem>& warnings) {
  return ViscoplasticSubloading(Subloading::from_values(v, problems, warnings), {v.at("mu"), v.at("n"), v.at("R_m")});
}

template <int N>
ViscoplasticSubloading::State<double, N> ViscoplasticSubloading::initial_state(const Sym<double, N>& sigma,
                                                                               double vertical, const Values& keys,
                                                                               std::vector<Problem>& problems) const {
  return {law_.initial_state(sigma, vertical, keys, problems), 0.0};
}

template ViscoplasticSubloading::State<double, 4> ViscoplasticSubloading::initial_state<4>(const Sym<double, 4>&,
                                                                                           double, const Values&,
                                                                                           std::vector<Problem>&) const;
template ViscoplasticSubloading::State<double, 6> ViscoplasticSubloading::initial_state<6>(const Sym<double, 6>&,
                                                                                           double, const Values&,
                                                                                           std::vector<Problem>&) const;

}  // namespace scarp
