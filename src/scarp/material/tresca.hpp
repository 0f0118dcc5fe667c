// Linear elasticity with the yield surface of Tresca: undrained clay in total stress. Compression positive.
//   f = σ1 − σ3 − 2 s_u(κ), associated flow
// (R. Hill, The Mathematical Theory of Plasticity, 1950, ch. II). It is Mohr and Coulomb's without friction.
#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include "scarp/material/description.hpp"
#include "scarp/material/elastoplastic.hpp"
#include "scarp/material/mohr_coulomb_return.hpp"

namespace scarp {

class Tresca : public ElastoplasticLaw<Tresca> {
 public:
  struct Parameters {
    double E, nu;   ///< Young's modulus [stress], Poisson's ratio
    Softening s_u;  ///< undrained shear strength [stress]
  };

  explicit Tresca(const Parameters& p) : ElastoplasticLaw(p.E, p.nu), parameters_(p) {}

  static ModelDescription description();
  /// Constants from the keys of description(), all present and within their bounds; what only shows between constants
  /// is checked here.
  static Tresca from_values(const std::map<std::string, double>& values, std::vector<Problem>& problems,
                            std::vector<Problem>& warnings);

  const Parameters& parameters() const { return parameters_; }
  bool softens() const { return parameters_.s_u.active(); }

  template <class T>
  elastoplastic::PrincipalStrength<T> strength(const T& kappa) const {
    return {T(0.0), T(0.0), T(2.0) * parameters_.s_u(kappa), T(0.0)};
  }

  template <class T, int N>
  Spectral<T, N> resolve(const Sym<T, N>& trial) const {
    return spectral(trial);
  }
  template <class T, int N>
  Correction<std::array<T, 3>, T> correction(const Spectral<T, N>& at, const T& kappa) const {
    const auto y = strength(kappa);
    return elastoplastic::principal_correction(elastoplastic::mohr_coulomb_return<false>(at.value, y, elasticity_),
                                               elasticity_);
  }
  template <class T, int N>
  Excess<T> excess(const Spectral<T, N>& at, const T& kappa, const Sym<T, N>& way) const {
    return elastoplastic::principal_excess<false>(at, strength(kappa), way);
  }
  template <class T, int N>
  Sym<T, N> compose(const Spectral<T, N>& at, const Correction<std::array<T, 3>, T>& c) const {
    return composed(c.size, at.projection);
  }

  /// Errors of stress are taken relative to ‖σ‖ and the strength, as in the other laws; relative to the strength alone
  /// they cost remoulded clay that flows some five times the substeps.
  template <class T, int N>
  T error_norm(const PlasticState<T, N>& s, const PlasticState<T, N>& e) const {
    return elastoplastic::error_norm(e, norm(s.sigma) + T(2.0) * parameters_.s_u(s.kappa));
  }

  /// Elastic; whether the strength carries it depends on the depth, and initial_state() says so.
  double K0() const { return parameters_.nu / (1.0 - parameters_.nu); }

 private:
  Parameters parameters_;
};

}  // namespace scarp
