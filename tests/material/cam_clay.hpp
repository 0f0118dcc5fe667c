// What the tests of Modified Cam Clay share: its constants, a start, strains and a closed form.
#pragma once

#include <gtest/gtest.h>
#include <cmath>

#include "samples.hpp"
#include "scarp/material/integrate/embedded.hpp"
#include "scarp/material/modified_cam_clay.hpp"

namespace scarp::test::cam_clay {

using State = ModifiedCamClay::State<double, 6>;
constexpr double kappa = 0.02, lambda = 0.1, M = 1.2, Lambda = (lambda - kappa) / lambda, nu = 0.25;
constexpr double r = 3 * (1 - 2 * nu) / (2 * (1 + nu));  // G/K
inline const Sym<double, 6> p100 = isotropic<double, 6>(100.0);

inline ModifiedCamClay clay(const std::map<std::string, double>& changes = {}) {
  std::map<std::string, double> values{{"kappa", kappa}, {"lambda", lambda}, {"nu", nu},      {"p_e", 0},
                                       {"M", M},         {"p_atm", 101.325}, {"p_c_floor", 0}};
  for (const auto& [key, value] : changes) values[key] = value;
  return std::get<ModifiedCamClay>(made("modified-cam-clay", values));
}

inline State start(const ModifiedCamClay& model, double OCR, const Sym<double, 6>& sigma = p100) {
  std::vector<Problem> problems;
  const auto s = model.initial_state<6>(sigma, sigma[2], {{"OCR", OCR}}, problems);
  for (const auto& p : problems) ADD_FAILURE() << p.key << ": " << p.what << ' ' << p.value;
  return s;
}

template <class Pair = DormandPrince>
IntegrationReport strain(const ModifiedCamClay& model, State& s, const Sym<double, 6>& deps, double tolerance = 1e-9) {
  const auto report = integrate<Pair>(model, s, deps, {tolerance, 1e-9});
  EXPECT_EQ(report.end, IntegrationEnd::done) << "reached " << report.reached;
  return report;
}

/// Triaxial strain, compression along z.
inline Sym<double, 6> triaxial(double eps_v, double eps_q) {
  return {{eps_v / 3 - 0.5 * eps_q, eps_v / 3 - 0.5 * eps_q, eps_v / 3 + eps_q, 0, 0, 0}};
}

inline double q_over_p(const State& s) {
  return deviatoric_stress(s.sigma) / mean(s.sigma);
}

/// ε_q of undrained shear from η₀ on the yield surface to η.
inline double undrained_strain(double eta0, double eta) {
  const auto at = [](double x) {
    const double arc = std::atan(x / M);
    return kappa * Lambda / M * (std::log(std::abs((M + x) / (M - x))) - 2 * arc) +
           kappa / (3 * r) * ((1 - 2 * Lambda) * x + 2 * Lambda * M * arc);
  };
  return at(eta) - at(eta0);
}

}  // namespace scarp::test::cam_clay
