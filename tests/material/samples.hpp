// Constants and states that the models' tests start from.
#pragma once

#include <map>
#include <optional>
#include <random>
#include <stdexcept>
#include <string>

#include "scarp/material/models.hpp"
#include "unit/tensor/matrix.hpp"

namespace scarp::test {

/// A soil with every feature of the subloading model at work [kPa].
inline std::map<std::string, double> full_constants() {
  return {{"kappa", 0.015}, {"lambda", 0.1}, {"nu", 0.25},   {"p_e", 3},     {"M", 0.82},       {"M_c", 1.2},
          {"k", 5.0 / 7},   {"alpha", 0.9},  {"xi", 0.003},  {"c_R", 20},    {"c_beta", 8},     {"c_b", 8},
          {"c_a", 8},       {"R_bf", 1},     {"R_min", .01}, {"delta", .02}, {"p_atm", 101.325}};
}

/// The Modified Cam Clay limit of constitutive.md: M = 1.2, Λ = 0.8.
inline std::map<std::string, double> cam_clay_constants() {
  return {{"kappa", 0.02}, {"lambda", 0.1}, {"nu", 0.25}, {"p_e", 0},     {"M", 1.2},         {"M_c", 1.2},
          {"k", 1},        {"alpha", 1},    {"xi", 0},    {"c_R", 1000},  {"c_beta", 0},      {"c_b", 0},
          {"c_a", 0},      {"R_bf", 1},     {"delta", 0}, {"R_min", .01}, {"p_atm", 101.325}, {"p_c_floor", 0}};
}

/// The model, or an exception that says which constant it did not take.
inline AnyModel made(const std::string& name, const std::map<std::string, double>& values,
                     const Values& settings = {}) {
  auto result = make_model(name, values, settings);
  if (!result.model) throw std::invalid_argument(result.problems.at(0).key + ": " + result.problems.at(0).what);
  return *result.model;
}

inline Subloading subloading(std::map<std::string, double> values, const std::map<std::string, double>& changes = {}) {
  for (const auto& [key, value] : changes) values[key] = value;
  return std::get<Subloading>(made("subloading", values));
}

/// What the conformance suite needs of a model: valid constants, and an initial state in compression.
struct Sample {
  std::map<std::string, double> constants;
  Values initial;
  Values settings = {};
};

inline Sample sample(const std::string& model) {
  if (model == "linear-elastic") return {{{"E", 2e4}, {"nu", 0.3}}, {}};
  if (model == "subloading") return {full_constants(), {{"R_b", 2.5}, {"OCR", 1.6}, {"a", 0.4}, {"beta", "K0"}}};
  if (model == "neo-hookean") return {{{"E", 2e4}, {"nu", 0.3}}, {}};
  if (model == "modified-cam-clay") {
    return {{{"kappa", 0.015}, {"lambda", 0.1}, {"nu", 0.25}, {"p_e", 3}, {"M", 1.2}, {"p_atm", 101.325}},
            {{"OCR", 1.1}}};
  }
  // Weak enough that the suite's states yield, and soften on the way.
  const std::map<std::string, double> clay{
      {"E", 2e4}, {"nu", 0.3}, {"s_u", 22}, {"s_u_residual", 15}, {"epsp_residual", 0.02}};
  const std::map<std::string, double> sand{{"E", 2e4},
                                           {"nu", 0.3},
                                           {"c", 2},
                                           {"phi", 14},
                                           {"psi", 5},
                                           {"c_residual", 1},
                                           {"phi_residual", 11},
                                           {"epsp_residual", 0.03}};
  if (model == "von-mises" || model == "tresca") return {clay, {}};
  if (model == "mohr-coulomb" || model == "drucker-prager") return {sand, {}};
  if (model == "viscoplastic-subloading") {
    auto constants = full_constants();
    constants.insert({{"mu", 30}, {"n", 2}, {"R_m", 1.6}});
    return {constants, {{"R_b", 2.5}, {"OCR", 1.6}, {"a", 0.4}, {"beta", "K0"}}};
  }
  if (model == "umat") {  // the elastic one in C
    return {{{"wave_modulus", 0}, {"celent", 1}},
            {},
            {{"library", SCARP_UMATS "/elastic_c.so"}, {"constants", std::vector<double>{2e4, 0.3}}}};
  }
  throw std::invalid_argument("add constants and initial values of the model " + model + " to this list");
}

/// Where theory says σ : dε^p ≥ 0, the constants and initial values for that; nothing where there is no plastic strain.
///  - associated flow on a convex surface around zero stress (von Mises, Tresca); with dilation no more than friction
///    (Mohr-Coulomb, Drucker-Prager: on the cone it is (q − M_ψ p) dκ, q = M p + k)
///  - Modified Cam Clay: p p_c dΛ
///  - the subloading laws do where they reduce to that, σ = R σ_y: associated, without anisotropy, tensile strength and
///    motion of the centre. Otherwise part of the work is stored with the centre and the anisotropy.
inline std::optional<Sample> dissipative(const std::string& model) {
  if (model == "linear-elastic" || model == "neo-hookean" || model == "umat") return {};
  auto s = sample(model);
  if (model == "subloading" || model == "viscoplastic-subloading") {
    for (const auto* key : {"xi", "c_beta", "c_a"}) s.constants[key] = 0;
    s.constants["alpha"] = 1;
    s.initial = {{"R_b", 2.5}, {"OCR", 1.6}};
  }
  return s;
}

/// Of a law whose points part from the body and open, constants and initial values of soil without tensile strength.
inline Sample parting(const std::string& model) {
  auto s = sample(model);
  if (model == "subloading" || model == "viscoplastic-subloading") {
    s.initial = {{"R_b", 1.0}, {"p_c", 0.01 * s.constants.at("p_atm")}};  // on the floor
  } else {
    s.constants["c"] = s.constants["c_residual"] = 0;
  }
  return s;
}

/// A random state of the subloading model with 0 < R ≤ 1, ‖s̄‖ and the Lode angle anywhere.
template <int N>
Subloading::State<double, N> random_state(std::mt19937& generator, const Subloading& model) {
  std::uniform_real_distribution<double> uniform(0, 1);
  for (;;) {
    Subloading::State<double, N> s{};
    const double p = 20 + 300 * uniform(generator);
    s.sigma = isotropic<double, N>(p) + (0.8 * p) * deviator(random_tensor<N>(generator));
    s.beta = 0.3 * deviator(random_tensor<N>(generator));
    s.R_b = 1 + 3 * uniform(generator);
    s.p_c = (0.6 + 2.4 * uniform(generator)) * p;
    s.a = (uniform(generator) * 0.8) * s.sigma + (0.1 * p) * random_tensor<N>(generator);
    const auto h = model.homothety(s);
    if (h.exists && h.R > 0 && h.R <= 1) return s;
  }
}

}  // namespace scarp::test
