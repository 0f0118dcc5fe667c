#include "scarp/material/subloading.hpp"

#include <fmt/format.h>
#include <cmath>

#include "scarp/material/initial_values.hpp"

namespace scarp {

Subloading::Subloading(const Parameters& p)
    : c_(p),
      g2_(3.0 * (1.0 - 2.0 * p.nu) / (1.0 + p.nu)),
      per_kappa_(1.0 / p.kappa),
      n_s_(3.0 / (p.M * p.M)),
      g_s_(n_s_ / (p.alpha * p.alpha)),
      per_R_span_(1.0 / (1.0 - p.R_min)),
      pace_beta_(p.c_beta / p.p_atm),
      per_plastic_(1.0 / (p.lambda - p.kappa)),
      p_bond_(p.p_e / (1.0 - p.xi)),
      i2_(1.0 / (p.alpha * p.alpha)),
      per_e_(1.0 / (2.0 * i2_ - 1.0)),
      floor_(p.p_c_floor * p.p_atm) {}

ModelDescription Subloading::description() {
  const Bound zero{0.0, true}, from_zero{0.0, false}, one{1.0, false}, below_one{1.0, true};
  return {
      "subloading",
      "subloading Modified Cam Clay with anisotropy, structure, a moving centre of homothety and non-associated flow",
      {
          {"kappa", "κ̄", "-", "slope of the elastic isotropic compression line in (ln p, ln v)", zero, {}, {}},
          {"lambda", "λ̄", "-", "slope of the normal compression line in (ln p, ln v)", zero, {}, {}},
          {"nu", "ν", "-", "Poisson's ratio", from_zero, Bound{0.5, true}, {}},
          {"p_e", "p_e", "stress", "specific volume becomes infinite at p = −p_e", from_zero, {}, {}},
          {"M", "M", "-", "eccentricity of the yield surface (q/p of its crest)", zero, {}, {}},
          {"M_c", "M_c", "-", "critical state stress ratio q/p in triaxial compression", zero, {}, {}},
          {"k",
           "k",
           "-",
           "critical state stress ratio in extension over that in compression",
           Bound{0.5, true},
           one,
           {}},
          {"alpha", "α", "-", "non-associativity of the plastic potential (1: associated)", zero, {}, {}},
          {"xi", "ξ", "-", "isotropic tensile strength over p_c", from_zero, Bound{0.5, true}, {}},
          {"c_R", "c_R", "-", "rate at which R tends to 1 with plastic strain", zero, {}, {}},
          {"c_beta", "c_β", "-", "rate of anisotropy", from_zero, {}, {}},
          {"c_b", "c_b", "-", "rate of debonding", from_zero, {}, {}},
          {"R_bf", "R_bf", "-", "bonding factor left at large strain (1: none)", one, {}, {}},
          {"c_a", "c_a", "-", "rate at which the centre of homothety follows the stress", from_zero, {}, {}},
          {"R_min", "R_min", "-", "numerical: straining is elastic below this R", zero, below_one, 0.01},
          {"delta", "δ", "-", "numerical: the centre stays inside the yield surface by this share", from_zero,
           below_one, 0.05},
          {"p_atm",
           "p_atm",
           "stress",
           "atmospheric pressure, the unit of p in the anisotropic hardening law",
           zero,
           {},
           {}},
          {"p_c_floor", "p_c,min/p_atm", "-", "numerical: dilation shrinks p_c no further than to this share of p_atm",
           from_zero, below_one, 0.01},
      },
      {
          {"beta", "β", "-", "anisotropy tensor", FieldKind::tensor},
          {"a", "a", "stress", "centre of homothety", FieldKind::tensor},
          {"epsp", "ε^p", "-", "plastic strain", FieldKind::tensor},
          {"p_c", "p_c", "stress", "size of the structured yield surface", FieldKind::scalar},
          {"R_b", "R_b", "-", "bonding factor", FieldKind::scalar},
          gap_field(),
      },
      {
          {"R", "R", "-", "homothety ratio of the subloading to the yield surface", FieldKind::scalar},
          {"epsp_v", "ε_v^p", "-", "plastic volumetric strain, compression positive", FieldKind::scalar},
          {"epsp_q", "ε_q^p", "-", "plastic deviatoric strain, √(2/3) ‖dev ε^p‖", FieldKind::scalar},
      },
      {
          {"R_b", "number ≥ 1", "bonding factor; required"},
          {"OCR", "number ≥ 1", "p_c is this many times that of the yield surface through the initial stress"},
          {"POP", "number ≥ 0 [stress]",
           "p_c is that of the yield surface through the stress, scaled up to a vertical "
           "stress larger by POP"},
          {"p_c", "number > 0 [stress]", "p_c itself; of OCR, POP and p_c given together the largest result is taken"},
          {"R", "number, 0 < R ≤ 1", "p_c is such that the state has this R; instead of OCR, POP and p_c"},
          {"beta", "\"isotropic\", \"K0\" or 6 numbers",
           "anisotropy: none, what eq. 32 tends to along the initial stress ratio, or given; standard \"isotropic\""},
          {"a", "number, 0 ≤ a < 1, or 6 numbers",
           "centre of homothety: this share of the initial stress, or given (compression positive); standard 0"},
      }};
}

Subloading Subloading::from_values(const std::map<std::string, double>& v, std::vector<Problem>& problems,
                                   std::vector<Problem>& warnings) {
  const Parameters p{v.at("kappa"), v.at("lambda"), v.at("nu"),    v.at("p_e"),   v.at("M"),      v.at("M_c"),
                     v.at("k"),     v.at("alpha"),  v.at("xi"),    v.at("c_R"),   v.at("c_beta"), v.at("c_b"),
                     v.at("c_a"),   v.at("R_bf"),   v.at("R_min"), v.at("delta"), v.at("p_atm"),  v.at("p_c_floor")};
  if (p.kappa >= p.lambda) {
    problems.push_back({"kappa", "kappa is less than lambda", fmt::format("kappa = {}, lambda = {}", p.kappa, p.lambda),
                        "an elastic slope is smaller than that of the normal compression line"});
  }
  if (p.M > p.k * p.M_c) {
    warnings.push_back(
        {"M", "M is larger than k M_c, so that the anisotropic limit eta_beta_cs is taken as 0 near triaxial extension",
         fmt::format("M = {}, k M_c = {}", p.M, p.k * p.M_c), "choose M <= k M_c, or accept the clamped limit"});
  }
  return Subloading(p);
}

template <int N>
double Subloading::p_c_through(const Sym<double, N>& sigma, const Sym<double, N>& beta) const {
  const double p = mean(sigma);
  const Sym<double, N> s_bar = deviator(sigma) - p * beta;
  // ξ(1−ξ) p_c² + (1−2ξ) p p_c − (q̄²/M² + p²) = 0, from eqs 21, 22.
  const double rest = 1.5 / (c_.M * c_.M) * dot(s_bar, s_bar) + p * p;
  const double half = (1.0 - 2.0 * c_.xi) * p;
  const double denominator = half + std::sqrt(half * half + 4.0 * c_.xi * (1.0 - c_.xi) * rest);
  return denominator > 0 ? 2.0 * rest / denominator : 0.0;
}

template <int N>
Subloading::State<double, N> Subloading::initial_state(const Sym<double, N>& sigma, double vertical, const Values& keys,
                                                       std::vector<Problem>& problems) const {
  State<double, N> s{sigma, Sym<double, N>::zero(), Sym<double, N>::zero(), Sym<double, N>::zero(), 0.0, 1.0};
  const double p = mean(sigma);
  // No text is made where all is well: this runs for every point.
  auto demand = [&](bool holds, const char* key, const char* what, double value, const char* remedy) {
    if (!holds) problems.push_back({key, what, fmt::format("{:.6g}", value), remedy});
  };

  const auto R_b = initial::number(keys, "R_b", problems);
  if (R_b) s.R_b = *R_b;
  if (!keys.contains("R_b"))
    problems.push_back(
        {"R_b", "the initial bonding factor R_b is missing", "", "give R_b, 1 for soil without structure"});
  demand(s.R_b >= 1.0, "R_b", "the initial bonding factor satisfies R_b >= 1", s.R_b,
         "give R_b, 1 for soil without structure");

  if (const auto found = keys.find("beta"); found != keys.end()) {
    const auto* word = std::get_if<std::string>(&found->second);
    if (const auto* list = std::get_if<std::vector<double>>(&found->second)) {
      if (const auto t = initial::tensor<N>("beta", *list, problems)) s.beta = *t;
      demand(std::abs(trace(s.beta)) <= 1e-9 * (1.0 + norm(s.beta)), "beta", "beta is deviatoric: xx + yy + zz = 0",
             trace(s.beta), "subtract the mean");
      s.beta = deviator(s.beta);  // to the last digit, as the law takes it
    } else if (word && *word == "K0") {
      const Sym<double, N> dev = deviator(sigma);
      const double size = norm(dev);
      const double limit = std::sqrt(2.0 / 3.0) * eta_beta_cs(c_.M_c * willam_warnke(cos_3_lode(dev), c_.k));
      // No further than the stress ratio itself: beta lags behind s on its way.
      if (size > 0 && p > 0) s.beta = (std::min(limit, size / p) / size) * dev;
    } else if (!word || *word != "isotropic") {
      problems.push_back({"beta", "beta is \"isotropic\", \"K0\" or 6 numbers", word ? '"' + *word + '"' : "a number",
                          "choose one of these"});
    }
  }
  if (const auto found = keys.find("a"); found != keys.end()) {
    if (const auto* share = std::get_if<double>(&found->second)) {
      demand(*share >= 0 && *share < 1, "a", "the centre's share of the initial stress satisfies 0 <= a < 1", *share,
             "a typical value is 0.5");
      s.a = *share * sigma;
    } else if (const auto* list = std::get_if<std::vector<double>>(&found->second)) {
      if (const auto t = initial::tensor<N>("a", *list, problems)) s.a = *t;
    } else {
      problems.push_back(
          {"a", "a is a share of the initial stress or 6 numbers", "a word", "write a = 0.5, for instance"});
    }
  }

  const auto ocr = initial::number(keys, "OCR", problems), pop = initial::number(keys, "POP", problems),
             pc = initial::number(keys, "p_c", problems), R = initial::number(keys, "R", problems);
  const double through = p_c_through(sigma, s.beta);
  if (ocr) {
    demand(*ocr >= 1, "OCR", "OCR >= 1", *ocr, "1 is normally consolidated");
    s.p_c = std::max(s.p_c, *ocr * through);
  }
  if (pop) {
    demand(*pop >= 0, "POP", "POP >= 0", *pop, "0 is normally consolidated");
    if (vertical > 0) s.p_c = std::max(s.p_c, (1.0 + *pop / vertical) * through);
  }
  if (pc) {
    demand(*pc > 0, "p_c", "p_c > 0", *pc, "p_c is the size of the yield surface along the hydrostatic axis");
    s.p_c = std::max(s.p_c, *pc);
  }
  if (R) {
    demand(*R > 0 && *R <= 1, "R", "the initial R satisfies 0 < R <= 1", *R, "1 is normally consolidated");
    if (ocr || pop || pc)
      problems.push_back({"R", "R stands instead of OCR, POP and p_c", "both", "remove one of them"});
    // The homothetic image of sigma lies on the yield surface.
    if (*R > 0) s.p_c = p_c_through(s.a + (1.0 / *R) * (sigma - s.a), s.beta);
  }
  if (!(ocr || pop || pc || R))
    problems.push_back({"OCR", "the initial size of the yield surface is missing", "", "give OCR, POP, p_c or R"});
  if (!problems.empty()) return s;

  s.p_c = std::max(s.p_c, floor_);
  demand(s.p_c > 0, "p_c", "the initial p_c is positive", s.p_c, "give p_c, or a floor p_c_floor");
  const auto h = homothety(s);
  demand(h.exists && (s.p_c > 0), "a",
         "the centre of homothety lies inside the yield surface (f(a) <= 0) and sigma has a homothety ratio", h.R,
         "move a towards the centre, or enlarge p_c");
  demand(!h.exists || h.R <= 1.0 + 1e-9, "p_c", "the initial stress lies inside or on the yield surface: R <= 1", h.R,
         "enlarge p_c or OCR");
  demand(p + c_.p_e > 0, "p_e", "the initial stiffness is positive: p + p_e > 0", p + c_.p_e,
         "enlarge p_e or the initial stress");
  return s;
}

template double Subloading::p_c_through<4>(const Sym<double, 4>&, const Sym<double, 4>&) const;
template double Subloading::p_c_through<6>(const Sym<double, 6>&, const Sym<double, 6>&) const;
template Subloading::State<double, 4> Subloading::initial_state<4>(const Sym<double, 4>&, double, const Values&,
                                                                   std::vector<Problem>&) const;
template Subloading::State<double, 6> Subloading::initial_state<6>(const Sym<double, 6>&, double, const Values&,
                                                                   std::vector<Problem>&) const;

}  // namespace scarp
