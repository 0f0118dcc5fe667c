// The step again, slow and obvious: serial, one point at a time in the order of their numbers, plain doubles, every sum
// over all points and every node of the mesh, straight from section 2 of the report and docs/theory.md. Shares with the
// fast step the shapes on double (of unstructured meshes: those of grids are taken from their definitions), the laws,
// and what conditions do to one node; none of its data flow.
#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <stdexcept>
#include <vector>

#include "../unit/mesh/grid_oracles.hpp"
#include "scarp/step/step.hpp"

namespace scarp::test {

template <class Model, int Dim>
class Twin {
  static constexpr int N = sym_size<Dim>;
  using State = typename Model::template State<double, N>;

 public:
  struct Point {
    double m, Omega, half_edge;  ///< of the domain, from the volume at the start
    Vec<Dim> x, v;
    State state;  ///< compression positive
    int element;
  };

  /// The points of the first block of a body, by their numbers.
  Twin(const Body<Dim>& body, const Model& model) : body_(body), model_(model) {
    const auto& block = body.blocks[0];
    points.resize(block.size());
    for (int i = 0; i < block.size(); ++i) {
      const auto& p = block.points;
      Point& point = points[p.id[i]];
      point.m = p.mass[i];
      point.Omega = p.volume[i];
      point.half_edge = 0.5 * std::pow(p.initial_volume[i], 1.0 / Dim);
      for (int j = 0; j < Dim; ++j) {
        point.x[j] = p.x[j][i];
        point.v[j] = p.v[j][i];
      }
      point.element = p.element[i];
      exec::with_state(block, i, [&](const auto&, const auto& s) {
        if constexpr (std::is_same_v<std::decay_t<decltype(s)>, State>) point.state = s;
      });
      least_mass_ = std::min(least_mass_, 1e-12 * point.m);
    }
  }

  std::vector<Point> points;
  double kinetic_energy = 0, work_gravity = 0;

  void advance(double dt, const StepSettings& settings) {
    find_shapes(settings.quadrature == Quadrature::corrected);
    // Steps 1 and 2 (eqs 1–4).
    const auto nodes = body_.mesh->nodes.size();
    std::vector<double> m(nodes, 0.0);
    std::vector<Vec<Dim>> p(nodes), F(nodes), a(nodes), v(nodes), v_next(nodes);
    std::vector<std::uint8_t> held(nodes, 0);
    for (std::size_t k = 0; k < points.size(); ++k) {
      const Point& point = points[k];
      for (std::size_t i = 0; i < at_[k].node.size(); ++i) {
        const int n = at_[k].node[i];
        m[n] += point.m * at_[k].N[i];
        for (int j = 0; j < Dim; ++j) {
          p[n][j] += point.m * point.v[j] * at_[k].N[i];
          for (int l = 0; l < Dim; ++l) F[n][j] += at_[k].B[i][l] * stress(point, l, j) * at_[k].w * point.Omega;
        }
        if (body_.mesh->axisymmetric) F[n][0] += at_[k].B[i][2] * stress(point, 2, 2) * at_[k].w * point.Omega;
      }
    }
    // Step 3 (eq. 5).
    for (std::size_t n = 0; n < nodes; ++n) {
      if (m[n] < least_mass_) continue;
      for (int j = 0; j < Dim; ++j) {
        const double force = m[n] * body_.gravity[j] - F[n][j];
        v[n][j] = p[n][j] / m[n];
        const double sign = v[n][j] > 0 ? 1 : v[n][j] < 0 ? -1 : 0;
        a[n][j] = (force - settings.damping * std::abs(force) * sign) / m[n];
      }
      take_back_damping(settings, n, m[n], v[n], F[n], dt, a[n]);
      held[n] =
          constrain_acceleration<Dim>(body_.conditions, settings.wall, static_cast<int>(n), m[n], v[n], dt, a[n]).held;
      for (int j = 0; j < Dim; ++j) v_next[n][j] = v[n][j] + a[n][j] * dt;
      constrain_velocity<Dim>(body_.conditions, settings.wall, static_cast<int>(n), held[n], v_next[n]);
    }
    // Steps 4 and 5 (eqs 6–8).
    std::vector<Vec<Dim>> momentum(nodes), v_end(nodes);
    kinetic_energy = work_gravity = 0;
    for (std::size_t k = 0; k < points.size(); ++k) {
      Point& point = points[k];
      for (int j = 0; j < Dim; ++j) {
        double pic = 0;
        for (std::size_t i = 0; i < at_[k].node.size(); ++i) {
          point.v[j] += a[at_[k].node[i]][j] * at_[k].N[i] * dt;
          pic += v_next[at_[k].node[i]][j] * at_[k].N[i];
        }
        point.v[j] = settings.flip * point.v[j] + (1 - settings.flip) * pic;
        kinetic_energy += 0.5 * point.m * point.v[j] * point.v[j];
        for (std::size_t i = 0; i < at_[k].node.size(); ++i) {
          momentum[at_[k].node[i]][j] += point.m * point.v[j] * at_[k].N[i];
        }
      }
    }
    for (std::size_t n = 0; n < nodes; ++n) {
      if (m[n] < least_mass_) continue;
      for (int j = 0; j < Dim; ++j) v_end[n][j] = momentum[n][j] / m[n];
      constrain_velocity<Dim>(body_.conditions, settings.wall, static_cast<int>(n), held[n], v_end[n]);
    }
    // Steps 6 to 11 (eqs 9–19).
    for (std::size_t k = 0; k < points.size(); ++k) {
      Point& point = points[k];
      double L[3][3] = {};
      for (std::size_t i = 0; i < at_[k].node.size(); ++i) {
        const auto& v_i = v_end[at_[k].node[i]];
        for (int j = 0; j < Dim; ++j) {
          for (int l = 0; l < Dim; ++l) L[j][l] += v_i[j] * at_[k].B[i][l];
          point.x[j] += v_i[j] * dt * at_[k].N[i];
          work_gravity += point.m * body_.gravity[j] * v_i[j] * dt * at_[k].N[i];
        }
        if (body_.mesh->axisymmetric) L[2][2] += v_i[0] * at_[k].B[i][2];
      }
      update_stress(point.state, L, dt, settings.integration);
      point.Omega *= stretch(L, dt);
      point.element = element_of(point);
    }
  }

 private:
  /// Local damping does not act along the normal of a wall by motion, where the node goes into it without.
  void take_back_damping(const StepSettings& settings, std::size_t n, double m, const Vec<Dim>& v,
                         const Vec<Dim>& F_int, double dt, Vec<Dim>& a) const {
    const int normal = body_.conditions.normal[n];
    if (normal < 0 || settings.wall != WallRule::by_motion) return;
    const double undamped = body_.gravity[normal] - F_int[normal] / m;
    if (body_.conditions.inward[n] * (v[normal] + undamped * dt) < 0) a[normal] = undamped;
  }

  /// A point's local nodes with N_i and B̂_i, whose third component is N_i / r in a body of revolution, and the weight w
  /// of its volume.
  struct AtPoint {
    std::vector<int> node;
    std::vector<double> N;
    std::vector<Vec<3>> B;
    double w = 1;
  };

  static double stress(const Point& point, int j, int k) {
    static constexpr int shear[3][3] = {{0, 3, 5}, {3, 0, 4}, {5, 4, 0}};
    return j == k ? -point.state.sigma[j] : -point.state.sigma[shear[j][k]] / std::sqrt(2.0);
  }

  static double stretch(const double (&L)[3][3], double dt) {
    double f[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    for (int j = 0; j < 3; ++j) {
      for (int k = 0; k < 3; ++k) f[j][k] += L[j][k] * dt;
    }
    double det = 0;
    for (int k = 0; k < 3; ++k) {
      det += f[0][k] * (f[1][(k + 1) % 3] * f[2][(k + 2) % 3] - f[1][(k + 2) % 3] * f[2][(k + 1) % 3]);
    }
    return det;
  }

  void update_stress(State& s, const double (&L)[3][3], double dt, const IntegrationSettings& settings) const {
    Sym<double, N> deps = Sym<double, N>::zero();
    Spin<double, N> spin;
    for (int j = 0; j < 3; ++j) deps[j] = -L[j][j] * dt;
    const int pairs[3][2] = {{0, 1}, {1, 2}, {2, 0}};
    for (int c = 0; c < (Dim == 2 ? 1 : 3); ++c) {
      const auto [j, k] = pairs[c];
      deps[3 + c] = -std::sqrt(2.0) * 0.5 * (L[j][k] + L[k][j]) * dt;
      spin.w[c] = 0.5 * (L[j][k] - L[k][j]) * dt;
    }
    rotate(s, Rotation<double, N>(spin));
    const Increment<double, N> increment{deps, dt};
    const auto whole = attempt<ModifiedEuler>(model_, s, increment, settings.tolerance);
    if (whole.notes.sound && whole.error <= settings.tolerance) {
      s = whole.state;
    } else {
      integrate<ModifiedEuler>(model_, s, increment, settings, 0.5);
    }
  }

  int element_of(const Point& point) const {
    const auto& mesh = *body_.mesh;
    const auto holds = [&](int e) {
      if (mesh.grid) return grid_holds(*mesh.grid, e, point.x);
      return with_shape<Dim>(mesh.types[e], [&]<class Shape>(Shape) {
        return Shape::beyond(Shape::local_coordinates(node_positions<Shape>(mesh, e), point.x)) <=
               body_.locator.tolerance();
      });
    };
    if (holds(point.element)) return point.element;
    for (int e = 0; e < mesh.element_count(); ++e) {
      if (holds(e)) return e;
    }
    throw std::runtime_error("a point of the twin has left the mesh");
  }

  bool grid_holds(const Grid<Dim>& grid, int e, const Vec<Dim>& x) const {
    const auto at = grid.cell(e);
    bool holds = true;
    for (int j = 0; j < Dim; ++j) {
      const double s = (x[j] - grid.origin[j]) / grid.spacing[j] - at[j], tolerance = body_.locator.tolerance();
      holds = holds && s >= -tolerance && s <= 1 + tolerance;
    }
    return holds;
  }

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

  void find_shapes(bool corrected) {
    const auto& mesh = *body_.mesh;
    at_.assign(points.size(), {});
    std::vector<std::vector<std::size_t>> in(mesh.types.size());
    for (std::size_t k = 0; k < points.size(); ++k) {
      const int e = points[k].element;
      in[e].push_back(k);
      if (mesh.grid) {
        at_[k] = at_nodes_of_grid(e, points[k].x, points[k].half_edge);
        continue;
      }
      with_shape<Dim>(mesh.types[e], [&]<class Shape>(Shape) {
        const auto x_i = node_positions<Shape>(mesh, e);
        std::array<double, Shape::nodes> N_i;
        std::array<Vec<Dim>, Shape::nodes> B;
        gradients<Shape>(x_i, Shape::local_coordinates(x_i, points[k].x), N_i, B);
        const auto nodes = mesh.element_nodes(e);
        at_[k] = {{nodes.begin(), nodes.end()}, {N_i.begin(), N_i.end()}, {}};
        for (int i = 0; i < Shape::nodes; ++i) at_[k].B.push_back(with_hoop(B[i], N_i[i], points[k].x));
      });
    }
    if (!corrected || (mesh.grid && mesh.grid->functions == GridFunctions::gimp)) return;
    for (int e = 0; e < mesh.element_count(); ++e) {
      bool inside = !in[e].empty();
      for (const int other : mesh.elements_around(e)) inside = inside && !in[other].empty();
      if (inside) correct(e, in[e]);
    }
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
    with_shape<Dim>(mesh.types[e], [&]<class Shape>(Shape) {
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

  /// Corrected quadrature inside the soil, as in docs/theory.md. Numbers of nodes are those of the mesh.
  void correct(int e, const std::vector<std::size_t>& in) {
    double V = 0, filled = 0;
    std::map<int, Vec<3>> shift;  // s_i
    for_quadrature_points(e, [&](const auto& B, const auto& nodes, double dV) {
      V += dV;
      for (std::size_t i = 0; i < B.size(); ++i) {
        for (int j = 0; j < 3; ++j) shift[nodes[i]][j] += B[i][j] * dV;
      }
    });
    for (const auto k : in) filled += points[k].Omega;
    if (!(filled > 0.5 * V && filled < 2 * V)) return;
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
  }

  const Body<Dim>& body_;
  const Model& model_;
  double least_mass_ = 1e300;
  std::vector<AtPoint> at_;
};

}  // namespace scarp::test
