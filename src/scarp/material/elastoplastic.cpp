#include "scarp/material/elastoplastic.hpp"

#include <fmt/format.h>
#include <utility>

#include "scarp/material/initial_values.hpp"

namespace scarp::elastoplastic {

ParameterInfo young() {
  return {"E", "E", "stress", "Young's modulus", Bound{0.0, true}, {}, {}};
}

ParameterInfo poisson() {
  return {"nu", "ν", "-", "Poisson's ratio", Bound{-1.0, true}, Bound{0.5, true}, {}};
}

ParameterInfo softening_strain() {
  return {"epsp_residual",
          "κ_r",
          "-",
          "accumulated plastic deviatoric strain at which the residual values are reached (0: no softening)",
          Bound{0.0, false},
          {},
          0.0};
}

ModelDescription described(const std::string& name, const std::string& summary, std::vector<ParameterInfo> parameters) {
  return {name,
          summary,
          std::move(parameters),
          {{"epsp", "ε^p", "-", "plastic strain", FieldKind::tensor},
           {"epsp_acc", "κ", "-", "accumulated plastic deviatoric strain, ∫ √(2/3) ‖dev dε^p‖", FieldKind::scalar}},
          {{"epsp_v", "ε_v^p", "-", "plastic volumetric strain, compression positive", FieldKind::scalar},
           {"epsp_q", "ε_q^p", "-", "plastic deviatoric strain, √(2/3) ‖dev ε^p‖", FieldKind::scalar}},
          {{"epsp_acc", "number ≥ 0",
            "κ that the soil has undergone before: strength on an old slip surface; standard 0"}}};
}

ModelDescription described_parting(const std::string& name, const std::string& summary,
                                   std::vector<ParameterInfo> parameters) {
  auto d = described(name, summary, std::move(parameters));
  d.state.push_back(gap_field());
  return d;
}

void check_softening(const std::string& key, const Softening& strength, std::vector<Problem>& problems) {
  if (strength.residual > strength.peak) {
    problems.push_back({key + "_residual", fmt::format("{0}_residual is no larger than {0}", key),
                        fmt::format("{} = {}, {}_residual = {}", key, strength.peak, key, strength.residual),
                        "strength falls from its peak to its residual value"});
  } else if (strength.residual < strength.peak && !(strength.over > 0)) {
    problems.push_back({"epsp_residual", fmt::format("{}_residual needs the strain that it is reached at", key),
                        fmt::format("epsp_residual = {}", strength.over),
                        fmt::format("give epsp_residual > 0, or leave {}_residual out", key)});
  }
}

void check_slope(const std::string& key, double slope, double steepest, std::vector<Problem>& problems) {
  if (-slope < steepest) return;
  problems.push_back(
      {"epsp_residual",
       fmt::format("{} falls faster with plastic strain than the elastic stress can: no stable answer", key),
       fmt::format("{:.4g} per unit of strain; the limit is {:.4g}", -slope, steepest),
       "enlarge epsp_residual, the residual strength or E"});
}

void check_frictional(const Softening& c, const Softening& phi, const Softening& psi, std::vector<Problem>& problems) {
  const auto check = [&](const std::string& end, double c_, double phi_, double psi_) {
    if (psi_ > phi_) {
      problems.push_back({"psi" + end, fmt::format("psi{0} is no larger than phi{0}", end),
                          fmt::format("psi{0} = {1}, phi{0} = {2}", end, psi_, phi_),
                          "more dilation than friction makes energy from nothing"});
    }
    if (!(c_ > 0) && !(phi_ > 0)) {
      problems.push_back({"c" + end, fmt::format("c{0} and phi{0} are not both 0", end), "no strength at all",
                          "give some cohesion or friction"});
    }
  };
  check("", c.peak, phi.peak, psi.peak);
  if (psi.over > 0) check("_residual", c.residual, phi.residual, psi.residual);
}

double initial_kappa(const Values& keys, std::vector<Problem>& problems) {
  const double kappa = initial::number(keys, "epsp_acc", problems).value_or(0.0);
  if (kappa >= 0 && std::isfinite(kappa)) return kappa;
  problems.push_back({"epsp_acc", "the initial epsp_acc is at least 0", fmt::format("{}", kappa),
                      "0 is soil at its peak strength, epsp_residual and more is residual strength"});
  return 0.0;
}

void refuse_outside(double q, double p, std::vector<Problem>& problems) {
  problems.push_back({"K0", "the initial stress lies outside the yield surface",
                      fmt::format("q = {:.6g}, p = {:.6g}", q, p), "bring K0 nearer to 1, or enlarge the strength"});
}

}  // namespace scarp::elastoplastic
