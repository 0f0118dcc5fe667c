// Where the twin's points are in their elements: N_i and ∇N_i by the definitions, the corrected quadrature, mean
// gradients.
#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

#include "../unit/mesh/grid_oracles.hpp"
#include "scarp/step/step.hpp"

namespace scarp::test {

/// A Point has Omega, half_edge, x and element.
template <class Point, int Dim>
class TwinShapes {
 public:
  std::vector<Point> points;

 protected:
  explicit TwinShapes(const Body<Dim>& body) : body_(body), full_volume_(body.mesh->node_count()) {
    for (int e = 0; e < body_.mesh->element_count() && !body_.mesh->grid; ++e) {
      for_quadrature_points(e, [&](const auto&, const auto& nodes, double dV) {
        for (const int n : nodes) full_volume_[n] += dV / static_cast<double>(nodes.size());
      });
    }
  }

  /// A point's local nodes with N_i and B̂_i, whose third component is N_i / r in a body of revolution, and the weight w
  /// of its volume; and the mean gradients of its element where the volume strain is their mean.
  struct AtPoint {
    std::vector<int> node;
    std::vector<double> N;
    std::vector<Vec<3>> B, B_own;  ///< corrected, and as the functions have it
    double w = 1;
    std::map<int, Vec<3>> mean;
    double share = 1;  ///< of the point in the mean
    double taken = 1;  ///< factor on its volume that it took from others of its element
  };

  void find_shapes(const StepSettings& settings) {
    const auto& mesh = *body_.mesh;
    at_.assign(points.size(), {});
    std::vector<std::vector<std::size_t>> in(mesh.element_count());
    for (std::size_t k = 0; k < points.size(); ++k) {
      const int e = points[k].element;
      in[e].push_back(k);
      if (mesh.grid) {
        at_[k] = at_nodes_of_grid(e, points[k].x, points[k].half_edge);
        continue;
      }
      with_shape<Dim>(mesh.type_of(e), [&]<class Shape>(Shape) {
        const auto x_i = node_positions<Shape>(mesh, e);
        std::array<double, Shape::nodes> N_i;
        std::array<Vec<Dim>, Shape::nodes> B;
        gradients<Shape>(x_i, Shape::local_coordinates(x_i, points[k].x), N_i, B);
        const auto nodes = mesh.element_nodes(e);
        at_[k].node.assign(nodes.begin(), nodes.end());
        at_[k].N.assign(N_i.begin(), N_i.end());
        for (int i = 0; i < Shape::nodes; ++i) at_[k].B.push_back(with_hoop(B[i], N_i[i], points[k].x));
      });
    }
    for (auto& at : at_) at.B_own = at.B;
    if (settings.quadrature != QuadratureRule::corrected) return;
    const bool gimp = mesh.grid && mesh.grid->functions == GridFunctions::gimp;
    std::vector<int> simplices;
    for (int e = 0; e < mesh.element_count(); ++e) {
      bool inside = !in[e].empty();
      for (const int other : mesh.elements_around(e)) inside = inside && !in[other].empty();
      if (!inside || !(gimp ? is_filled(in[e]) : correct(e, in[e])) || !settings.scheme.mean_dilatation) continue;
      if (gimp) find_shares(e, in[e]);
      find_means(in[e]);
      if (is_simplex(e)) simplices.push_back(e);
    }
    average_over_patches(simplices, in);
  }

  /// The largest ½ Σ_n N_n(x_p) G_n / m_n over the points of each simplex, with G_n = Σ_e |B̄_n|² Σ_p w Ω_p of each
  /// element's mean gradient (step/node_rates.hpp).
  void bound_by_nodes(const std::vector<double>& m) {
    const auto& mesh = *body_.mesh;
    std::vector<double> filled(mesh.element_count()), G(m.size());
    for (std::size_t k = 0; k < points.size(); ++k) filled[points[k].element] += at_[k].w * points[k].Omega;
    for (int e = 0; e < mesh.element_count(); ++e) {
      double V = 0;
      std::map<int, Vec<Dim>> mean;
      for_quadrature_points(e, [&](const auto& B, const auto& nodes, double dV) {
        V += dV;
        for (std::size_t i = 0; i < nodes.size(); ++i) {
          for (int j = 0; j < Dim; ++j) mean[nodes[i]][j] += B[i][j] * dV;
        }
      });
      for (const auto& [n, B] : mean) {
        for (int j = 0; j < Dim; ++j) G[n] += filled[e] * B[j] / V * B[j] / V;
      }
    }
    least_per_mass_.assign(mesh.element_count(), 0);
    for (std::size_t k = 0; k < points.size(); ++k) {
      if (!is_simplex(points[k].element)) continue;
      double here = 0;
      for (std::size_t i = 0; i < at_[k].node.size(); ++i) {
        const int n = at_[k].node[i];
        if (m[n] >= least_mass_) here += 0.5 * at_[k].N[i] * G[n] / m[n];
      }
      double& least = least_per_mass_[points[k].element];
      least = std::max(least, here);
    }
  }

  bool is_simplex(int e) const {
    return !body_.mesh->grid && body_.mesh->element_nodes(e).size() == static_cast<std::size_t>(Dim + 1);
  }

  const Body<Dim>& body_;
  std::vector<AtPoint> at_;             ///< of each point
  std::vector<double> least_per_mass_;  ///< of each element, of schemes that ask for it
  std::vector<double> full_volume_;     ///< of each node, Σ V_e / K_e over the elements around it, of K_e nodes
  double least_mass_ = 1e300;

 private:
  /// Nodes of a grid that are not nothing at x, by the definitions of its functions.
  AtPoint at_nodes_of_grid(int e, const Vec<Dim>& x, double half_edge) const {
    const auto all = functions_of_all_nodes<Dim>(*body_.mesh, e, x, half_edge);
    AtPoint at;
    for (int n = 0; n < body_.mesh->node_count(); ++n) {
      bool nothing = all.N[n] == 0;
      for (const double slope : all.B[n]) nothing = nothing && slope == 0;
      if (nothing) continue;
      at.node.push_back(n);
      at.N.push_back(all.N[n]);
      at.B.push_back(with_hoop(all.B[n], all.N[n], x));
    }
    return at;
  }

  /// ∇N_i at x, and N_i / r after it in a body of revolution.
  Vec<3> with_hoop(const Vec<Dim>& slope, double N_i, const Vec<Dim>& x) const {
    Vec<3> B{};
    for (int j = 0; j < Dim; ++j) B[j] = slope[j];
    if (body_.mesh->axisymmetric) B[2] = N_i / x[0];
    return B;
  }

  /// f(B_i, nodes i, dV) at quadrature points of element e that integrate gradients exactly.
  template <class F>
  void for_quadrature_points(int e, F&& f) const {
    const auto& mesh = *body_.mesh;
    if (mesh.grid) {
      for_gauss_points([&](const Vec<Dim>& xi, double weight) {
        const auto& grid = *mesh.grid;
        const auto place = grid.cell(e);
        Vec<Dim> x;
        for (int j = 0; j < Dim; ++j) {
          x[j] = grid.origin[j] + (place[j] + 0.5 * (1 + xi[j])) * grid.spacing[j];
          weight *= 0.5 * grid.spacing[j];
        }
        const auto at = at_nodes_of_grid(e, x, 0);
        f(at.B, at.node, mesh.axisymmetric ? weight * x[0] : weight);
      });
      return;
    }
    with_shape<Dim>(mesh.type_of(e), [&]<class Shape>(Shape) {
      const auto add = [&](const Vec<Dim>& xi, double weight) {
        const auto x_i = node_positions<Shape>(mesh, e);
        std::array<double, Shape::nodes> N_i;
        std::array<Vec<Dim>, Shape::nodes> slopes;
        std::array<Vec<3>, Shape::nodes> B;
        const double dV = weight * gradients<Shape>(x_i, xi, N_i, slopes);
        Vec<Dim> x{};
        for (int i = 0; i < Shape::nodes; ++i) {
          for (int j = 0; j < Dim; ++j) x[j] += N_i[i] * x_i[i][j];
        }
        for (int i = 0; i < Shape::nodes; ++i) B[i] = with_hoop(slopes[i], N_i[i], x);
        f(B, mesh.element_nodes(e), mesh.axisymmetric ? dV * x[0] : dV);
      };
      if constexpr (Shape::nodes == Dim + 1) {
        Vec<Dim> centre;
        centre.fill(1.0 / (Dim + 1));
        add(centre, Dim == 2 ? 0.5 : 1.0 / 6);
      } else {
        for_gauss_points(add);
      }
    });
  }

  /// f(ξ, weight) for three Gauss points along each axis from −1 to 1: one more than it takes.
  template <class F>
  static void for_gauss_points(F&& f) {
    const double place[3] = {-std::sqrt(0.6), 0, std::sqrt(0.6)}, weight[3] = {5.0 / 9, 8.0 / 9, 5.0 / 9};
    for (int q = 0; q < (Dim == 2 ? 9 : 27); ++q) {
      const int k[3] = {q % 3, q / 3 % 3, q / 9};
      Vec<Dim> xi;
      double w = 1;
      for (int j = 0; j < Dim; ++j) {
        xi[j] = place[k[j]];
        w *= weight[k[j]];
      }
      f(xi, w);
    }
  }

  /// γ_p: how far the middle of a point is from the nearest line to another cell, over how far its domain reaches,
  /// along each axis; at most 1. Domains end at the sides of the grid, and beyond these is no other cell.
  void find_shares(int e, const std::vector<std::size_t>& in) {
    const auto& grid = *body_.mesh->grid;
    const auto cell = grid.cell(e);
    for (const auto k : in) {
      for (int j = 0; j < Dim; ++j) {
        const double h = grid.spacing[j], low = grid.origin[j] + cell[j] * h, x = points[k].x[j];
        const double reach =
            std::min({points[k].half_edge, h / 2, x - grid.origin[j], grid.origin[j] + grid.elements[j] * h - x});
        at_[k].share *= std::clamp(std::min(x - low, low + h - x) / reach, 0.0, 1.0);
      }
    }
  }

  /// B̄_i = Σ γ_p Ω_p B̂_i(x_p) / Σ γ_p Ω_p over the points of an element.
  void find_means(const std::vector<std::size_t>& in) {
    std::map<int, Vec<3>> mean;
    double filled = 0;
    for (const auto k : in) filled += at_[k].share * points[k].Omega;
    for (const auto k : in) {
      const double part = at_[k].share * points[k].Omega / filled;
      for (std::size_t i = 0; i < at_[k].node.size(); ++i) {
        for (int j = 0; j < 3; ++j) mean[at_[k].node[i]][j] += part * at_[k].B[i][j];
      }
    }
    for (const auto k : in) at_[k].mean = mean;
  }

  /// In place of the mean gradients B̄_e of some simplices those of all of them that are in one patch, weighted with
  /// their volumes w Σ Ω_p.
  void average_over_patches(const std::vector<int>& simplices, const std::vector<std::vector<std::size_t>>& in) {
    for (int k = 0; k < body_.patches.size(); ++k) {
      double volume = 0;
      std::map<int, Vec<3>> sum, mean;
      std::vector<std::size_t> of_patch;  // points
      for (const int e : body_.patches.elements(k)) {
        if (std::find(simplices.begin(), simplices.end(), e) == simplices.end()) continue;
        double V = 0;
        for (const auto p : in[e]) V += at_[p].w * points[p].Omega;
        volume += V;
        add(sum, at_[in[e][0]].mean, V);
        of_patch.insert(of_patch.end(), in[e].begin(), in[e].end());
      }
      if (of_patch.empty()) continue;
      add(mean, sum, 1 / volume);
      for (const auto p : of_patch) at_[p].mean = mean;
    }
  }
  static void add(std::map<int, Vec<3>>& sum, const std::map<int, Vec<3>>& B, double factor) {
    for (const auto& [n, B_n] : B) {
      for (int j = 0; j < 3; ++j) sum[n][j] += factor * B_n[j];
    }
  }

  /// Do the points of a cell of a grid fill it?
  bool is_filled(const std::vector<std::size_t>& in) const {
    double V = 1, filled = 0;
    for (const double h : body_.mesh->grid->spacing) V *= h;
    for (const auto k : in) filled += points[k].Omega;
    return filled > 0.5 * V && filled < 2 * V;
  }

  /// Corrected quadrature inside the soil, as in docs/theory.md. Numbers of nodes are those of the mesh.
  bool correct(int e, const std::vector<std::size_t>& in) {
    double V = 0, filled = 0;
    std::map<int, Vec<3>> shift;  // s_i
    for_quadrature_points(e, [&](const auto& B, const auto& nodes, double dV) {
      V += dV;
      for (std::size_t i = 0; i < B.size(); ++i) {
        for (int j = 0; j < 3; ++j) shift[nodes[i]][j] += B[i][j] * dV;
      }
    });
    for (const auto k : in) filled += points[k].Omega;
    if (!(filled > 0.5 * V && filled < 2 * V)) return false;
    for (auto& [n, s] : shift) {
      for (double& component : s) component /= V;
    }
    for (const auto k : in) {
      for (std::size_t i = 0; i < at_[k].node.size(); ++i) {
        for (int j = 0; j < 3; ++j) shift[at_[k].node[i]][j] -= points[k].Omega * at_[k].B[i][j] / filled;
      }
    }
    for (const auto k : in) {
      at_[k].w = V / filled;
      for (const auto& [n, s] : shift) {
        const auto known = std::find(at_[k].node.begin(), at_[k].node.end(), n) - at_[k].node.begin();
        if (known == static_cast<std::ptrdiff_t>(at_[k].node.size())) {
          at_[k].node.push_back(n);
          at_[k].N.push_back(0);
          at_[k].B.push_back({});
        }
        for (int j = 0; j < 3; ++j) at_[k].B[known][j] += s[j];
      }
    }
    return true;
  }
};

}  // namespace scarp::test
