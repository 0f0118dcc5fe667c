// The transfers of one element in their general form: the report's lines, a point and a node after the other, for any
// basis with a Cell. The program runs the same with a node or a point in each lane (points_to_nodes.hpp,
// nodes_to_points.hpp and what they stand on); these are what those forms are compared with
// (tests/unit/transfer/general_test.cpp), and what a new basis has before it has fast forms of its own. Tension
// positive.
#pragma once

#include <algorithm>
#include <array>

#include "scarp/mesh/axisymmetric.hpp"
#include "scarp/mesh/basis.hpp"
#include "scarp/transfer/local.hpp"

namespace scarp::transfer::general {

/// N_i and B_i at one point; and of the circumference N_i / r in a body of revolution, zero elsewhere.
template <class Basis>
struct Shapes {
  std::array<double, Basis::nodes> N, N_r{};
  std::array<Vec<Basis::dim>, Basis::nodes> B;
};

/// What the functions of a basis take of point p.
template <class Basis>
auto local_coordinates(const typename Basis::Cell& cell, const Points<Basis::dim>& points, int p) {
  Vec<Basis::dim> at;
  for (int j = 0; j < Basis::dim; ++j) at[j] = Basis::stores_local ? points.xi[j][p] : points.x[j][p];
  if constexpr (Basis::stores_local) {
    return at;
  } else if constexpr (Basis::has_domains) {
    return cell.local(at, half_edge<Basis::dim>(points.initial_volume[p]));
  } else {
    return cell.local(at);
  }
}

template <class Basis>
Shapes<Basis> shapes_at(const typename Basis::Cell& cell, const Points<Basis::dim>& points, int p) {
  Shapes<Basis> at;
  cell.gradients(local_coordinates<Basis>(cell, points, p), at.N, at.B);
  if constexpr (is_axisymmetric<Basis>) {
    for (int i = 0; i < Basis::nodes; ++i) at.N_r[i] = at.N[i] / points.x[0][p];
  }
  return at;
}

/// Component (j, k) of a symmetric tensor of point p.
template <std::size_t n>
double component(const std::array<Column, n>& tensor, int j, int k, int p) {
  return tensor[mandel(j, k)][p] / (j == k ? 1 : sqrt2);
}

/// How the points of an element are its quadrature (transfer/quadrature.hpp): Ω̂_p = w Ω_p, B̂_i = B_i + s_i, and where
/// mean stress and volume strain are means B̄_i, with r-parts in a body of revolution.
template <class Basis>
struct Quadrature {
  using Gradients = std::array<Vec<Basis::dim>, Basis::nodes>;
  double weight = 1;
  Gradients s{};
  std::array<double, Basis::nodes> s_hoop{};
  bool averaged = false;
  Gradients mean{};
  std::array<double, Basis::nodes> mean_hoop{};
};

/// γ_p: the share of a point in the means of its element.
template <class Basis>
double share_of_mean(const typename Basis::Cell& cell, const Points<Basis::dim>& points, int p) {
  double share = 1;
  if constexpr (Basis::has_domains) {
    const auto at = local_coordinates<Basis>(cell, points, p);
    for (int d = 0; d < Basis::dim; ++d) {
      const double to_side = std::max(0.0, std::min(at.s[d], 1 - at.s[d]));
      if (at.lambda[d] > to_side) share *= to_side / at.lambda[d];
    }
  }
  return share;
}

/// That of an element full of soil: w = V / Σ Ω_p, s_i = B̄_i − Σ Ω_p B_i / Σ Ω_p with B̄_i = (1/V) ∫ ∇N_i dV; of points
/// with domains w = 1, s_i = 0 and B̄_i = Σ γ_p Ω_p B_i / Σ γ_p Ω_p.
template <class Basis, class Range>
Quadrature<Basis> full_element(const typename Basis::Cell& cell, const Points<Basis::dim>& points, const Range& range,
                               bool averaged) {
  constexpr int Dim = Basis::dim, K = Basis::nodes;
  Quadrature<Basis> q;
  q.averaged = averaged;
  double volume = 0, V = 0;
  std::array<double, K> h{};
  if constexpr (is_axisymmetric<Basis>) {
    cell.integrals(V, q.mean, h);
  } else if constexpr (Basis::corrects) {
    cell.integrals(V, q.mean);
  }
  for (const int p : range) volume += share_of_mean<Basis>(cell, points, p) * points.volume[p];
  for (int i = 0; i < K; ++i) {
    for (int j = 0; j < Dim; ++j) q.s[i][j] = q.mean[i][j] = Basis::corrects ? q.mean[i][j] / V : 0;
    q.s_hoop[i] = q.mean_hoop[i] = Basis::corrects ? h[i] / V : 0;
  }
  for (const int p : range) {
    const auto at = shapes_at<Basis>(cell, points, p);
    const double part = share_of_mean<Basis>(cell, points, p) * points.volume[p] / volume;
    for (int i = 0; i < K; ++i) {
      for (int j = 0; j < Dim; ++j)
        (Basis::corrects ? q.s : q.mean)[i][j] += (Basis::corrects ? -part : part) * at.B[i][j];
      q.s_hoop[i] -= part * at.N_r[i];
    }
  }
  if (Basis::corrects) q.weight = V / volume;
  return q;
}

/// What the nodes of an element have of its points.
template <class Basis>
struct NodeSums {
  std::array<double, Basis::nodes> m{};
  std::array<Vec<Basis::dim>, Basis::nodes> p{}, F{};
  std::array<std::array<double, Basis::nodes>, Basis::nodes> M{};
};

/// Step 1 for point p: m_i += m_p N_i (eq. 1), p_i += m_p v_p N_i (eq. 2) and F_i += B_iᵀ σ_p Ω_p (eq. 4), with Ω̂_p and
/// B̂_i of the quadrature for Ω_p and B_i; and M_ij += m_p N_i N_j. Points that carry C_p bring v_p + C_p (x_i − x_p).
template <class Basis>
void add_point(const typename Basis::Cell& cell, const Points<Basis::dim>& points, int p, const Quadrature<Basis>& q,
               const std::array<Column, sym_size<Basis::dim>>& sigma, NodeSums<Basis>& nodes,
               const std::array<Vec<Basis::dim>, Basis::nodes>* places = nullptr) {
  constexpr int Dim = Basis::dim, K = Basis::nodes, directions = is_axisymmetric<Basis> ? 3 : Dim;
  const auto at = shapes_at<Basis>(cell, points, p);
  const double m = points.mass[p], Omega = q.weight * points.volume[p];
  double mean = 0;  // s_p, of which the mean acts on B̄_i
  if (q.averaged) {
    for (int j = 0; j < directions; ++j) mean += component(sigma, j, j, p) / directions;
    mean *= share_of_mean<Basis>(cell, points, p);
  }
  for (int i = 0; i < K; ++i) {
    nodes.m[i] += m * at.N[i];
    for (int j = 0; j < Dim; ++j) {
      double v = points.v[j][p];
      for (int k = 0; k < Dim && places; ++k) v += points.C[j * Dim + k][p] * ((*places)[i][k] - points.x[k][p]);
      nodes.p[i][j] += m * v * at.N[i];
      for (int k = 0; k < Dim; ++k)
        nodes.F[i][j] += (at.B[i][k] + q.s[i][k]) * (component(sigma, j, k, p) - (j == k ? mean : 0)) * Omega;
      nodes.F[i][j] += q.mean[i][j] * mean * Omega;
    }
    if (is_axisymmetric<Basis>) {
      nodes.F[i][0] += (at.N_r[i] + q.s_hoop[i]) * (component(sigma, 2, 2, p) - mean) * Omega;
      nodes.F[i][0] += q.mean_hoop[i] * mean * Omega;
    }
    for (int j = 0; j < K; ++j) nodes.M[i][j] += m * at.N[i] * at.N[j];
  }
}

/// Σ w_i N_i at a point, for vectors w of the nodes.
template <class Basis>
Vec<Basis::dim> value(const Shapes<Basis>& at, const std::array<Vec<Basis::dim>, Basis::nodes>& w) {
  Vec<Basis::dim> sum{};
  for (int i = 0; i < Basis::nodes; ++i) {
    for (int j = 0; j < Basis::dim; ++j) sum[j] += w[i][j] * at.N[i];
  }
  return sum;
}

/// L dt = Σ du_i ⊗ B̂_i at point p (eq. 9), with the strain of the circumference in its place (3, 3), zero in plane
/// strain; of an element of mean dilatation with its part γ_p of the mean Σ du_i · B̄_i as trace.
template <class Basis>
std::array<std::array<double, 3>, 3> gradient(const typename Basis::Cell& cell, const Points<Basis::dim>& points, int p,
                                              const Quadrature<Basis>& q,
                                              const std::array<Vec<Basis::dim>, Basis::nodes>& du) {
  constexpr int Dim = Basis::dim, directions = is_axisymmetric<Basis> ? 3 : Dim;
  const auto at = shapes_at<Basis>(cell, points, p);
  std::array<std::array<double, 3>, 3> L{};
  double mean = 0;
  for (int i = 0; i < Basis::nodes; ++i) {
    for (int j = 0; j < Dim; ++j) {
      for (int k = 0; k < Dim; ++k) L[j][k] += du[i][j] * (at.B[i][k] + q.s[i][k]);
      mean += du[i][j] * q.mean[i][j];
    }
    if (is_axisymmetric<Basis>) L[2][2] += du[i][0] * (at.N_r[i] + q.s_hoop[i]);
    mean += du[i][0] * q.mean_hoop[i];
  }
  if (q.averaged) {
    const double more = share_of_mean<Basis>(cell, points, p) * (mean - L[0][0] - L[1][1] - L[2][2]) / directions;
    for (int j = 0; j < directions; ++j) L[j][j] += more;
  }
  return L;
}

}  // namespace scarp::transfer::general
