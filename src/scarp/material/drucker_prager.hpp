// Linear elasticity with the cone of Drucker and Prager, non-associated flow and softening from peak to residual
// strength. Compression positive.
//   f = q − M(κ) p − k(κ),  M = 6 sin φ/(3 − sin φ),  k = 6 c cos φ/(3 − sin φ);   g = q − M_ψ(κ) p
// The cone goes through Mohr and Coulomb's edges of triaxial compression (Drucker & Prager 1952; the match is that of
// most critical state work). docs/models/drucker-prager.md has the other matches.
#pragma once

#include <cmath>
#include <map>
#include <string>
#include <vector>

#include "scarp/material/description.hpp"
#include "scarp/material/elastoplastic.hpp"

namespace scarp {

class DruckerPrager : public ElastoplasticLaw<DruckerPrager, PartingState> {
 public:
  struct Parameters {
    double E, nu;        ///< Young's modulus [stress], Poisson's ratio
    Softening c;         ///< cohesion [stress]
    Softening phi, psi;  ///< angles of friction and dilation in triaxial compression [degrees]
  };

  explicit DruckerPrager(const Parameters& p);

  static ModelDescription description();
  /// Constants from the keys of description(), all present and within their bounds; what only shows between constants
  /// is checked here.
  static DruckerPrager from_values(const std::map<std::string, double>& values, std::vector<Problem>& problems,
                                   std::vector<Problem>& warnings);

  const Parameters& parameters() const { return parameters_; }
  bool softens() const { return softens_; }

  template <class T>
  struct Cone {
    T M, k;   ///< slope and cohesion [stress] of the strength
    T M_psi;  ///< slope of the potential
  };
  template <class T>
  Cone<T> cone(const T& kappa) const;

  template <class T, int N>
  struct At {
    Sym<T, N> s;  ///< deviator
    T q, p;
  };
  template <class T, int N>
  At<T, N> resolve(const Sym<T, N>& trial) const {
    const Sym<T, N> s = deviator(trial);
    return {s, T(sqrt_3_2) * norm(s), mean(trial)};
  }

  template <class T>
  struct Fall {
    T p;      ///< of the mean stress
    T share;  ///< of the deviator
  };
  template <class T, int N>
  Correction<Fall<T>, T> correction(const At<T, N>& at, const T& kappa) const;

  template <class T, int N>
  Excess<T> excess(const At<T, N>& at, const T& kappa, const Sym<T, N>& way) const {
    const auto y = cone(kappa);
    return {at.q - y.M * at.p - y.k, T(1.5) * dot(at.s, way) / max(at.q, T(1e-300)) - y.M * mean(way)};
  }
  template <class T, int N>
  Sym<T, N> compose(const At<T, N>& at, const Correction<Fall<T>, T>& c) const {
    return c.size.share * at.s + isotropic<T, N>(c.size.p);
  }

  /// Flow around the apex has dε_v = −M_ψ dε_q: what expands beyond that opens.
  template <class T, int N>
  T opening(const At<T, N>& at, const T& kappa) const {
    return T(-1.0 / elasticity_.K) * at.p - cone(kappa).M_psi * T(1.0 / (3.0 * elasticity_.G)) * at.q;
  }

  /// Errors of stress are taken relative to ‖σ‖ + c + E/10⁵: what a strain of 10⁻⁵ makes is not followed to digits that
  /// nobody sees where a cohesionless point stands at no stress.
  template <class T, int N>
  T error_norm(const State<T, N>& s, const State<T, N>& e) const {
    return elastoplastic::error_norm(e, norm(s.sigma) + T(parameters_.c.peak + 1e-5 * parameters_.E));
  }

  /// Elastic, or what friction alone can hold back (active pressure) where that is more.
  double K0() const {
    const double M = cone(0.0).M, elastic = parameters_.nu / (1.0 - parameters_.nu);
    const double active = (3.0 - M) / (3.0 + 2.0 * M);
    return elastic > active ? elastic : active;
  }

 private:
  Parameters parameters_;
  bool softens_;
  double sin_phi_, cos_phi_, sin_psi_;  ///< at the peak
};

template <class T>
DruckerPrager::Cone<T> DruckerPrager::cone(const T& kappa) const {
  constexpr double degree = 0.017453292519943295769;
  T sin_phi(sin_phi_), cos_phi(cos_phi_), sin_psi(sin_psi_);
  if (parameters_.phi.active()) {
    const T angle = T(degree) * parameters_.phi(kappa);
    sin_phi = sin(angle);
    cos_phi = cos(angle);
  }
  if (parameters_.psi.active()) sin_psi = sin(T(degree) * parameters_.psi(kappa));
  const T scale = T(6.0) / (T(3.0) - sin_phi);
  return {scale * sin_phi, scale * parameters_.c(kappa) * cos_phi, T(6.0) * sin_psi / (T(3.0) - sin_psi)};
}

/// dε^p = dΛ ∂g/∂σ has dκ = dΛ and dε_v^p = −M_ψ dΛ: q falls by 3G Δκ and p grows by K M_ψ Δκ. What that would carry
/// past q = 0 returns to the apex, p = −k/M.
template <class T, int N>
Correction<DruckerPrager::Fall<T>, T> DruckerPrager::correction(const At<T, N>& at, const T& kappa) const {
  const auto [M, k, M_psi] = cone(kappa);
  const T G3(3.0 * elasticity_.G), K(elasticity_.K);
  const T f = at.q - M * at.p - k;
  const Mask<T> plastic = f > T(elastoplastic::on_surface) * (at.q + abs(at.p) + k);
  const T dLambda = f / (G3 + K * M * M_psi);
  const Mask<T> apex = G3 * dLambda > at.q;
  const T shear = select(apex, at.q, G3 * dLambda);
  const Mask<T> rough = M > T(1e-12);  // without friction there is no apex
  const T end = -k / select(rough, M, T(1.0));
  const T fall = select(apex && rough, at.p - end, -K * M_psi * dLambda), zero(0.0);
  const T share = select(apex, T(1.0), shear / select(apex || !plastic, T(1.0), at.q));
  return {{select(plastic, fall, zero), select(plastic, share, zero)},
          select(plastic, shear / G3, zero),
          plastic,
          plastic && apex && (k <= zero)};
}

}  // namespace scarp
