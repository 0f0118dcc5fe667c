// Exactly orthogonal incremental rotation of symmetric tensors: in place of the report's eqs 12 and 13, whose
// first-order form drifts. Hughes & Winget (1980): Q = (I − W/2)⁻¹ (I + W/2), W = dω the spin increment (eq. 11).
#pragma once

#include "scarp/tensor/sym.hpp"

namespace scarp {

/// The spin increment dω of a step: W_xy in the plane, the axial components W_xy, W_yz, W_zx in 3D
/// (W_ij = ½(∂v_i/∂x_j − ∂v_j/∂x_i) dt).
template <class T, int N>
struct Spin {
  std::array<T, N == 4 ? 1 : 3> w;
};

/// Turns tensors with the body by one increment: R(A) = Q A Qᵀ.
template <class T, int N>
class Rotation;

template <class T>
class Rotation<T, 4> {
 public:
  explicit Rotation(const Spin<T, 4>& spin) {
    // In the plane Q turns by the angle φ with tan(φ/2) = −W_xy/2 (W_xy = −φ' of an anticlockwise turn).
    const T h = T(-0.5) * spin.w[0];
    const T scale = T(1.0) / (T(1.0) + h * h);
    const T c = (T(1.0) - h * h) * scale, s = T(2.0) * h * scale;
    cc_ = c * c;
    ss_ = s * s;
    cs_ = c * s;
  }

  Sym<T, 4> operator()(const Sym<T, 4>& a) const {
    const T shear = T(sqrt2) * cs_ * a[3];
    return {{cc_ * a[0] + ss_ * a[1] - shear, ss_ * a[0] + cc_ * a[1] + shear, a[2],
             T(sqrt2) * cs_ * (a[0] - a[1]) + (cc_ - ss_) * a[3]}};
  }

 private:
  T cc_, ss_, cs_;
};

template <class T>
class Rotation<T, 6> {
 public:
  explicit Rotation(const Spin<T, 6>& spin) {
    // Q = I + (W + W²/2) / (1 + |ω|²/4): the closed form of the Cayley transform, with ω the axial vector of W.
    const T x = -spin.w[1], y = -spin.w[2], z = -spin.w[0];  // W_yz = −ω_x, W_zx = −ω_y, W_xy = −ω_z
    const T k = T(1.0) / (T(1.0) + T(0.25) * (x * x + y * y + z * z)), h = T(0.5) * k;
    q_[0][0] = T(1.0) - h * (y * y + z * z);
    q_[1][1] = T(1.0) - h * (x * x + z * z);
    q_[2][2] = T(1.0) - h * (x * x + y * y);
    q_[0][1] = h * x * y - k * z;
    q_[1][0] = h * x * y + k * z;
    q_[0][2] = h * x * z + k * y;
    q_[2][0] = h * x * z - k * y;
    q_[1][2] = h * y * z - k * x;
    q_[2][1] = h * y * z + k * x;
  }

  Sym<T, 6> operator()(const Sym<T, 6>& a) const {
    const T r(1.0 / sqrt2);
    const T m[3][3] = {{a[0], r * a[3], r * a[5]}, {r * a[3], a[1], r * a[4]}, {r * a[5], r * a[4], a[2]}};
    T qm[3][3];
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) qm[i][j] = q_[i][0] * m[0][j] + q_[i][1] * m[1][j] + q_[i][2] * m[2][j];
    auto at = [&](int i, int j) { return qm[i][0] * q_[j][0] + qm[i][1] * q_[j][1] + qm[i][2] * q_[j][2]; };
    return {{at(0, 0), at(1, 1), at(2, 2), T(sqrt2) * at(0, 1), T(sqrt2) * at(1, 2), T(sqrt2) * at(2, 0)}};
  }

 private:
  T q_[3][3];
};

}  // namespace scarp
