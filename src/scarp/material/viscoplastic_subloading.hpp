// The viscoplastic subloading model: the surface, flow and hardening of the subloading model (subloading.hpp), with a
// plastic strain that takes time. An overstress of Hashiguchi's type,
//
//   ‖ε̇^vp‖ = (1/μ) ⟨R − R_s⟩ⁿ / (R_m − R),
//
// drives it, with R of the stress, the static ratio R_s that follows the subloading hardening law (eq. 31), and the
// ratio R_m that no stress reaches, however fast. K. Hashiguchi, X. Wu, T. Okayasu, S. Tsutsumi, Time-dependent
// elastoplastic constitutive model; with this surface J. R. Maranha, C. Pereira, A. Vieira (2016). What they leave open
// is settled in docs/models/viscoplastic-subloading.md. Compression positive.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "scarp/material/subloading.hpp"

namespace scarp {

class ViscoplasticSubloading {
 public:
  struct Parameters {
    double mu;   ///< viscosity [time]
    double n;    ///< exponent of the overstress
    double R_m;  ///< R that no stress exceeds
  };

  /// The subloading model's state, and the overstress R − R_s. It is stored instead of R_s because unloading keeps it
  /// at zero exactly, where R_s would have to follow R digit by digit.
  template <class T, int N>
  struct State : Subloading::State<T, N> {
    T overstress;  ///< R − R_s ≥ 0

    template <class F, class... States>
    static void each(F&& f, States&... s) {
      Subloading::State<T, N>::each(f, s...);
      f(s.overstress...);
    }
  };

  ViscoplasticSubloading(const Subloading& law, const Parameters& p) : law_(law), c_(p) {}

  static ModelDescription description();
  /// Constants from the keys of description(), all present and within their bounds; what only shows between constants
  /// is checked here.
  static ViscoplasticSubloading from_values(const std::map<std::string, double>& values, std::vector<Problem>& problems,
                                            std::vector<Problem>& warnings);

  const Parameters& parameters() const { return c_; }
  /// The elastoplastic law that slow straining tends to.
  const Subloading& slow_limit() const { return law_; }

  /// The static ratio of a state that stands at R.
  template <class T, int N>
  T R_s(const State<T, N>& s, const T& R) const {
    return max(T(law_.parameters().R_min), R - s.overstress);
  }

  /// ‖ε̇^vp‖ [1/time]
  template <class T>
  T flow(const T& overstress, const T& R) const {
    const T power = exp(T(c_.n) * log(max(T(1e-300), overstress)));
    const T drive = select(power > T(1e-100), power, T(0.0));  // nothing, below what a norm can square
    return T(1.0 / c_.mu) * drive / max(T(1e-12), T(c_.R_m) - R);
  }

  template <class T, int N>
  Rate<State<T, N>, T> rate(const State<T, N>& s, const Sym<T, N>& deps, const T& dt) const;

  /// The pair's step, after the part of the increment that closes what is open.
  template <class Pair, class T, int N>
  Trial<State<T, N>, T> update(const State<T, N>& s, const Increment<T, N>& step, double tolerance) const {
    return after_closing<Pair>(*this, s, step, tolerance);
  }

  template <class T, int N>
  Mask<T> admissible(const State<T, N>& s) const {
    return law_.admissible(s) && (law_.homothety(s).R < T(c_.R_m));
  }

  /// As of the subloading model, with the absolute error of the overstress.
  template <class T, int N>
  T error_norm(const State<T, N>& s, const State<T, N>& e) const {
    const T other = law_.error_norm(s, e);
    return sqrt(other * other + e.overstress * e.overstress);
  }

  template <class T, int N>
  UpdateFlags<T> accept(State<T, N>& s, double tolerance) const;

  /// K + 4G/3
  template <class T, int N>
  T p_wave_modulus(const State<T, N>& s) const {
    return law_.p_wave_modulus(s);
  }

  /// As of the subloading model, without overstress.
  template <int N>
  State<double, N> initial_state(const Sym<double, N>& sigma, double vertical, const Values& keys,
                                 std::vector<Problem>& problems) const;

  template <int N>
  std::vector<double> derived(const State<double, N>& s) const {
    auto all = law_.derived(s);
    all.insert(all.begin() + 1, R_s(s, all[0]));
    return all;
  }

 private:
  Subloading law_;
  Parameters c_;
};

template <class T, int N>
Rate<ViscoplasticSubloading::State<T, N>, T> ViscoplasticSubloading::rate(const State<T, N>& s, const Sym<T, N>& deps,
                                                                          const T& dt) const {
  const auto y = law_.image(s);
  const auto r = law_.hardening(s, y);
  const T depsvp = dt * flow(s.overstress, y.h.R);  // ‖dε^vp‖
  const T dLambda = depsvp / y.norm_g;

  // What the consistency condition of the elastoplastic law makes zero, the overstress grows by: R of the stress, less
  // R_s by eq. 31. Unloading consumes it and then takes R_s along.
  const T R_rate = law_.R_per_strain(R_s(s, y.h.R)) * y.norm_g;
  const T growth =
      (law_.elastic_normal_part(y, deps) - dLambda * law_.stiffness(s, y, r, R_rate)) / law_.normal_part(y, y.from_a);
  const Mask<T> above = (y.h.R > T(law_.parameters().R_min)) && ((s.overstress > T(0.0)) || (growth > T(0.0)));

  Rate<State<T, N>, T> result;
  law_.change(y, r, deps, dLambda, result.change);
  result.change.overstress = select(above, growth, T(0.0));
  result.sound = y.h.exists && (s.p_c > T(0.0)) && (y.K > T(0.0)) && (y.h.R < T(c_.R_m));
  law_.open_where_parted(s, deps, result);
  return result;
}

/// Stress above the yield surface is the law's own here; it is inadmissible from R_m on.
template <class T, int N>
UpdateFlags<T> ViscoplasticSubloading::accept(State<T, N>& s, double) const {
  UpdateFlags<T> flags = law_.hold_at_floor(s);
  flags.corrected = no_lanes<T>();
  const auto h = law_.homothety(s);
  law_.part_where_torn(s, h.exists, flags);
  flags.sound = flags.sound && (flags.separated || (h.R < T(c_.R_m)));
  // R_min ≤ R_s ≤ R; R is 0 where stress and centre have become zero.
  const T R = select(flags.separated, T(0.0), h.R);
  s.overstress = max(T(0.0), min(s.overstress, R - T(law_.parameters().R_min)));
  return flags;
}

}  // namespace scarp
