// The subloading model of the report, section 3: Modified Cam Clay yield surface, plastic strain inside it, rotating
// (anisotropy beta), bonded (structure R_b), with a moving centre of homothety a and non-associated flow. Equation
// numbers are the report's; docs/models/subloading.md says what it leaves open and how that is settled.
// Compression positive.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "scarp/material/description.hpp"
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

    template <class F, class... States>
    static void each(F&& f, States&... s) {
      f(s.sigma...);
      f(s.beta...);
      f(s.a...);
      f(s.epsp...);
      f(s.p_c...);
      f(s.R_b...);
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

  template <class T, int N>
  Rate<State<T, N>, T> rate(const State<T, N>& s, const Sym<T, N>& deps) const;

  template <class T, int N>
  Mask<T> admissible(const State<T, N>& s) const {
    return homothety(s).exists && (s.p_c > T(0.0)) && (mean(s.sigma) + T(c_.p_e) > T(0.0));
  }

  /// √(sum of squares) of the relative errors of sigma, a, p_c, R_b and the absolute ones of beta and epsp. Stresses
  /// are taken relative to ‖σ‖ + p_c/10, so that a point at nearly no stress is not followed to digits that nobody
  /// sees.
  template <class T, int N>
  T error_norm(const State<T, N>& s, const State<T, N>& e) const {
    const T scale = T(1.0) / (norm(s.sigma) + T(0.1) * s.p_c);
    const T pc = e.p_c / s.p_c, rb = e.R_b / s.R_b;
    return sqrt(scale * scale * (dot(e.sigma, e.sigma) + dot(e.a, e.a)) + dot(e.beta, e.beta) + dot(e.epsp, e.epsp) +
                pc * pc + rb * rb);
  }

  template <class T, int N>
  Notes<T> accept(State<T, N>& s, double tolerance) const;

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
    return {homothety(s).R, trace(s.epsp), 0.81649658092772603273 * norm(deviator(s.epsp))};
  }

  /// η_β,cs: the stress ratio that beta tends to (this project's closure), from the critical state ratio M_cs(θ).
  template <class T>
  T eta_beta_cs(const T& M_cs) const;

 private:
  Parameters c_;
  double g2_;     ///< 2G/K, eq. 27
  double floor_;  ///< of p_c [stress]
};

template <class T, int N>
Subloading::Homothety<T, N> Subloading::homothety(const State<T, N>& s) const {
  Homothety<T, N> h;
  const double m = 1.5 / (c_.M * c_.M);
  const Sym<T, N> d = s.sigma - s.a;
  h.p_a = mean(s.a);
  h.p_d = mean(d);
  h.S0 = deviator(s.a) - h.p_a * s.beta;
  h.S1 = deviator(d) - h.p_d * s.beta;
  const T pa_bar = h.p_a + T(c_.xi) * s.p_c;
  // Eq. 20 on eq. 21: A u² + 2 B u + C = 0 for u = 1/R.
  const T A = T(m) * dot(h.S1, h.S1) + h.p_d * h.p_d;
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
  const double i2 = 1.0 / (c_.alpha * c_.alpha), e = 2.0 * i2 - 1.0;
  const T b = T(i2 - 1.0) * M_cs;
  const T gap = M_cs * M_cs - T(c_.M * c_.M);
  const T root = sqrt(max(T(0.0), b * b + T(e) * gap));
  // Two forms of the same root; the second stays finite at α² = 2, where e = 0.
  const T eta = c_.alpha <= 1.0 ? (b + root) / T(e) : gap / (root - b);
  return max(T(0.0), eta);
}

template <class T, int N>
Rate<Subloading::State<T, N>, T> Subloading::rate(const State<T, N>& s, const Sym<T, N>& deps) const {
  const T p = mean(s.sigma);
  const T K = (p + T(c_.p_e)) * T(1.0 / c_.kappa);  // eq. 26
  const T G2 = T(g2_) * K;                          // 2G, eq. 27
  const T de_v = trace(deps);
  const Sym<T, N> de = deviator(deps);

  // The homothetic image σ_y of σ on the yield surface. Below R_min nothing of it is used: u stays finite.
  const auto h = homothety(s);
  const T R = max(h.R, T(c_.R_min));
  const T u = T(1.0) / R;
  const Sym<T, N> s_bar = h.S0 + u * h.S1;
  const T p_bar = h.p_a + u * h.p_d + T(c_.xi) * s.p_c;

  // N = ∂f/∂σ and G = ∂g/∂σ at σ_y, eqs 21–24, 30: deviator n_s s_bar and trace f_p; deviator g_s s_bar and trace g_p.
  const double n_s = 3.0 / (c_.M * c_.M), g_s = n_s / (c_.alpha * c_.alpha);
  const T along = dot(s_bar, s.beta);
  const T cap = T(2.0) * p_bar - s.p_c;
  const T f_p = cap - T(n_s) * along, g_p = cap - T(g_s) * along;
  const T ss = dot(s_bar, s_bar);
  const T norm_g_dev = T(g_s) * sqrt(ss);
  const T norm_g = sqrt(norm_g_dev * norm_g_dev + g_p * g_p * T(1.0 / 3.0));
  const T NDe = T(n_s) * G2 * dot(s_bar, de) + K * f_p * de_v;
  const T NDG = T(n_s * g_s) * G2 * ss + K * f_p * g_p;

  // Rates of the internal variables per unit plastic multiplier.
  const T R_rate =
      T(-c_.c_R) * log(max(T(1e-300), (h.R - T(c_.R_min)) * T(1.0 / (1.0 - c_.R_min)))) * norm_g;  // eq. 31
  const Sym<T, N> s_now = deviator(s.sigma) - p * s.beta;
  const T size = norm(s_now);
  const T inverse = select(size > T(1e-13) * s.p_c, T(1.0) / size, T(0.0));
  const T eta = eta_beta_cs(T(c_.M_c) * willam_warnke(cos_3_lode(s_now), c_.k));
  const Sym<T, N> beta_rate = (T(c_.c_beta / c_.p_atm) * norm_g_dev * p) *
                              (T(0.81649658092772603273) * eta * inverse * s_now - s.beta);  // eq. 32
  const T b_rate = T(c_.c_b) * (T(c_.R_bf) - s.R_b) * norm_g;                                // eq. 36
  T pc_rate = T(1.0 / (c_.lambda - c_.kappa)) * (s.p_c + s.R_b * T(c_.p_e / (1.0 - c_.xi))) * g_p +
              s.p_c / s.R_b * b_rate;  // eq. 37
  pc_rate = select(s.p_c <= T(floor_), max(T(0.0), pc_rate), pc_rate);
  const T pc_relative = pc_rate / s.p_c;
  // Eq. 38: σ̄_y − a with c the centre of the yield surface, σ̄_y = σ_y − δ (σ_y − c).
  const Sym<T, N> to_image = u * (s.sigma - s.a);
  const T p_centre = T(0.5 - c_.xi) * s.p_c;
  const Sym<T, N> centre = p_centre * s.beta + isotropic<T, N>(p_centre);
  const Sym<T, N> pull = (T(c_.c_a) * norm_g) * (to_image - T(c_.delta) * (s.a + to_image - centre));
  const Sym<T, N> a_rate = pull + pc_relative * s.a + h.p_a * beta_rate;

  // Consistency of f(σ_y) = 0 (f is homogeneous of degree two in σ and p_c):
  // H = N : [ (p_c'/p_c) σ + p β' + (1 − R) c_a ‖G‖ (σ̄_y − a) + R' (σ_y − a) ]
  const Sym<T, N> inner = pc_relative * s.sigma + p * beta_rate + (T(1.0) - R) * pull + R_rate * to_image;
  const T H = T(n_s) * dot(s_bar, deviator(inner)) + f_p * mean(inner);

  const T stiffness = NDG + H;
  const Mask<T> plastic = (h.R > T(c_.R_min)) && (NDe > T(0.0));  // eq. 28
  const T dLambda = select(plastic, NDe / stiffness, T(0.0));

  Rate<State<T, N>, T> r;
  const T shear = dLambda * T(g_s);
  r.change.epsp = shear * s_bar + isotropic<T, N>(dLambda * g_p * T(1.0 / 3.0));
  r.change.sigma = G2 * (de - shear * s_bar) + isotropic<T, N>(K * (de_v - dLambda * g_p));  // eq. 25
  r.change.beta = dLambda * beta_rate;
  r.change.a = dLambda * a_rate;
  r.change.p_c = dLambda * pc_rate;
  r.change.R_b = dLambda * b_rate;
  r.sound = h.exists && (s.p_c > T(0.0)) && (K > T(0.0)) && ((stiffness > T(0.0)) || !plastic);
  return r;
}

template <class T, int N>
Notes<T> Subloading::accept(State<T, N>& s, double tolerance) const {
  Notes<T> notes;
  // Dilation drives p_c to zero in soil that shears at a free surface; below the floor `a` would lose its yield
  // surface.
  notes.on_floor = s.p_c <= T(floor_ * (1.0 + 1e-9));
  const T scale = select(notes.on_floor, T(floor_) / s.p_c, T(1.0));
  notes.sound = s.p_c > T(0.0);
  s.p_c = select(notes.on_floor, T(floor_), s.p_c);
  s.a = scale * s.a;

  const auto h = homothety(s);
  notes.corrected = h.R > T(1.0 + tolerance);
  const Sym<T, N> image = s.a + (T(1.0) / h.R) * (s.sigma - s.a);
  for (int i = 0; i < N; ++i) s.sigma[i] = select(notes.corrected, image[i], s.sigma[i]);

  // At the floor the bonds are gone and so is the tensile strength: the point parts from the body, until it is
  // compressed.
  const T p = mean(s.sigma);
  notes.separated = (p <= T(0.0)) && (notes.on_floor || (p + T(c_.p_e) <= T(0.01 * c_.p_e)));
  notes.sound = notes.sound && (notes.separated || (h.exists && (p + T(c_.p_e) > T(0.0))));
  for (int i = 0; i < N; ++i) {
    s.sigma[i] = select(notes.separated, T(0.0), s.sigma[i]);
    s.a[i] = select(notes.separated, T(0.0), s.a[i]);
  }
  return notes;
}

}  // namespace scarp
