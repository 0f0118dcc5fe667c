// Strain, spin and stress of one point for the twin: plain 3 × 3 arithmetic on L dt, tension positive.
#pragma once

#include <array>
#include <cmath>

#include "scarp/step/step.hpp"

namespace scarp::test {

using Matrix = std::array<std::array<double, 3>, 3>;

inline Matrix product(const Matrix& a, const Matrix& b) {
  Matrix c{};
  for (int j = 0; j < 3; ++j) {
    for (int k = 0; k < 3; ++k) {
      for (int l = 0; l < 3; ++l) c[j][k] += a[j][l] * b[l][k];
    }
  }
  return c;
}

inline Matrix transposed(const Matrix& a) {
  Matrix c;
  for (int j = 0; j < 3; ++j) {
    for (int k = 0; k < 3; ++k) c[j][k] = a[k][j];
  }
  return c;
}

/// I + f a
inline Matrix one_and(double f, const Matrix& a) {
  Matrix c;
  for (int j = 0; j < 3; ++j) {
    for (int k = 0; k < 3; ++k) c[j][k] = (j == k) + f * a[j][k];
  }
  return c;
}

inline double determinant(const Matrix& f) {
  double det = 0;
  for (int k = 0; k < 3; ++k) {
    det += f[0][k] * (f[1][(k + 1) % 3] * f[2][(k + 2) % 3] - f[1][(k + 2) % 3] * f[2][(k + 1) % 3]);
  }
  return det;
}

/// By cofactors.
inline Matrix inverted(const Matrix& a) {
  Matrix c;
  const double det = determinant(a);
  for (int j = 0; j < 3; ++j) {
    for (int k = 0; k < 3; ++k) {
      const int j1 = (j + 1) % 3, j2 = (j + 2) % 3, k1 = (k + 1) % 3, k2 = (k + 2) % 3;
      c[k][j] = (a[j1][k1] * a[j2][k2] - a[j1][k2] * a[j2][k1]) / det;
    }
  }
  return c;
}

/// ½ (a ± aᵀ)
inline Matrix half_sum(const Matrix& a, double sign) {
  Matrix c;
  for (int j = 0; j < 3; ++j) {
    for (int k = 0; k < 3; ++k) c[j][k] = 0.5 * (a[j][k] + sign * a[k][j]);
  }
  return c;
}

/// Strain and spin increments of L dt: its parts (eqs 10, 11), or those of L dt (I + ½ L dt)⁻¹ in the middle of the
/// step, of which the strain is turned to its end by half the spin (Cayley).
struct Kinematics {
  Matrix strain, spin;

  Kinematics(Matrix L, bool middle) {
    if (middle) L = product(L, inverted(one_and(0.5, L)));
    strain = half_sum(L, 1);
    spin = half_sum(L, -1);
    if (!middle) return;
    const Matrix turn = product(inverted(one_and(-0.25, spin)), one_and(0.25, spin));
    strain = product(turn, product(strain, transposed(turn)));
  }
};

/// What a stress update starts from, and whether it parts the point from the body.
template <int N>
struct Updated {
  Sym<double, N> turned;
  bool separated;
};

/// Turns the state (compression positive) with the spin; then the law takes the strain.
template <int N, class Model, class State>
Updated<N> update_stress(const Model& model, State& s, const Kinematics& k, double dt,
                         const IntegrationSettings& settings) {
  Sym<double, N> deps = Sym<double, N>::zero();
  Spin<double, N> spin;
  for (int j = 0; j < 3; ++j) deps[j] = -k.strain[j][j];
  const int pairs[3][2] = {{0, 1}, {1, 2}, {2, 0}};
  for (int c = 0; c < (N == 4 ? 1 : 3); ++c) {
    const int j = pairs[c][0], l = pairs[c][1];
    deps[3 + c] = -std::sqrt(2.0) * k.strain[j][l];
    spin.w[c] = k.spin[j][l];
  }
  rotate(s, Rotation<double, N>(spin));
  const Sym<double, N> turned = s.sigma;
  const Increment<double, N> increment{deps, dt};
  const auto whole = attempt<ModifiedEuler>(model, s, increment, settings.tolerance);
  if (whole.flags.sound && whole.error <= settings.tolerance) {
    s = whole.state;
    return {turned, whole.flags.separated};
  }
  return {turned, integrate<ModifiedEuler>(model, s, increment, settings, 0.5).flags.separated};
}

}  // namespace scarp::test
