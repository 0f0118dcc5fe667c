#include "scarp/material/neo_hookean.hpp"

#include <fmt/format.h>
#include <cmath>
#include <optional>

namespace scarp {
namespace {

/// Eigenvalues all positive (Sylvester's criterion).
template <int N>
bool positive_definite(const Sym<double, N>& b) {
  return b[0] > 0 && b[0] * b[1] - 0.5 * b[3] * b[3] > 0 && det(b) > 0;
}

/// Inverse of b by Cayley and Hamilton: (b² − I₁ b + I₂ I) / I₃.
template <int N>
Sym<double, N> inverse(const Sym<double, N>& b) {
  const auto b2 = symmetric_product(b, b);
  const double I1 = trace(b), I2 = 0.5 * (I1 * I1 - trace(b2));
  return (1.0 / det(b)) * (b2 - I1 * b + isotropic<double, N>(I2));
}

/// b of a Cauchy stress t (tension positive). With x = ln J known, the law gives b = (1 − (λ/μ) x) I + (e^x/μ) t; x is
/// the root of ln det b − 2x, which falls with x where the state is stable. Newton from the natural state.
template <int N>
std::optional<Sym<double, N>> b_of_stress(const Sym<double, N>& t, double lambda, double mu) {
  const auto b_of = [&](double x) { return (std::exp(x) / mu) * t + isotropic<double, N>(1.0 - lambda / mu * x); };
  const auto gap = [&](double x) {
    const auto b = b_of(x);
    return positive_definite(b) ? std::log(det(b)) - 2.0 * x : -1e300;
  };
  double x = 0;
  for (int i = 0; i < 400 && gap(x) == -1e300; ++i) x -= 0.25;  // under strong compression b is positive at smaller J
  for (int i = 0; i < 100; ++i) {
    const auto b = b_of(x);
    const double g = gap(x);
    if (g == -1e300) return {};
    const double slope = dot(inverse(b), (std::exp(x) / mu) * t - isotropic<double, N>(lambda / mu)) - 2.0;
    if (!(slope < 0)) return {};
    double step = -g / slope;
    if (std::abs(step) < 1e-15 * (1.0 + std::abs(x))) return b;
    for (int k = 0; k < 60 && std::abs(gap(x + step)) > std::abs(g); ++k) step *= 0.5;
    if (std::abs(gap(x + step)) > std::abs(g)) return std::abs(g) < 1e-13 ? std::optional(b) : std::nullopt;
    x += step;
  }
  return std::abs(gap(x)) < 1e-13 ? std::optional(b_of(x)) : std::nullopt;
}

}  // namespace

ModelDescription NeoHookean::description() {
  return {"neo-hookean",
          "compressible neo-Hookean elasticity, for large strain",
          {{"E", "E", "stress", "Young's modulus of the natural state", Bound{0.0, true}, {}, {}},
           {"nu", "ν", "-", "Poisson's ratio of the natural state", Bound{0.0, false}, Bound{0.5, true}, {}}},
          {{"b", "b", "-", "left Cauchy–Green tensor F Fᵀ from the natural state", FieldKind::tensor}},
          {{"J", "J", "-", "volume over that of the natural state", FieldKind::scalar}},
          {}};
}

NeoHookean NeoHookean::from_values(const std::map<std::string, double>& values, std::vector<Problem>&,
                                   std::vector<Problem>&) {
  return NeoHookean({values.at("E"), values.at("nu")});
}

template <int N>
NeoHookean::State<double, N> NeoHookean::initial_state(const Sym<double, N>& sigma, double, const Values&,
                                                       std::vector<Problem>& problems) const {
  State<double, N> s{sigma, isotropic<double, N>(1.0)};
  if (const auto b = b_of_stress<N>(-1.0 * sigma, lambda_, mu_)) {
    s.b = *b;
    s.sigma = stress(s.b);  // to the last bit what a zero increment leaves
  } else {
    problems.push_back(
        {"stress", "the initial stress belongs to a stable state of the neo-Hookean law",
         fmt::format("mean stress {:.6g} (compression positive), E = {:.6g}", mean(sigma), parameters_.E),
         "enlarge E, or take less tension"});
  }
  return s;
}

template NeoHookean::State<double, 4> NeoHookean::initial_state<4>(const Sym<double, 4>&, double, const Values&,
                                                                   std::vector<Problem>&) const;
template NeoHookean::State<double, 6> NeoHookean::initial_state<6>(const Sym<double, 6>&, double, const Values&,
                                                                   std::vector<Problem>&) const;

}  // namespace scarp
