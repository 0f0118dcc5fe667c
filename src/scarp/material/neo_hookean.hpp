// Compressible neo-Hookean elasticity: J σ = λ ln J I + μ (b − I), b = F Fᵀ (tension positive), from the energy
// W = ½ μ (tr b − 3) − μ ln J + ½ λ (ln J)² per volume of the natural state; Bonet & Wood, Nonlinear Continuum
// Mechanics for Finite Element Analysis, section 6.4. An elastic law, not a rate of one: stress follows from b, and b
// from the increments exactly, so that nothing drifts. Compression positive here, as in all laws; b is a stretch and
// has no sign.
#pragma once

#include <string>
#include <vector>

#include "scarp/material/description.hpp"
#include "scarp/material/increment.hpp"
#include "scarp/material/state.hpp"
#include "scarp/material/willam_warnke.hpp"
#include "scarp/tensor/exponential.hpp"

namespace scarp {

class NeoHookean {
 public:
  static constexpr bool elastic = true;  ///< no strain is kept: see is_elastic() in models.hpp

  struct Parameters {
    double E;   ///< Young's modulus of the natural state [stress]
    double nu;  ///< Poisson's ratio of the natural state
  };

  template <class T, int N>
  struct State {
    Sym<T, N> sigma;
    Sym<T, N> b;  ///< left Cauchy–Green tensor F Fᵀ from the natural state

    template <class F, class... States>
    static void each(F&& f, States&... s) {
      f(s.sigma...);
      f(s.b...);
    }
  };

  explicit NeoHookean(const Parameters& p)
      : parameters_(p), lambda_(p.E * p.nu / ((1.0 + p.nu) * (1.0 - 2.0 * p.nu))), mu_(0.5 * p.E / (1.0 + p.nu)) {}

  static ModelDescription description();
  /// Constants from the keys of description(), all present and within their bounds.
  static NeoHookean from_values(const std::map<std::string, double>& values, std::vector<Problem>& problems,
                                std::vector<Problem>& warnings);

  const Parameters& parameters() const { return parameters_; }
  double lambda() const { return lambda_; }
  double mu() const { return mu_; }

  /// σ of b, compression positive.
  template <class T, int N>
  Sym<T, N> stress(const Sym<T, N>& b) const {
    const T J2 = det(b), inverse = T(1.0) / sqrt(J2);
    return (T(-mu_) * inverse) * b + isotropic<T, N>((T(mu_) - T(0.5 * lambda_) * log(J2)) * inverse);
  }

  /// What update() integrates, to first order: b' = d b + b d with d = −dε, and σ' from it.
  template <class T, int N>
  Rate<State<T, N>, T> rate(const State<T, N>& s, const Sym<T, N>& deps) const {
    const T inverse = T(1.0) / sqrt(det(s.b)), dJ = trace(deps);  // −J'/J
    const Sym<T, N> db = T(-2.0) * symmetric_product(deps, s.b);
    const Sym<T, N> dsigma = dJ * s.sigma - (T(mu_) * inverse) * db + isotropic<T, N>(T(lambda_) * inverse * dJ);
    return {{dsigma, db}, admissible(s)};
  }

  /// Exact for an increment of constant principal directions, which is a natural strain: b → exp(d) b exp(d), d = −dε,
  /// the stretch being F → exp(d) F. The error is that of the exponential's series.
  template <class T, int N>
  Trial<State<T, N>, T> update(const State<T, N>& s, const Increment<T, N>& increment, double tolerance) const {
    Trial<State<T, N>, T> trial;
    trial.state.b = triple_product(exponential(T(-1.0) * increment.deps), s.b);
    trial.state.sigma = stress(trial.state.b);
    trial.error = T(2.0) * exponential_error(increment.deps);
    trial.flags = accept(trial.state, tolerance);
    // Rounding would move a state to which nothing happens.
    trial.state = select_state(dot(increment.deps, increment.deps) == T(0.0), s, trial.state);
    return trial;
  }

  template <class T, int N>
  Mask<T> admissible(const State<T, N>& s) const {
    const T J2 = det(s.b);
    return (J2 > T(0.0)) && (J2 < T(1e300)) && (trace(s.b) > T(0.0));
  }

  /// Of b alone: the stress follows from it.
  template <class T, int N>
  T error_norm(const State<T, N>& s, const State<T, N>& e) const {
    return norm(e.b) / norm(s.b);
  }

  template <class T, int N>
  UpdateFlags<T> accept(State<T, N>& s, double) const {
    const Mask<T> none = no_lanes<T>();
    return {none, none, none, admissible(s)};
  }

  /// The largest ρ c² over all directions n. The acoustic tensor is [(λ + μ − λ ln J) n⊗n + μ (n·b·n) I]/J, so that
  /// longitudinal waves meet [λ (1 − ln J) + μ (1 + n·b·n)]/J: n along the largest stretch is the stiffest.
  template <class T, int N>
  T p_wave_modulus(const State<T, N>& s) const {
    const T J2 = det(s.b);
    const T longitudinal = T(lambda_ + mu_) - T(0.5 * lambda_) * log(J2);
    return (max(longitudinal, T(0.0)) + T(mu_) * largest_principal(s.b)) / sqrt(J2);
  }

  /// Horizontal over vertical stress where nothing moves sideways, at small strain.
  double K0() const { return parameters_.nu / (1.0 - parameters_.nu); }

  /// b from sigma (compression positive); a problem where no stable state has this stress.
  template <int N>
  State<double, N> initial_state(const Sym<double, N>& sigma, double, const Values&,
                                 std::vector<Problem>& problems) const;

  /// The volume ratio J.
  template <int N>
  std::vector<double> derived(const State<double, N>& s) const {
    return {sqrt(det(s.b))};
  }

 private:
  /// Mean + 2 √(J2/3) cos θ with the Lode angle θ of the deviator; cos θ = cos(π/3 − θ') where cos 3θ' = −cos 3θ.
  template <class T, int N>
  static T largest_principal(const Sym<T, N>& b) {
    const Sym<T, N> dev = deviator(b);
    return mean(b) + T(sqrt_2_3) * norm(dev) * cos_third_angle(T(0.0) - cos_3_lode(dev));
  }

  Parameters parameters_;
  double lambda_, mu_;  ///< Lamé's constants of the natural state
};

}  // namespace scarp
