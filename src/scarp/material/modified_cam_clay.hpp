// Modified Cam Clay (Roscoe & Burland 1968) in the form that the subloading model contains: natural strains,
// compression lines straight in (ln p, ln v) (Butterfield 1979), Poisson's ratio constant, yield surface circular in
// the deviatoric plane, associated flow. Elastic inside the yield surface. Equation numbers are the report's.
// Compression positive.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "scarp/material/description.hpp"
#include "scarp/material/integrate/embedded.hpp"
#include "scarp/material/state.hpp"

namespace scarp {

class ModifiedCamClay {
 public:
  struct Parameters {
    double kappa, lambda;  ///< slopes κ̄, λ̄ in (ln p, ln v)
    double nu;             ///< Poisson's ratio
    double p_e;            ///< p at which v → ∞ is −p_e [stress]
    double M;              ///< critical state stress ratio q/p
    double p_atm;          ///< atmospheric pressure [stress]
    double p_c_floor;      ///< least p_c over p_atm (0: none)
  };

  template <class T, int N>
  struct State {
    Sym<T, N> sigma;  ///< effective stress
    Sym<T, N> epsp;   ///< plastic strain
    T p_c;            ///< size of the yield surface along the hydrostatic axis

    template <class F, class... States>
    static void each(F&& f, States&... s) {
      f(s.sigma...);
      f(s.epsp...);
      f(s.p_c...);
    }
  };

  explicit ModifiedCamClay(const Parameters& p);

  static ModelDescription description();
  /// Constants from the keys of description(), all present and within their bounds; kappa < lambda is checked here.
  static ModifiedCamClay from_values(const std::map<std::string, double>& values, std::vector<Problem>& problems,
                                     std::vector<Problem>& warnings);

  const Parameters& parameters() const { return c_; }

  /// f = (q/M)² + p (p − p_c); negative inside.
  template <class T, int N>
  T yield(const Sym<T, N>& sigma, const T& p_c) const {
    const T p = mean(sigma);
    const Sym<T, N> s = deviator(sigma);
    return T(1.5 / (c_.M * c_.M)) * dot(s, s) + p * (p - p_c);
  }

  /// p_c of the yield surface through sigma, whose mean is positive.
  template <class T, int N>
  T p_c_through(const Sym<T, N>& sigma) const {
    return yield(sigma, T(0.0)) / mean(sigma);
  }

  /// Elastic inside the yield surface; on it, to 1e-9 p_c², plastic where N:D:dε > 0.
  template <class T, int N>
  Rate<State<T, N>, T> rate(const State<T, N>& s, const Sym<T, N>& deps) const {
    return rate_where(yield(s.sigma, s.p_c) >= T(-1e-9) * s.p_c * s.p_c, s, deps);
  }

  /// The elastic part of an increment in closed form, up to where it meets the yield surface; from there by the pair.
  template <class Pair = ModifiedEuler, class T, int N>
  Trial<State<T, N>, T> update(const State<T, N>& s, const Increment<T, N>& increment, double tolerance) const;

  template <class T, int N>
  Mask<T> admissible(const State<T, N>& s) const {
    return (s.p_c > T(0.0)) && (mean(s.sigma) + T(c_.p_e) > T(0.0));
  }

  /// √(sum of squares) of the relative errors of sigma and p_c and the absolute one of epsp. Stress is taken relative
  /// to ‖σ‖ + p_c/10, so that a point at nearly no stress is not followed to digits that nobody sees.
  template <class T, int N>
  T error_norm(const State<T, N>& s, const State<T, N>& e) const {
    const T scale = T(1.0) / (norm(s.sigma) + T(0.1) * s.p_c), pc = e.p_c / s.p_c;
    return sqrt(scale * scale * dot(e.sigma, e.sigma) + dot(e.epsp, e.epsp) + pc * pc);
  }

  template <class T, int N>
  UpdateFlags<T> accept(State<T, N>& s, double tolerance) const;

  /// K + 4G/3
  template <class T, int N>
  T p_wave_modulus(const State<T, N>& s) const {
    return (mean(s.sigma) + T(c_.p_e)) * T((1.0 + 2.0 / 3.0 * g2_) / c_.kappa);
  }

  /// The state at `sigma` from a region's keys (description().initial). `vertical` is the component of sigma that POP
  /// adds to [stress].
  template <int N>
  State<double, N> initial_state(const Sym<double, N>& sigma, double vertical, const Values& keys,
                                 std::vector<Problem>& problems) const;

  /// The keys of soil on its normal compression line: where a one-dimensional history starts.
  Values normally_consolidated() const { return {{"OCR", 1.0}}; }

  /// R, ε_v^p, ε_q^p
  template <int N>
  std::vector<double> derived(const State<double, N>& s) const {
    const double R = mean(s.sigma) > 0 ? p_c_through(s.sigma) / s.p_c : 0.0;
    return {R, trace(s.epsp), sqrt_2_3 * norm(deviator(s.epsp))};
  }

 private:
  /// What dΛ = 1 does at a state: N = ∂f/∂σ with deviator n_s s and trace f_p, and the rate of p_c.
  template <class T, int N>
  struct Flow {
    Sym<T, N> s;
    T f_p, K, pc_rate;
    T stiffness;  ///< N:D:N + H
  };
  template <class T, int N>
  Flow<T, N> flow(const State<T, N>& s) const;

  /// The change of a state by a strain of which dLambda N is plastic.
  template <class T, int N>
  State<T, N> change(const Flow<T, N>& at, const T& dLambda, const Sym<T, N>& deps) const;

  template <class T, int N>
  T loading(const Flow<T, N>& at, const Sym<T, N>& deps) const {  // N:D:dε
    return at.K * (T(n_s_ * g2_) * dot(at.s, deps) + at.f_p * trace(deps));
  }

  template <class T, int N>
  Rate<State<T, N>, T> rate_where(const Mask<T>& on_surface, const State<T, N>& s, const Sym<T, N>& deps) const;

  /// The law on the yield surface, for the pairs: whether a stage is plastic is not asked of its own f, which is off
  /// zero by the stage's low order.
  struct OnSurface {
    const ModifiedCamClay& law;

    template <class S, class T, int N>
    auto rate(const S& s, const Sym<T, N>& deps) const {
      return law.rate_where(T(0.0) == T(0.0), s, deps);
    }
    template <class S>
    auto error_norm(const S& s, const S& e) const {
      return law.error_norm(s, e);
    }
    template <class S>
    auto accept(const S& s, double) const {
      const auto sound = law.admissible(s);
      return UpdateFlags<decltype(s.p_c + s.p_c)>{!sound, !sound, !sound, sound};
    }
  };

  /// Stress after an elastic increment. p + p_e grows by exp(dε_v/κ̄), and s along with p: in stress the path is
  /// straight.
  template <class T, int N>
  Sym<T, N> elastic(const Sym<T, N>& sigma, const Sym<T, N>& deps) const;

  /// Share of the way from a stress inside or on the yield surface to a stress outside it, where it leaves: the
  /// positive root of f(σ + β Δσ) = A β² + 2 B β + C, C ≤ 0. On the surface and going in it is where the way comes out
  /// again.
  template <class T, int N>
  T exit_share(const State<T, N>& s, const Sym<T, N>& dsigma) const;

  /// Back to f = 0 at the same total strain: plastic strain f/(N:D:N + H) N (Potts & Gens 1985), where `mask` is set.
  template <class T, int N>
  void return_to_surface(State<T, N>& s, const Mask<T>& mask) const;

  Parameters c_;
  double n_s_;    ///< 3/M²
  double g2_;     ///< 2G/K, eq. 27
  double floor_;  ///< of p_c [stress]
};

template <class T, int N>
ModifiedCamClay::Flow<T, N> ModifiedCamClay::flow(const State<T, N>& s) const {
  Flow<T, N> r;
  const T p = mean(s.sigma);
  r.s = deviator(s.sigma);
  r.K = (p + T(c_.p_e)) * T(1.0 / c_.kappa);  // eq. 26
  r.f_p = T(2.0) * p - s.p_c;
  r.pc_rate = T(1.0 / (c_.lambda - c_.kappa)) * (s.p_c + T(c_.p_e)) * r.f_p;  // eq. 37 without bonds, ξ = 0
  r.pc_rate = select(s.p_c <= T(floor_), max(T(0.0), r.pc_rate), r.pc_rate);
  // H = −∂f/∂p_c p_c' = p p_c'
  r.stiffness = r.K * (T(n_s_ * n_s_ * g2_) * dot(r.s, r.s) + r.f_p * r.f_p) + p * r.pc_rate;
  return r;
}

template <class T, int N>
ModifiedCamClay::State<T, N> ModifiedCamClay::change(const Flow<T, N>& at, const T& dLambda,
                                                     const Sym<T, N>& deps) const {
  State<T, N> r;
  r.epsp = (dLambda * T(n_s_)) * at.s + isotropic<T, N>(dLambda * at.f_p * T(1.0 / 3.0));
  const Sym<T, N> elastic = deps - r.epsp;
  r.sigma = (T(g2_) * at.K) * deviator(elastic) + isotropic<T, N>(at.K * trace(elastic));  // eqs 25, 27
  r.p_c = dLambda * at.pc_rate;
  return r;
}

template <class T, int N>
Rate<ModifiedCamClay::State<T, N>, T> ModifiedCamClay::rate_where(const Mask<T>& on_surface, const State<T, N>& s,
                                                                  const Sym<T, N>& deps) const {
  const auto at = flow(s);
  const T NDe = loading(at, deps);
  const Mask<T> plastic = on_surface && (NDe > T(0.0));
  const Mask<T> solvable = (at.stiffness > T(0.0)) || !plastic;
  return {change(at, select(plastic, NDe / at.stiffness, T(0.0)), deps), admissible(s) && solvable};
}

template <class T, int N>
Sym<T, N> ModifiedCamClay::elastic(const Sym<T, N>& sigma, const Sym<T, N>& deps) const {
  const T u = mean(sigma) + T(c_.p_e), y = trace(deps) * T(1.0 / c_.kappa), growth = expm1(y);
  const Mask<T> constant = abs(y) < T(1e-100);
  const T average =
      u * select(constant, T(1.0), growth / select(constant, T(1.0), y));  // of p + p_e over the increment
  return sigma + (T(g2_ / c_.kappa) * average) * deviator(deps) + isotropic<T, N>(u * growth);
}

template <class T, int N>
T ModifiedCamClay::exit_share(const State<T, N>& s, const Sym<T, N>& dsigma) const {
  const Sym<T, N> dev = deviator(s.sigma), ddev = deviator(dsigma);
  const T p = mean(s.sigma), dp = mean(dsigma), m(0.5 * n_s_);
  const T A = m * dot(ddev, ddev) + dp * dp;
  const T B = m * dot(dev, ddev) + dp * (p - T(0.5) * s.p_c);
  const T C = min(T(0.0), m * dot(dev, dev) + p * (p - s.p_c));
  const T root = sqrt(B * B - A * C);
  const Mask<T> inward = B <= T(0.0);
  return min(T(1.0), select(inward, root - B, -C) / (select(inward, A, root + B) + T(1e-300)));
}

template <class T, int N>
void ModifiedCamClay::return_to_surface(State<T, N>& s, const Mask<T>& mask) const {
  const auto at = flow(s);
  const T dLambda = select(mask && (at.stiffness > T(0.0)), yield(s.sigma, s.p_c) / at.stiffness, T(0.0));
  s = advanced(s, T(1.0), change(at, dLambda, Sym<T, N>::zero()));
}

template <class Pair, class T, int N>
Trial<ModifiedCamClay::State<T, N>, T> ModifiedCamClay::update(const State<T, N>& s, const Increment<T, N>& increment,
                                                               double tolerance) const {
  const Sym<T, N>& deps = increment.deps;
  Trial<State<T, N>, T> trial{s, T(0.0), {}};
  trial.state.sigma = elastic(s.sigma, deps);
  // A point that rests is not taken back to the surface by the rounding that it stands beyond it.
  const Mask<T> inside = (yield(trial.state.sigma, s.p_c) <= T(0.0)) || (dot(deps, deps) == T(0.0));
  const Mask<T> start = admissible(s);
  Mask<T> sound = start, drifted = !start && start;
  if (!all(inside)) {
    const Sym<T, N> way = trial.state.sigma - s.sigma;
    const T share = exit_share(s, way);
    State<T, N> at_yield = s;
    at_yield.sigma = s.sigma + share * way;
    // The stress way is straight, but not run through evenly: the strain that it takes.
    const T y = trace(deps) * T(1.0 / c_.kappa);
    const Mask<T> even = abs(y) < T(1e-100);
    const T strain_share = select(even, share, log1p(share * expm1(y)) / select(even, T(1.0), y));
    auto plastic = attempt_pair<Pair>(OnSurface{*this}, at_yield, (T(1.0) - strain_share) * increment, tolerance);
    // Loading at the end: f = 0 there. Not loading: f may be less.
    const T f = yield(plastic.state.sigma, plastic.state.p_c),
            band = T(tolerance) * plastic.state.p_c * plastic.state.p_c;
    return_to_surface(plastic.state, (f > T(0.0)) || (loading(flow(plastic.state), deps) > T(0.0)));
    trial.state = select_state(inside, trial.state, plastic.state);
    trial.error = select(inside, T(0.0), plastic.error);
    sound = sound && (inside || plastic.flags.sound);
    drifted = !inside && (abs(f) > band);
  }
  trial.flags = accept(trial.state, tolerance);
  trial.flags.corrected = trial.flags.corrected || drifted;
  trial.flags.sound = trial.flags.sound && sound;
  return trial;
}

template <class T, int N>
UpdateFlags<T> ModifiedCamClay::accept(State<T, N>& s, double tolerance) const {
  UpdateFlags<T> flags;
  // Dilation drives p_c to zero in soil that shears at a free surface, and strength and stiffness with it.
  flags.sound = s.p_c > T(0.0);
  flags.on_floor = s.p_c <= T(floor_ * (1.0 + 1e-9));
  s.p_c = select(flags.on_floor, T(floor_), s.p_c);
  flags.corrected = yield(s.sigma, s.p_c) > T(tolerance) * s.p_c * s.p_c;
  return_to_surface(s, flags.corrected);

  // The yield surface ends at p = 0. At its floor nothing is left of it there: the point parts from the body, until it
  // is compressed. Without p_e no stress comes to p = 0, and none could leave it.
  const T p = mean(s.sigma);
  flags.separated = flags.on_floor && (p <= T(tolerance) * s.p_c) && (T(c_.p_e) > T(0.0));
  for (int i = 0; i < N; ++i) s.sigma[i] = select(flags.separated, T(0.0), s.sigma[i]);
  const T excess = yield(s.sigma, s.p_c);
  flags.sound = flags.sound && admissible(s) && (excess <= T(2.0 * tolerance) * s.p_c * s.p_c);
  return flags;
}

}  // namespace scarp
