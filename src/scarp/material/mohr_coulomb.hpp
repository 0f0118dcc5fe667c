// Linear elasticity with the strength of Mohr and Coulomb, non-associated flow, a tension cut-off and softening from
// peak to residual strength. Compression positive, σ1 ≥ σ2 ≥ σ3.
//   f = (σ1 − σ3) − (σ1 + σ3) sin φ(κ) − 2 c(κ) cos φ(κ),   g = (σ1 − σ3) − (σ1 + σ3) sin ψ(κ)
//   σ3 ≥ −t, t = min(tension, c cot φ), flow associated
// (Coulomb 1773; Koiter 1953 for the flow on edges and corners; Rankine's cut-off). docs/models/mohr-coulomb.md.
#pragma once

#include <array>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "scarp/material/description.hpp"
#include "scarp/material/elastoplastic.hpp"
#include "scarp/material/mohr_coulomb_return.hpp"

namespace scarp {

class MohrCoulomb : public ElastoplasticLaw<MohrCoulomb, PartingState> {
 public:
  struct Parameters {
    double E, nu;        ///< Young's modulus [stress], Poisson's ratio
    Softening c;         ///< cohesion [stress]
    Softening phi, psi;  ///< angles of friction and dilation [degrees]
    double tension;      ///< tensile strength [stress]; no more than the apex
  };

  explicit MohrCoulomb(const Parameters& p);

  static ModelDescription description();
  /// Constants from the keys of description(), all present and within their bounds; what only shows between constants
  /// is checked here.
  static MohrCoulomb from_values(const std::map<std::string, double>& values, std::vector<Problem>& problems,
                                 std::vector<Problem>& warnings);

  const Parameters& parameters() const { return parameters_; }
  bool softens() const { return softens_; }

  template <class T>
  elastoplastic::PrincipalStrength<T> strength(const T& kappa) const;

  template <class T, int N>
  Spectral<T, N> resolve(const Sym<T, N>& trial) const {
    return spectral(trial);
  }
  template <class T, int N>
  Correction<std::array<T, 3>, T> correction(const Spectral<T, N>& at, const T& kappa) const {
    const auto y = strength(kappa);
    auto r = elastoplastic::mohr_coulomb_return<true>(at.value, y, elasticity_);
    r.apex = r.apex && (y.tension <= T(0.0));  // separated where the stress is zero
    return elastoplastic::principal_correction(r, elasticity_);
  }
  template <class T, int N>
  Excess<T> excess(const Spectral<T, N>& at, const T& kappa, const Sym<T, N>& way) const {
    return elastoplastic::principal_excess<true>(at, strength(kappa), way);
  }
  template <class T, int N>
  Sym<T, N> compose(const Spectral<T, N>& at, const Correction<std::array<T, 3>, T>& c) const {
    return composed(c.size, at.projection);
  }

  template <class T, int N>
  T opening(const Spectral<T, N>& at, const T& kappa) const {
    return elastoplastic::apex_opening(at.value, strength(kappa), elasticity_);
  }

  /// Errors of stress are taken relative to ‖σ‖ + c + E/10⁵: what a strain of 10⁻⁵ makes is not followed to digits that
  /// nobody sees where a cohesionless point stands at no stress.
  template <class T, int N>
  T error_norm(const State<T, N>& s, const State<T, N>& e) const {
    return elastoplastic::error_norm(e, norm(s.sigma) + T(parameters_.c.peak + 1e-5 * parameters_.E));
  }

  /// Elastic, or what friction alone can hold back (active pressure) where that is more.
  double K0() const {
    const double s = strength(0.0).sin_phi, elastic = parameters_.nu / (1.0 - parameters_.nu);
    return elastic > (1.0 - s) / (1.0 + s) ? elastic : (1.0 - s) / (1.0 + s);
  }

 private:
  Parameters parameters_;
  bool softens_;
  double sin_phi_, cos_phi_, sin_psi_;  ///< at the peak
};

template <class T>
elastoplastic::PrincipalStrength<T> MohrCoulomb::strength(const T& kappa) const {
  constexpr double degree = 0.017453292519943295769;
  const auto& [E, nu, c, phi, psi, tension] = parameters_;
  elastoplastic::PrincipalStrength<T> y{T(sin_phi_), T(sin_psi_), c(kappa), T(tension)};
  T cos_phi(cos_phi_);
  if (phi.active()) {
    const T angle = T(degree) * phi(kappa);
    y.sin_phi = sin(angle);
    cos_phi = cos(angle);
  }
  if (psi.active()) y.sin_psi = sin(T(degree) * psi(kappa));
  const T along = y.cohesion * cos_phi;
  const Mask<T> rough = y.sin_phi > T(1e-12);  // without friction there is no apex
  y.tension = select(rough, min(y.tension, along / select(rough, y.sin_phi, T(1.0))), y.tension);
  y.cohesion = T(2.0) * along;
  return y;
}

}  // namespace scarp
