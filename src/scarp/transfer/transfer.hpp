// Points → nodes and nodes → points for the points of one element: the sums of the report's steps 1, 4, 5, 6 and 10,
// in its symbols. No loops over the mesh and no threads here. Tension positive.
#pragma once

#include <array>

#include "scarp/transfer/quadrature.hpp"

namespace scarp::transfer {

/// What one local node receives from its element's points in step 1.
template <int Dim>
struct NodeSums {
  double m = 0;      ///< eq. 1
  Vec<Dim> p{};      ///< momentum, eq. 2
  Vec<Dim> F_int{};  ///< internal force, eq. 4
};

/// What step 3 leaves at a node for its points.
template <int Dim>
struct NodeMotion {
  Vec<Dim> a{};  ///< acceleration, eq. 5
  Vec<Dim> v{};  ///< velocity at t + dt before the second mapping: v^t + a dt
};

/// Step 1: m_i += Σ m_p N_i, p_i += Σ m_p v_p N_i, F_i^int += Σ B_iᵀ σ_p Ω_p (eqs 1, 2, 4). Gravity (eq. 3) is uniform,
/// so F_i^grav = m_i g is formed at the node. Ω_p and B_i are those of the element's quadrature; the weight stays with
/// the points for the rest of the step.
template <class Shape>
void points_to_nodes(const NodePositions<Shape>& x_i, const Quadrature& quadrature, Points<2>& points, Range range,
                     std::array<NodeSums<2>, Shape::nodes>& sums) {
  for (int k = 0; k < range.count; ++k) {
    const int p = range.order[k];
    std::array<double, Shape::nodes> N;
    std::array<Vec<2>, Shape::nodes> B;
    gradients<Shape>(x_i, {points.xi[0][p], points.xi[1][p]}, N, B);
    for (int i = 0; i < Shape::nodes; ++i) {
      for (int j = 0; j < 2; ++j) B[i][j] += quadrature.shift[i][j];
    }
    points.weight[p] = quadrature.weight;
    const double m = points.mass[p], Omega = quadrature.weight * points.volume[p];
    const double mv_x = m * points.v[0][p], mv_y = m * points.v[1][p];
    const double s_xx = Omega * points.sigma[0][p], s_yy = Omega * points.sigma[1][p];
    const double s_xy = Omega * points.sigma[3][p] * (1 / sqrt2);
    for (int i = 0; i < Shape::nodes; ++i) {
      sums[i].m += m * N[i];
      sums[i].p[0] += mv_x * N[i];
      sums[i].p[1] += mv_y * N[i];
      sums[i].F_int[0] += B[i][0] * s_xx + B[i][1] * s_xy;
      sums[i].F_int[1] += B[i][0] * s_xy + B[i][1] * s_yy;
    }
  }
}

/// Steps 4 and 5: v_p += Σ a_i N_i dt (eq. 6), blended with the share 1 − flip of the interpolated nodal velocity
/// (PIC), then p_i += Σ m_p v_p N_i (eq. 7). Returns the kinetic energy that the PIC share takes from the points.
template <class Shape>
double update_velocities(const std::array<NodeMotion<2>, Shape::nodes>& node, double dt, double flip, Points<2>& points,
                         Range range, std::array<Vec<2>, Shape::nodes>& momentum) {
  double taken = 0;
  for (int k = 0; k < range.count; ++k) {
    const int p = range.order[k];
    std::array<double, Shape::nodes> N;
    Shape::shape({points.xi[0][p], points.xi[1][p]}, N);
    Vec<2> a{}, v_pic{};
    for (int i = 0; i < Shape::nodes; ++i) {
      for (int j = 0; j < 2; ++j) {
        a[j] += node[i].a[j] * N[i];
        v_pic[j] += node[i].v[j] * N[i];
      }
    }
    const double m = points.mass[p];
    for (int j = 0; j < 2; ++j) {
      const double v_flip = points.v[j][p] + a[j] * dt;
      const double v = v_flip + (1 - flip) * (v_pic[j] - v_flip);
      taken += 0.5 * m * (v_flip * v_flip - v * v);
      points.v[j][p] = v;
      for (int i = 0; i < Shape::nodes; ++i) momentum[i][j] += m * v * N[i];
    }
  }
  return taken;
}

/// Steps 6, 8, 9 and 10 from the nodal velocities v_i of eq. 8: L = Σ v_i ⊗ ∇N_i (eq. 9), strain and spin increments
/// (eqs 10, 11), volume by det(I + L dt) (eq. 14 in its finite form; the density of eq. 15 is m_p / Ω_p), displacement
/// and position (eqs 16–19). Returns Σ m_p du_p, for the work of gravity.
template <class Shape>
Vec<2> nodes_to_points(const NodePositions<Shape>& x_i, const Quadrature& quadrature,
                       const std::array<Vec<2>, Shape::nodes>& v_i, double dt, Points<2>& points, Range range) {
  Vec<2> moved{};
  for (int k = 0; k < range.count; ++k) {
    const int p = range.order[k];
    std::array<double, Shape::nodes> N;
    std::array<Vec<2>, Shape::nodes> B;
    gradients<Shape>(x_i, {points.xi[0][p], points.xi[1][p]}, N, B);
    double du_x = 0, du_y = 0, L_xx = 0, L_xy = 0, L_yx = 0, L_yy = 0;  // times dt
    for (int i = 0; i < Shape::nodes; ++i) {
      const double du_ix = dt * v_i[i][0], du_iy = dt * v_i[i][1];
      du_x += du_ix * N[i];
      du_y += du_iy * N[i];
      const double B_x = B[i][0] + quadrature.shift[i][0], B_y = B[i][1] + quadrature.shift[i][1];
      L_xx += du_ix * B_x;
      L_xy += du_ix * B_y;
      L_yx += du_iy * B_x;
      L_yy += du_iy * B_y;
    }
    points.deps[0][p] = L_xx;
    points.deps[1][p] = L_yy;
    points.deps[2][p] = 0;
    points.deps[3][p] = (L_xy + L_yx) * (0.5 * sqrt2);
    points.spin[0][p] = 0.5 * (L_xy - L_yx);
    points.volume[p] *= (1 + L_xx) * (1 + L_yy) - L_xy * L_yx;
    points.u[0][p] += du_x;
    points.u[1][p] += du_y;
    points.x[0][p] += du_x;
    points.x[1][p] += du_y;
    moved[0] += points.mass[p] * du_x;
    moved[1] += points.mass[p] * du_y;
  }
  return moved;
}

}  // namespace scarp::transfer
