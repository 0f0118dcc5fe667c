// The subloading model of the report, section 3: Modified Cam Clay yield surface, plastic strain inside it, rotating
// (anisotropy beta), bonded (structure R_b), with a moving centre of homothety a and non-associated flow. Equation
// numbers are the report's; docs/models/subloading.md says what it leaves open and how that is settled.
// Compression positive.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "scarp/material/description.hpp"
#include "scarp/material/gap.hpp"
#include "scarp/material/integrate/after_closing.hpp"
#include "scarp/material/state.hpp"
#include "scarp/material/willam_warnke.hpp"

namespace scarp {

class Subloading {
 public:
  struct Parameters {
    double kappa, lambda;          ///< slopes κ̄, λ̄ in (ln p, ln v)
    double nu;                     ///< Poisson's ratio
    double p_e;                    ///< p at which v → ∞ is −p_e [stress]
    double M;                      ///< eccentricity of the yield surface
    double M_c, k;                 ///< critical state stress ratio in triaxial compression; extension over compression
    double alpha;                  ///< non-associativity (1: associated)
    double xi;                     ///< isotropic tensile strength over p_c
    double c_R, c_beta, c_b, c_a;  ///< rates: subloading, anisotropy, debonding, centre of homothety
    double R_bf;                   ///< bonding factor at large strain
    double R_min, delta;           ///< numerical: R below which straining is elastic; eq. 38's note
    double p_atm;                  ///< atmospheric pressure [stress]
    double p_c_floor;              ///< least p_c over p_atm (0: none)
  };

  template <class T, int N>
  struct State {
    Sym<T, N> sigma;  ///< effective stress
    Sym<T, N> beta;   ///< anisotropy, deviatoric
    Sym<T, N> a;      ///< centre of homothety
    Sym<T, N> epsp;   ///< plastic strain
    T p_c;            ///< size of the structured yield surface along the hydrostatic axis
    T R_b;            ///< bonding factor
    T gap = T(0.0);   ///< of a separated point, see gap.hpp

    template <class F, class... States>
    static void each(F&& f, States&... s) {
      f(s.sigma...);
      f(s.beta...);
      f(s.a...);
      f(s.epsp...);
      f(s.p_c...);
      f(s.R_b...);
      f(s.gap...);
    }
  };

  explicit Subloading(const Parameters& p);

  static ModelDescription description();
  /// Constants from the keys of description(), all present and within their bounds; what only shows between constants
  /// is checked here.
  static Subloading from_values(const std::map<std::string, double>& values, std::vector<Problem>& problems,
                                std::vector<Problem>& warnings);

  const Parameters& parameters() const { return c_; }

  /// The homothety that the state stands in: the surface through sigma is R times the yield surface, seen from a.
  template <class T, int N>
  struct Homothety {
    T R;
    Mask<T> exists;    ///< R is finite and not negative, a inside the yield surface
    Sym<T, N> S0, S1;  ///< s̄ at σ_y = a + u (σ − a) is S0 + u S1
    T p_a, p_d;        ///< p at σ_y is p_a + u p_d
  };
  template <class T, int N>
  Homothety<T, N> homothety(const State<T, N>& s) const;

  /// The image σ_y of the stress on the yield surface, and the directions N = ∂f/∂σ and G = ∂g/∂σ there: deviator
  /// n_s s̄ and trace f_p, deviator g_s s̄ and trace g_p. Below R_min nothing of it is used: R stays finite in 1/R.
  template <class T, int N>
  struct Image {
    Homothety<T, N> h;
    T p, K, G2;            ///< of the stress itself: mean, bulk modulus, 2G
    T R;                   ///< no less than R_min
    Sym<T, N> from_a;      ///< σ_y − a
    Sym<T, N> s_bar;       ///< s̄ at σ_y
    T ss;                  ///< s̄ : s̄
    T f_p, g_p;            ///< tr N, tr G
    T norm_g_dev, norm_g;  ///< ‖dev G‖, ‖G‖
  };
  template <class T, int N>
  Image<T, N> image(const State<T, N>& s) const;

  /// Rates of the internal variables per unit plastic multiplier dΛ, dε^p = dΛ G (eqs 32, 36–38).
  template <class T, int N>
  struct Hardening {
    Sym<T, N> beta, a;
    T p_c, R_b;
    T p_c_relative;  ///< p_c'/p_c
    Sym<T, N> pull;  ///< c_a ‖G‖ (σ̄_y − a)
  };
  template <class T, int N>
  Hardening<T, N> hardening(const State<T, N>& s, const Image<T, N>& y) const;

  /// Eq. 31: the growth of R per ‖dε^p‖.
  template <class T>
  T R_per_strain(const T& R) const {
    return T(-c_.c_R) * log(max(T(1e-300), (R - T(c_.R_min)) * T(per_R_span_)));  // eq. 31
  }

  /// N : x
  template <class T, int N>
  T normal_part(const Image<T, N>& y, const Sym<T, N>& x) const {
    return T(n_s_) * dot(y.s_bar, x) + y.f_p * mean(x);  // s̄ is deviatoric
  }
  /// N : D : dε
  template <class T, int N>
  T elastic_normal_part(const Image<T, N>& y, const Sym<T, N>& deps) const {
    return T(n_s_) * y.G2 * dot(y.s_bar, deps) + y.K * y.f_p * trace(deps);
  }
  /// N : D : G + H, where R changes by R_rate per unit multiplier
  template <class T, int N>
  T stiffness(const State<T, N>& s, const Image<T, N>& y, const Hardening<T, N>& r, const T& R_rate) const;

  /// The change `d` of the state for a strain of which dΛ G is plastic.
  template <class T, int N>
  void change(const Image<T, N>& y, const Hardening<T, N>& r, const Sym<T, N>& deps, const T& dLambda,
              State<T, N>& d) const;

  template <class T, int N>
  Rate<State<T, N>, T> rate(const State<T, N>& s, const Sym<T, N>& deps) const;

  /// An open point has no other change than that of its gap.
  template <class S, class T, int N>
  void open_where_parted(const S& s, const Sym<T, N>& deps, Rate<S, T>& rate) const;

  /// The pair's step, after the part of the increment that closes what is open.
  template <class Pair, class T, int N>
  Trial<State<T, N>, T> update(const State<T, N>& s, const Increment<T, N>& step, double tolerance) const {
    return after_closing<Pair>(*this, s, step, tolerance);
  }

  template <class T, int N>
  Mask<T> admissible(const State<T, N>& s) const {
    return homothety(s).exists && (s.p_c > T(0.0)) && (mean(s.sigma) + T(c_.p_e) > T(0.0));
  }

  /// √(sum of squares) of the relative errors of sigma, a, p_c, R_b and the absolute ones of beta and epsp; the gap's
  /// is sigma's. Stresses
  /// are taken relative to ‖σ‖ + p_c/10, so that a point at nearly no stress is not followed to digits that nobody
  /// sees.
  template <class T, int N>
  T error_norm(const State<T, N>& s, const State<T, N>& e) const {
    const T scale = T(1.0) / (norm(s.sigma) + T(0.1) * s.p_c), inverse = T(1.0) / (s.p_c * s.R_b);
    const T pc = e.p_c * s.R_b * inverse, rb = e.R_b * s.p_c * inverse;
    return sqrt(scale * scale * (dot(e.sigma, e.sigma) + dot(e.a, e.a)) + dot(e.beta, e.beta) + dot(e.epsp, e.epsp) +
                pc * pc + rb * rb);
  }

  template <class T, int N>
  UpdateFlags<T> accept(State<T, N>& s, double tolerance) const;

  /// Dilation drives p_c to zero in soil that shears at a free surface; below the floor `a` would lose its yield
  /// surface.
  template <class T, int N>
  UpdateFlags<T> hold_at_floor(State<T, N>& s) const;

  /// At the floor the bonds are gone and so is the tensile strength: the point parts from the body, until it is
  /// compressed as far as it has opened. `exists`: the stress has a homothety.
  template <class T, int N>
  void part_where_torn(State<T, N>& s, const Mask<T>& exists, UpdateFlags<T>& flags) const;

  /// K + 4G/3
  template <class T, int N>
  T p_wave_modulus(const State<T, N>& s) const {
    return (mean(s.sigma) + T(c_.p_e)) * T((1.0 + 2.0 / 3.0 * g2_) / c_.kappa);
  }

  /// p_c of the yield surface through sigma: f(sigma) = 0 solved for p_c.
  template <int N>
  double p_c_through(const Sym<double, N>& sigma, const Sym<double, N>& beta) const;

  /// The state at `sigma` from a region's keys (description().initial). `vertical` is the component of sigma that POP
  /// adds to [stress].
  template <int N>
  State<double, N> initial_state(const Sym<double, N>& sigma, double vertical, const Values& keys,
                                 std::vector<Problem>& problems) const;

  /// The keys of soil on its normal compression line, without structure: where a one-dimensional history starts.
  Values normally_consolidated() const { return {{"R_b", c_.R_bf}, {"OCR", 1.0}}; }

  template <int N>
  std::vector<double> derived(const State<double, N>& s) const {
    return {homothety(s).R, trace(s.epsp), sqrt_2_3 * norm(deviator(s.epsp))};
  }

  /// η_β,cs: the stress ratio that beta tends to (this project's closure), from the critical state ratio M_cs(θ).
  template <class T>
  T eta_beta_cs(const T& M_cs) const;

 private:
  Parameters c_;
  // Formed once, for a division costs as much as ten products:
  double g2_;           ///< 2G/K, eq. 27
  double per_kappa_;    ///< 1/κ̄
  double n_s_, g_s_;    ///< 3/M² and 3/(αM)²
  double per_R_span_;   ///< 1/(1 − R_min)
  double pace_beta_;    ///< c_β/p_atm
  double per_plastic_;  ///< 1/(λ̄ − κ̄)
  double p_bond_;       ///< p_e/(1 − ξ)
  double i2_, per_e_;   ///< 1/α² and 1/(2/α² − 1), of η_β,cs
  double floor_;        ///< of p_c [stress]
};

template <class T, int N>
Subloading::Homothety<T, N> Subloading::homothety(const State<T, N>& s) const {
  Homothety<T, N> h;
  const double m = 0.5 * n_s_;
  const Sym<T, N> d = s.sigma - s.a;
  h.p_a = mean(s.a);
  h.p_d = mean(d);
  h.S0 = deviator(s.a) - h.p_a * s.beta;
  h.S1 = deviator(d) - h.p_d * s.beta;
  const T pa_bar = h.p_a + T(c_.xi) * s.p_c;
  // Eq. 20 on eq. 21 is A u² + 2 B u + C = 0 for u = 1/R.
  const T A = T(m) * dot(h.S1, h.S1) + h.p_d * h.p_d;  // eq. 20, of eq. 21
  const T B = T(m) * dot(h.S0, h.S1) + h.p_d * (pa_bar - T(0.5) * s.p_c);
  const T C_raw = T(m) * dot(h.S0, h.S0) + pa_bar * (pa_bar - s.p_c);
  const T C = min(C_raw, T(0.0));
  const T root = sqrt(B * B - A * C);
  const Mask<T> low = B <= T(0.0);
  // The form without cancellation on each side; 1e-300 turns the 0/0 of σ = a = 0 into R = 0.
  h.R = select(low, A, B + root) / select(low, root - B + T(1e-300), -C);
  h.exists = (h.R >= T(0.0)) && (h.R < T(1e6)) && (C_raw <= T(1e-9) * s.p_c * s.p_c);
  return h;
}

template <class T>
T Subloading::eta_beta_cs(const T& M_cs) const {
  const T b = T(i2_ - 1.0) * M_cs;
  const T gap = M_cs * M_cs - T(c_.M * c_.M);
  const T root = sqrt(max(T(0.0), b * b + T(2.0 * i2_ - 1.0) * gap));
  // Two forms of the same root; the second stays finite at α² = 2.
  const T eta = c_.alpha <= 1.0 ? (b + root) * T(per_e_) : gap / (root - b);
  return max(T(0.0), eta);
}

template <class T, int N>
Subloading::Image<T, N> Subloading::image(const State<T, N>& s) const {
  Image<T, N> y;
  y.p = mean(s.sigma);
  y.K = (y.p + T(c_.p_e)) * T(per_kappa_);  // eq. 26
  y.G2 = T(g2_) * y.K;                      // 2G, eq. 27
  y.h = homothety(s);
  y.R = max(y.h.R, T(c_.R_min));
  const T u = T(1.0) / y.R;
  y.from_a = u * (s.sigma - s.a);
  y.s_bar = y.h.S0 + u * y.h.S1;                             // eq. 24
  const T p_bar = y.h.p_a + u * y.h.p_d + T(c_.xi) * s.p_c;  // eq. 22

  const T along = dot(y.s_bar, s.beta);
  const T cap = T(2.0) * p_bar - s.p_c;
  y.f_p = cap - T(n_s_) * along;  // of eq. 21
  y.g_p = cap - T(g_s_) * along;  // of eq. 29, on eq. 30
  y.ss = dot(y.s_bar, y.s_bar);   // q̄² of eq. 23, but for 3/2
  y.norm_g_dev = T(g_s_) * sqrt(y.ss);
  y.norm_g = sqrt(y.norm_g_dev * y.norm_g_dev + y.g_p * y.g_p * T(1.0 / 3.0));
  return y;
}

template <class T, int N>
Subloading::Hardening<T, N> Subloading::hardening(const State<T, N>& s, const Image<T, N>& y) const {
  Hardening<T, N> r;
  const Sym<T, N> s_bar = y.h.S0 + y.h.S1;  // at the current stress
  const T size = norm(s_bar);
  // Deviatoric to rounding of its own: that of s̄ is of p, which may be far larger, and would add up in beta.
  const Sym<T, N> direction = deviator(select(size > T(1e-13) * s.p_c, T(1.0) / size, T(0.0)) * s_bar);
  const T eta = eta_beta_cs(T(c_.M_c) * willam_warnke(cos_3_lode_of_unit(direction), c_.k));
  r.beta = (T(pace_beta_) * y.norm_g_dev * y.p) * (T(sqrt_2_3) * eta * direction - s.beta);  // eq. 32
  r.R_b = T(c_.c_b) * (T(c_.R_bf) - s.R_b) * y.norm_g;                                       // eq. 36
  // Over p_c, with one division for R_b/p_c and 1/R_b.
  const T inverse = T(1.0) / (s.p_c * s.R_b);
  const T growth = T(per_plastic_) * (T(1.0) + s.R_b * s.R_b * inverse * T(p_bond_)) * y.g_p +  // eq. 35 of eq. 33
                   s.p_c * inverse * r.R_b;                                                     // eq. 34, eq. 37
  r.p_c_relative = select(s.p_c <= T(floor_), max(T(0.0), growth), growth);
  r.p_c = r.p_c_relative * s.p_c;
  // Eq. 38: σ̄_y − a with c the centre of the yield surface, σ̄_y = σ_y − δ (σ_y − c).
  const T p_centre = T(0.5 - c_.xi) * s.p_c;
  const Sym<T, N> centre = p_centre * s.beta + isotropic<T, N>(p_centre);
  r.pull = (T(c_.c_a) * y.norm_g) * (y.from_a - T(c_.delta) * (s.a + y.from_a - centre));
  r.a = r.pull + r.p_c_relative * s.a + y.h.p_a * r.beta;  // eq. 38
  return r;
}

template <class T, int N>
T Subloading::stiffness(const State<T, N>& s, const Image<T, N>& y, const Hardening<T, N>& r, const T& R_rate) const {
  const T NDG = T(n_s_ * g_s_) * y.G2 * y.ss + y.K * y.f_p * y.g_p;
  // Consistency of f(σ_y) = 0 (f is homogeneous of degree two in σ and p_c):
  // H = N : [ (p_c'/p_c) σ + p β' + (1 − R) c_a ‖G‖ (σ̄_y − a) + R' (σ_y − a) ]
  const Sym<T, N> inner = r.p_c_relative * s.sigma + y.p * r.beta + (T(1.0) - y.R) * r.pull + R_rate * y.from_a;
  return NDG + normal_part(y, inner);
}

template <class T, int N>
void Subloading::change(const Image<T, N>& y, const Hardening<T, N>& r, const Sym<T, N>& deps, const T& dLambda,
                        State<T, N>& d) const {
  const T shear = dLambda * T(g_s_);
  d.epsp = shear * y.s_bar + isotropic<T, N>(dLambda * y.g_p * T(1.0 / 3.0));
  d.sigma =
      y.G2 * (deviator(deps) - shear * y.s_bar) + isotropic<T, N>(y.K * (trace(deps) - dLambda * y.g_p));  // eq. 25
  d.beta = dLambda * r.beta;
  d.a = dLambda * r.a;
  d.p_c = dLambda * r.p_c;
  d.R_b = dLambda * r.R_b;
  d.gap = T(0.0);
}

template <class T, int N>
Rate<Subloading::State<T, N>, T> Subloading::rate(const State<T, N>& s, const Sym<T, N>& deps) const {
  const auto y = image(s);
  const auto r = hardening(s, y);
  const T R_rate = R_per_strain(y.h.R) * y.norm_g;
  const T loading = elastic_normal_part(y, deps), resistance = stiffness(s, y, r, R_rate);
  const Mask<T> plastic = (y.h.R > T(c_.R_min)) && (loading > T(0.0));  // eq. 28
  const T dLambda = select(plastic, loading / resistance, T(0.0));

  Rate<State<T, N>, T> result;
  change(y, r, deps, dLambda, result.change);
  result.sound = y.h.exists && (s.p_c > T(0.0)) && (y.K > T(0.0)) && ((resistance > T(0.0)) || !plastic);
  open_where_parted(s, deps, result);
  return result;
}

template <class S, class T, int N>
void Subloading::open_where_parted(const S& s, const Sym<T, N>& deps, Rate<S, T>& rate) const {
  const Mask<T> open = s.gap > T(0.0);
  if (!any(open)) return;
  for_each_component([&](T& x) { x = select(open, T(0.0), x); }, rate.change);
  rate.change.gap = select(open, -trace(deps), T(0.0));
  rate.sound = rate.sound || open;
}

template <class T, int N>
UpdateFlags<T> Subloading::hold_at_floor(State<T, N>& s) const {
  UpdateFlags<T> flags;
  flags.on_floor = s.p_c <= T(floor_ * (1.0 + 1e-9));
  flags.sound = s.p_c > T(0.0);
  if (!any(flags.on_floor)) return flags;  // as nearly all
  const T scale = select(flags.on_floor, T(floor_) / s.p_c, T(1.0));
  s.p_c = select(flags.on_floor, T(floor_), s.p_c);
  s.a = scale * s.a;
  return flags;
}

template <class T, int N>
void Subloading::part_where_torn(State<T, N>& s, const Mask<T>& exists, UpdateFlags<T>& flags) const {
  const T p = mean(s.sigma);
  flags.separated = (p <= T(0.0)) && (flags.on_floor || (p + T(c_.p_e) <= T(0.01 * c_.p_e)));
  flags.sound = flags.sound && (flags.separated || (exists && (p + T(c_.p_e) > T(0.0))));
  if (!any(flags.separated || (abs(s.gap) > T(0.0)))) return;
  // The elastic strain of the tension that goes, eq. 26: dp = (p + p_e) dε_v/κ̄.
  const T left = max(p + T(c_.p_e), T(1e-6 * c_.p_e)) * T(c_.p_e > 0.0 ? 1.0 / c_.p_e : 0.0);
  const Mask<T> torn = flags.separated && (p < T(0.0)) && (left > T(0.0));
  s.gap = select(torn, s.gap - T(c_.kappa) * log(select(torn, left, T(1.0))), s.gap);
  for (int i = 0; i < N; ++i) {
    s.sigma[i] = select(flags.separated, T(0.0), s.sigma[i]);
    s.a[i] = select(flags.separated, T(0.0), s.a[i]);
  }
  // A rate that closed the gap and went on: the rest compresses the point.
  const Mask<T> beyond = s.gap < T(0.0);
  const T pressure = T(c_.p_e) * (exp(-s.gap * T(per_kappa_)) - T(1.0));
  for (int i = 0; i < 3; ++i) s.sigma[i] = select(beyond, pressure, s.sigma[i]);
  flags.separated = (flags.separated && !beyond) || (s.gap > T(0.0));
  s.gap = max(s.gap, T(0.0));
}

template <class T, int N>
UpdateFlags<T> Subloading::accept(State<T, N>& s, double tolerance) const {
  UpdateFlags<T> flags = hold_at_floor(s);
  const auto h = homothety(s);
  flags.corrected = h.R > T(1.0 + tolerance);
  if (any(flags.corrected)) {
    const Sym<T, N> on_surface = s.a + (T(1.0) / h.R) * (s.sigma - s.a);
    for (int i = 0; i < N; ++i) s.sigma[i] = select(flags.corrected, on_surface[i], s.sigma[i]);
  }
  part_where_torn(s, h.exists, flags);
  return flags;
}

}  // namespace scarp
