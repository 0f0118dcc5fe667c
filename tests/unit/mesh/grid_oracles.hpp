// The shape functions of grids by their definitions, one coordinate at a time: Cox and de Boor's recursion for
// B-splines, averages of hats over a point's domain for GIMP. Shares nothing with mesh/grid_bases.hpp but the numbering
// of nodes.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "scarp/mesh/mesh.hpp"

namespace scarp::test {

/// B-spline i of degree p on some knots, at u: de Boor 1978, ch. X, eqs (4) and (5), 0/0 = 0.
inline double cox_de_boor(const std::vector<double>& t, int i, int p, double u) {
  if (p == 0) {
    const bool last = t[i + 1] == t.back() && t[i] < t[i + 1];  // the last span holds its end
    return (u >= t[i] && (u < t[i + 1] || (last && u == t[i + 1]))) ? 1 : 0;
  }
  const double left = t[i + p] - t[i], right = t[i + p + 1] - t[i + 1];
  return (left > 0 ? (u - t[i]) / left * cox_de_boor(t, i, p - 1, u) : 0) +
         (right > 0 ? (t[i + p + 1] - u) / right * cox_de_boor(t, i + 1, p - 1, u) : 0);
}

/// Its derivative: de Boor 1978, ch. X, eq. (15).
inline double cox_de_boor_slope(const std::vector<double>& t, int i, int p, double u) {
  const double left = t[i + p] - t[i], right = t[i + p + 1] - t[i + 1];
  return p * ((left > 0 ? cox_de_boor(t, i, p - 1, u) / left : 0) -
              (right > 0 ? cox_de_boor(t, i + 1, p - 1, u) / right : 0));
}

inline std::vector<double> open_knots(int n) {
  std::vector<double> t{0, 0};
  for (int i = 0; i <= n; ++i) t.push_back(i);
  t.insert(t.end(), {static_cast<double>(n), static_cast<double>(n)});
  return t;
}

inline double hat(int i, double u) {
  return std::max(0.0, 1 - std::abs(u - i));
}

inline double hat_slope(int i, double u) {
  return u <= i - 1 || u >= i + 1 ? 0 : u < i ? 1 : -1;
}

/// Averages over u − l ... u + l of hat i and its slope, piece by piece between its corners: midpoints are exact there.
/// Pieces are kept as distances from u, so that narrow domains lose no digits.
inline std::array<double, 2> averaged_hat(int i, double u, double l) {
  std::vector<double> ends{-l, l};
  for (int line = i - 1; line <= i + 1; ++line)
    if (line - u > -l && line - u < l) ends.push_back(line - u);
  std::sort(ends.begin(), ends.end());
  std::array<double, 2> sum{};
  for (std::size_t k = 0; k + 1 < ends.size(); ++k) {
    const double part = (ends[k + 1] - ends[k]) / (2 * l), middle = u + 0.5 * (ends[k] + ends[k + 1]);
    sum[0] += part * hat(i, middle);
    sum[1] += part * hat_slope(i, middle);
  }
  return sum;
}

/// Values and slopes of all functions along an axis of n cells of edge h, at u cells from the origin.
struct AlongAxis {
  std::vector<double> value, slope;
};

/// The parabola that a B-spline is in the cell `at`, at any u: through three of its points there.
inline std::array<double, 2> parabola_of(const std::vector<double>& t, int i, int at, double u) {
  std::array<double, 2> sum{};
  for (int a = 0; a < 3; ++a) {
    double value = cox_de_boor(t, i, 2, at + 0.25 * (a + 1)), slope = 0;
    const double x = 4 * (u - at) - 1;  // 0, 1, 2 at the three
    const double b = (a + 1) % 3, c = (a + 2) % 3, scale = 1 / ((a - b) * (a - c));
    slope = 4 * value * scale * (2 * x - b - c);
    value *= scale * (x - b) * (x - c);
    sum[0] += value;
    sum[1] += slope;
  }
  return sum;
}

/// `half` is half the edge of the point's domain [m], for GIMP. At a line between cells the cell `at` decides the
/// slope; beyond its cell a point has what the functions of the cell go on to.
inline AlongAxis functions_along_axis(GridFunctions functions, int n, double h, double u, double half, int at) {
  AlongAxis all;
  if (functions == GridFunctions::b_spline) {
    const auto t = open_knots(n);
    // A point beyond the grid's side by round-off belongs to the last cell.
    const double inside = std::clamp(u, 0.0, static_cast<double>(n));
    const bool beyond = inside < at || inside > at + 1;
    for (int i = 0; i < n + 2; ++i) {
      if (beyond) {
        const auto [value, slope] = parabola_of(t, i, at, inside);
        all.value.push_back(std::abs(i - at - 1) <= 1 ? value : 0);
        all.slope.push_back(std::abs(i - at - 1) <= 1 ? slope / h : 0);
        continue;
      }
      all.value.push_back(cox_de_boor(t, i, 2, inside));
      all.slope.push_back(cox_de_boor_slope(t, i, 2, inside) / h);
    }
    return all;
  }
  double l = 0;
  if (functions == GridFunctions::gimp) l = std::max(0.0, std::min({half / h, 0.5, u, n - u}));
  for (int i = 0; i <= n; ++i) {
    const double straight = i == at ? -1 : i == at + 1 ? 1 : 0;  // in the cell
    const double line = i == at ? 1 - (u - at) : i == at + 1 ? u - at : 0;
    const auto [value, slope] = l > 0 ? averaged_hat(i, u, l) : std::array{line, straight};
    all.value.push_back(value);
    all.slope.push_back(slope / h);
  }
  return all;
}

/// N_i and ∇N_i of all nodes of a grid's mesh at x in element e.
template <int Dim>
struct AtNodes {
  std::vector<double> N;
  std::vector<Vec<Dim>> B;
};

template <int Dim>
AtNodes<Dim> functions_of_all_nodes(const Mesh<Dim>& mesh, int e, const Vec<Dim>& x, double half) {
  const auto& grid = *mesh.grid;
  const auto at = grid.cell(e);
  std::array<AlongAxis, Dim> along;
  for (int d = 0; d < Dim; ++d) {
    const double h = grid.spacing[d];
    along[d] = functions_along_axis(grid.functions, grid.elements[d], h, (x[d] - grid.origin[d]) / h, half, at[d]);
  }
  AtNodes<Dim> all{std::vector<double>(mesh.node_count(), 0.0), std::vector<Vec<Dim>>(mesh.node_count())};
  for (int n = 0; n < mesh.node_count(); ++n) {
    std::array<int, Dim> place;
    int rest = n;
    bool nothing = false;  // as at most nodes
    for (int d = 0; d < Dim; ++d) {
      place[d] = rest % static_cast<int>(along[d].value.size());
      rest /= static_cast<int>(along[d].value.size());
      nothing = nothing || (along[d].value[place[d]] == 0 && along[d].slope[place[d]] == 0);
    }
    if (nothing) continue;
    all.N[n] = 1;
    all.B[n].fill(1);
    for (int d = 0; d < Dim; ++d) {
      all.N[n] *= along[d].value[place[d]];
      for (int k = 0; k < Dim; ++k) all.B[n][k] *= k == d ? along[d].slope[place[d]] : along[d].value[place[d]];
    }
  }
  return all;
}

}  // namespace scarp::test
