// Linear elasticity with the yield surface of von Mises: undrained clay in total stress. Compression positive.
//   f = q − √3 s_u(κ), associated flow
// s_u is the strength in plane strain and simple shear, where √J2 = (σ1 − σ3)/2 = s_u (R. Hill, The Mathematical Theory
// of Plasticity, 1950, ch. II and VI).
#pragma once

#include <map>
#include <string>
#include <vector>

#include "scarp/material/description.hpp"
#include "scarp/material/elastoplastic.hpp"

namespace scarp {

class VonMises : public ElastoplasticLaw<VonMises> {
 public:
  struct Parameters {
    double E, nu;   ///< Young's modulus [stress], Poisson's ratio
    Softening s_u;  ///< undrained shear strength [stress]
  };

  explicit VonMises(const Parameters& p) : ElastoplasticLaw(p.E, p.nu), parameters_(p) {}

  static ModelDescription description();
  /// Constants from the keys of description(), all present and within their bounds; what only shows between constants
  /// is checked here.
  static VonMises from_values(const std::map<std::string, double>& values, std::vector<Problem>& problems,
                              std::vector<Problem>& warnings);

  const Parameters& parameters() const { return parameters_; }
  bool softens() const { return parameters_.s_u.active(); }

  template <class T, int N>
  struct At {
    Sym<T, N> s;  ///< deviator
    T q;
  };
  template <class T, int N>
  At<T, N> resolve(const Sym<T, N>& trial) const {
    const Sym<T, N> s = deviator(trial);
    return {s, T(sqrt_3_2) * norm(s)};
  }

  /// Radial return (Wilkins 1964): q falls by the excess, 3G Δκ = q − √3 s_u. `size` is the share of s that goes.
  template <class T, int N>
  Correction<T, T> correction(const At<T, N>& at, const T& kappa) const {
    const T excess = at.q - T(sqrt3) * parameters_.s_u(kappa);
    const Mask<T> plastic = excess > T(elastoplastic::on_surface) * at.q, none = no_lanes<T>();
    const T fall = select(plastic, excess, T(0.0));
    return {fall / select(plastic, at.q, T(1.0)), T(1.0 / (3.0 * elasticity_.G)) * fall, plastic, none};
  }
  template <class T, int N>
  Excess<T> excess(const At<T, N>& at, const T& kappa, const Sym<T, N>& way) const {
    return {at.q - T(sqrt3) * parameters_.s_u(kappa), T(1.5) * dot(at.s, way) / max(at.q, T(1e-300))};
  }
  template <class T, int N>
  Sym<T, N> compose(const At<T, N>& at, const Correction<T, T>& c) const {
    return c.size * at.s;
  }

  /// Errors of stress are taken relative to ‖σ‖ and the strength, as in the other laws; relative to the strength alone
  /// they cost remoulded clay that flows some five times the substeps.
  template <class T, int N>
  T error_norm(const PlasticState<T, N>& s, const PlasticState<T, N>& e) const {
    return elastoplastic::error_norm(e, norm(s.sigma) + T(sqrt3) * parameters_.s_u(s.kappa));
  }

  /// Elastic; whether the strength carries it depends on the depth, and initial_state() says so.
  double K0() const { return parameters_.nu / (1.0 - parameters_.nu); }

 private:
  Parameters parameters_;
};

}  // namespace scarp
