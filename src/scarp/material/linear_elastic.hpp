// Isotropic linear elasticity (hypoelastic under rotation).
#pragma once

#include <string>
#include <vector>

#include "scarp/material/description.hpp"
#include "scarp/material/state.hpp"

namespace scarp {

class LinearElastic {
 public:
  static constexpr bool elastic = true;  ///< no strain is kept: see is_elastic() in models.hpp

  struct Parameters {
    double E;   ///< Young's modulus [stress]
    double nu;  ///< Poisson's ratio
  };

  template <class T, int N>
  struct State {
    Sym<T, N> sigma;

    template <class F, class... States>
    static void each(F&& f, States&... s) {
      f(s.sigma...);
    }
  };

  explicit LinearElastic(const Parameters& p)
      : parameters_(p), K_(p.E / (3.0 * (1.0 - 2.0 * p.nu))), G2_(p.E / (1.0 + p.nu)) {}

  static ModelDescription description();
  /// Constants from the keys of description(), all present and within their bounds.
  static LinearElastic from_values(const std::map<std::string, double>& values, std::vector<Problem>& problems,
                                   std::vector<Problem>& warnings);

  const Parameters& parameters() const { return parameters_; }

  template <class T, int N>
  Rate<State<T, N>, T> rate(const State<T, N>&, const Sym<T, N>& deps) const {
    const T pressure = T(K_ - G2_ / 3.0) * trace(deps);
    return {{T(G2_) * deps + isotropic<T, N>(pressure)}, pressure == pressure};
  }

  template <class T, int N>
  Mask<T> admissible(const State<T, N>& s) const {
    return s.sigma[0] == s.sigma[0];
  }

  /// Any pair of order 1 or more is exact.
  template <class T, int N>
  T error_norm(const State<T, N>&, const State<T, N>&) const {
    return T(0.0);
  }

  template <class T, int N>
  UpdateFlags<T> accept(State<T, N>& s, double) const {
    const Mask<T> nan = s.sigma[0] != s.sigma[0], none = no_lanes<T>();
    return {none, none, none, !nan};
  }

  template <class T, int N>
  T p_wave_modulus(const State<T, N>&) const {
    return T(K_ + 2.0 / 3.0 * G2_);
  }

  /// Horizontal over vertical stress where nothing moves sideways.
  double K0() const { return parameters_.nu / (1.0 - parameters_.nu); }

  template <int N>
  State<double, N> initial_state(const Sym<double, N>& sigma, double, const Values&, std::vector<Problem>&) const {
    return {sigma};
  }

  template <int N>
  std::vector<double> derived(const State<double, N>&) const {
    return {};
  }

 private:
  Parameters parameters_;
  double K_, G2_;
};

}  // namespace scarp
