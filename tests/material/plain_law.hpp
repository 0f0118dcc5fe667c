// The subloading law a second time, slow and obvious: 3 × 3 matrices, R by bisection, gradients of f and g by dual
// numbers, the hardening modulus in its long form, the Lode angle by acos. Oracle of the law's tests.
#pragma once

#include "scarp/material/subloading.hpp"
#include "unit/tensor/matrix.hpp"

namespace scarp::test {

struct PlainState {
  Matrix sigma, beta, a;
  double p_c, R_b;
};

struct PlainRate {
  Matrix sigma, beta, a, epsp;
  double p_c, R_b;
  double R;                ///< of the state
  double R_change;         ///< by eq. 31 when plastic, by the elastic stress change when not
  double H_long, H_short;  ///< both forms of the hardening modulus
  bool plastic;
};

/// f of eq. 21, or g of eq. 30 with the given alpha.
double yield_function(const Subloading::Parameters& c, const Matrix& sigma, const Matrix& beta, double p_c,
                      double alpha = 1);

/// η_β,cs as the root of its quadratic equation, M_cs = M_c h(θ).
double plain_eta(const Subloading::Parameters& c, double M_cs);

/// h(θ) as printed by Willam & Warnke, with θ the Lode angle (0 in triaxial compression).
double plain_willam_warnke(double theta, double k);

PlainRate plain_rate(const Subloading::Parameters& c, const PlainState& s, const Matrix& deps);

template <int N>
PlainState to_plain(const Subloading::State<double, N>& s) {
  return {to_matrix(s.sigma), to_matrix(s.beta), to_matrix(s.a), s.p_c, s.R_b};
}

}  // namespace scarp::test
