#include "scarp/material/modified_cam_clay.hpp"

#include <fmt/format.h>
#include <algorithm>

#include "scarp/material/initial_values.hpp"

namespace scarp {

ModifiedCamClay::ModifiedCamClay(const Parameters& p)
    : c_(p), n_s_(3.0 / (p.M * p.M)), g2_(3.0 * (1.0 - 2.0 * p.nu) / (1.0 + p.nu)), floor_(p.p_c_floor * p.p_atm) {}

ModelDescription ModifiedCamClay::description() {
  const Bound zero{0.0, true}, from_zero{0.0, false}, below_one{1.0, true};
  return {
      "modified-cam-clay",
      "Modified Cam Clay: elastic inside an elliptic yield surface, associated flow",
      {
          {"kappa", "κ̄", "-", "slope of the elastic isotropic compression line in (ln p, ln v)", zero, {}, {}},
          {"lambda", "λ̄", "-", "slope of the normal compression line in (ln p, ln v)", zero, {}, {}},
          {"nu", "ν", "-", "Poisson's ratio", from_zero, Bound{0.5, true}, {}},
          {"p_e", "p_e", "stress", "specific volume becomes infinite at p = −p_e", from_zero, {}, {}},
          {"M", "M", "-", "critical state stress ratio q/p, in compression as in extension", zero, {}, {}},
          {"p_atm", "p_atm", "stress", "atmospheric pressure, the unit of the floor of p_c", zero, {}, {}},
          {"p_c_floor", "p_c,min/p_atm", "-", "numerical: dilation shrinks p_c no further than to this share of p_atm",
           from_zero, below_one, 0.01},
      },
      {
          {"epsp", "ε^p", "-", "plastic strain", FieldKind::tensor},
          {"p_c", "p_c", "stress", "size of the yield surface", FieldKind::scalar},
      },
      {
          {"R", "R", "-", "size of the yield surface through the stress over p_c", FieldKind::scalar},
          {"epsp_v", "ε_v^p", "-", "plastic volumetric strain, compression positive", FieldKind::scalar},
          {"epsp_q", "ε_q^p", "-", "plastic deviatoric strain, √(2/3) ‖dev ε^p‖", FieldKind::scalar},
      },
      {
          {"OCR", "number ≥ 1", "p_c is this many times that of the yield surface through the initial stress"},
          {"POP", "number ≥ 0 [stress]",
           "p_c is that of the yield surface through the stress, scaled up to a vertical "
           "stress larger by POP"},
          {"p_c", "number > 0 [stress]", "p_c itself; of OCR, POP and p_c given together the largest result is taken"},
      }};
}

ModifiedCamClay ModifiedCamClay::from_values(const std::map<std::string, double>& v, std::vector<Problem>& problems,
                                             std::vector<Problem>&) {
  const Parameters p{v.at("kappa"), v.at("lambda"), v.at("nu"),       v.at("p_e"),
                     v.at("M"),     v.at("p_atm"),  v.at("p_c_floor")};
  if (p.kappa >= p.lambda) {
    problems.push_back({"kappa", "kappa is less than lambda", fmt::format("kappa = {}, lambda = {}", p.kappa, p.lambda),
                        "an elastic slope is smaller than that of the normal compression line"});
  }
  return ModifiedCamClay(p);
}

template <int N>
ModifiedCamClay::State<double, N> ModifiedCamClay::initial_state(const Sym<double, N>& sigma, double vertical,
                                                                 const Values& keys,
                                                                 std::vector<Problem>& problems) const {
  State<double, N> s{sigma, Sym<double, N>::zero(), 0.0};
  auto demand = [&](bool holds, const char* key, const char* what, double value, const char* remedy) {
    if (!holds) problems.push_back({key, what, fmt::format("{:.6g}", value), remedy});
  };
  const double p = mean(sigma), through = p > 0 ? p_c_through(sigma) : 0.0;
  const auto ocr = initial::number(keys, "OCR", problems), pop = initial::number(keys, "POP", problems),
             pc = initial::number(keys, "p_c", problems);
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
  if (!(ocr || pop || pc))
    problems.push_back({"OCR", "the initial size of the yield surface is missing", "", "give OCR, POP or p_c"});
  if (!problems.empty()) return s;

  s.p_c = std::max(s.p_c, floor_);
  demand(s.p_c > 0, "p_c", "the initial p_c is positive", s.p_c, "give p_c, or a floor p_c_floor");
  demand(p + c_.p_e > 0, "p_e", "the initial stiffness is positive: p + p_e > 0", p + c_.p_e,
         "enlarge p_e or the initial stress");
  const double f = yield(sigma, s.p_c);
  demand(f <= 1e-9 * s.p_c * s.p_c, "p_c", "the initial stress lies inside or on the yield surface: f <= 0", f,
         "enlarge p_c or OCR; the surface reaches from p = 0 to p_c");
  return s;
}

template ModifiedCamClay::State<double, 4> ModifiedCamClay::initial_state<4>(const Sym<double, 4>&, double,
                                                                             const Values&,
                                                                             std::vector<Problem>&) const;
template ModifiedCamClay::State<double, 6> ModifiedCamClay::initial_state<6>(const Sym<double, 6>&, double,
                                                                             const Values&,
                                                                             std::vector<Problem>&) const;

}  // namespace scarp
