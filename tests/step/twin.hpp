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

#include "scarp/step/step.hpp"
#include "twin_shapes.hpp"
#include "twin_strain.hpp"

namespace scarp::test {

/// A point of the twin.
template <class Model, int Dim>
struct TwinPoint {
  double m, Omega, half_edge;  ///< of the domain, from the volume at the start
  Vec<Dim> x, v;
  std::array<Vec<Dim>, Dim> C{};                                ///< of an affine scheme
  typename Model::template State<double, sym_size<Dim>> state;  ///< compression positive
  Sym<double, sym_size<Dim>> ahead;                             ///< σ*, likewise
  int element;
};

template <class Model, int Dim>
class Twin : public TwinShapes<TwinPoint<Model, Dim>, Dim> {
  using Point = TwinPoint<Model, Dim>;
  using Shapes = TwinShapes<Point, Dim>;
  using Shapes::at_;
  using Shapes::body_;
  using Shapes::least_mass_;
  using Shapes::least_per_mass_;
  static constexpr int N = sym_size<Dim>;
  using State = typename Model::template State<double, N>;

 public:
  /// The points of the first block of a body, by their numbers.
  Twin(const Body<Dim>& body, const Model& model) : Shapes(body), model_(model) {
    const auto& block = body.blocks()[0];
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
        point.ahead = point.state.sigma;
      });
      least_mass_ = std::min(least_mass_, 1e-12 * point.m);
    }
  }

  using Shapes::points;
  double kinetic_energy = 0, work_gravity = 0;
  double shared = 0;  ///< Σ |δ| of volume strains that points took from others of their element

  void advance(double dt, const StepSettings& settings) {
    const Scheme& scheme = settings.scheme;
    const double phi = scheme.flip * std::exp(-dt / scheme.pic_time);
    this->find_shapes(settings);
    // Steps 1 and 2 (eqs 1–4).
    const auto nodes = static_cast<std::size_t>(body_.mesh->node_count());
    m_.assign(nodes, 0.0);
    std::vector<Vec<Dim>> p(nodes), F(nodes), a(nodes), v(nodes), v_next(nodes);
    held_.assign(nodes, 0);
    for (std::size_t k = 0; k < points.size(); ++k) {
      const Point& point = points[k];
      const double s = at_[k].mean.empty() ? 0 : at_[k].share * mean_stress(point);
      for (std::size_t i = 0; i < at_[k].node.size(); ++i) {
        const int n = at_[k].node[i];
        const double Omega = at_[k].w * point.Omega;
        m_[n] += point.m * at_[k].N[i];
        for (int j = 0; j < Dim; ++j) {
          double v_at = point.v[j];
          for (int l = 0; l < Dim; ++l) v_at += point.C[j][l] * (body_.mesh->node(n)[l] - point.x[l]);
          p[n][j] += point.m * v_at * at_[k].N[i];
          for (int l = 0; l < Dim; ++l) F[n][j] += at_[k].B[i][l] * (stress(point, l, j) - s * (l == j)) * Omega;
        }
        if (body_.mesh->axisymmetric) F[n][0] += at_[k].B[i][2] * (stress(point, 2, 2) - s) * Omega;
      }
      for (const auto& [n, B] : at_[k].mean) {
        for (int j = 0; j < Dim; ++j) F[n][j] += B[j] * s * at_[k].w * point.Omega;
        if (body_.mesh->axisymmetric) F[n][0] += B[2] * s * at_[k].w * point.Omega;
      }
    }
    if (scheme.bounds_by_nodes && !body_.mesh->grid) this->bound_by_nodes(m_);
    // Step 3 (eq. 5).
    for (std::size_t n = 0; n < nodes; ++n) {
      if (m_[n] < least_mass_) continue;
      for (int j = 0; j < Dim; ++j) {
        const double force = m_[n] * body_.gravity[j] - F[n][j];
        v[n][j] = p[n][j] / m_[n];
        const double soft = scheme.smooth ? 0.1 * force / m_[n] * dt : 0, size = std::hypot(v[n][j], soft);
        const double sign = size > 0 ? v[n][j] / size : 0;
        a[n][j] = (force - settings.damping * std::abs(force) * sign) / m_[n];
      }
      take_back_damping(settings, n, m_[n], v[n], F[n], dt, a[n]);
      held_[n] =
          constrain_acceleration<Dim>(body_.conditions, scheme.wall, static_cast<int>(n), m_[n], v[n], dt, a[n]).held;
      for (int j = 0; j < Dim; ++j) v_next[n][j] = v[n][j] + a[n][j] * dt;
      constrain_velocity<Dim>(body_.conditions, scheme.wall, static_cast<int>(n), held_[n], v_next[n]);
    }
    // Steps 4 and 5 (eqs 6–8). What holds a node is no part of P.
    if (scheme.two_terms) {
      a = filtered(a);
      v_next = filtered(v_next);
    }
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
        point.v[j] = phi * point.v[j] + (1 - phi) * pic;
        kinetic_energy += 0.5 * point.m * point.v[j] * point.v[j];
        for (std::size_t i = 0; i < at_[k].node.size(); ++i) {
          momentum[at_[k].node[i]][j] += point.m * point.v[j] * at_[k].N[i];
        }
      }
    }
    for (std::size_t n = 0; n < nodes; ++n) {
      if (m_[n] < least_mass_) continue;
      for (int j = 0; j < Dim; ++j) v_end[n][j] = momentum[n][j] / m_[n];
      constrain_velocity<Dim>(body_.conditions, scheme.wall, static_cast<int>(n), held_[n], v_end[n]);
    }
    if (scheme.two_terms || scheme.affine) {
      v_end = filtered(v_end);
      for (std::size_t n = 0; n < nodes; ++n)
        constrain_velocity<Dim>(body_.conditions, scheme.wall, static_cast<int>(n), held_[n], v_end[n]);
    }
    // Steps 6 to 11 (eqs 9–19).
    std::vector<Kinematics> strains;
    for (std::size_t k = 0; k < points.size(); ++k) strains.push_back(strain_and_move(k, v_end, dt, settings));
    if (settings.scheme.shares_gaps) share_gaps(strains, dt);
    for (std::size_t k = 0; k < points.size(); ++k) {
      stress(k, strains[k], dt, settings);
      points[k].element = element_of(points[k], settings.scheme.lateness);
    }
  }

 private:
  /// Local damping does not act along the normal of a wall by motion, where the node goes into it without.
  void take_back_damping(const StepSettings& settings, std::size_t n, double m, const Vec<Dim>& v,
                         const Vec<Dim>& F_int, double dt, Vec<Dim>& a) const {
    const int normal = body_.conditions.normal[n];
    if (normal < 0 || settings.scheme.wall != WallRule::by_motion) return;
    const double undamped = body_.gravity[normal] - F_int[normal] / m;
    if (body_.conditions.inward[n] * (v[normal] + undamped * dt) < 0) a[normal] = undamped;
  }

  int mean_directions() const { return body_.mesh->axisymmetric ? 3 : Dim; }

  /// Of σ*, tension positive.
  static double stress(const Point& point, int j, int k) {
    static constexpr int shear[3][3] = {{0, 3, 5}, {3, 0, 4}, {5, 4, 0}};
    return j == k ? -point.ahead[j] : -point.ahead[shear[j][k]] / std::sqrt(2.0);
  }
  double mean_stress(const Point& point) const {
    double sum = 0;
    for (int j = 0; j < mean_directions(); ++j) sum += stress(point, j, j);
    return sum / mean_directions();
  }

  /// P w = 2 w − m⁻¹ M w in the components that nothing holds, of what is there.
  std::vector<Vec<Dim>> filtered(const std::vector<Vec<Dim>>& w) const {
    std::vector<Vec<Dim>> M_w(w.size()), result = w;
    const auto free = [&](int n, int j) { return (held_[n] >> j & 1u) == 0; };
    for (std::size_t k = 0; k < points.size(); ++k) {
      const auto& at = at_[k];
      for (int j = 0; j < Dim; ++j) {
        double here = 0;
        for (std::size_t i = 0; i < at.node.size(); ++i) here += free(at.node[i], j) ? at.N[i] * w[at.node[i]][j] : 0;
        for (std::size_t i = 0; i < at.node.size(); ++i) M_w[at.node[i]][j] += points[k].m * at.N[i] * here;
      }
    }
    for (std::size_t n = 0; n < w.size(); ++n) {
      for (int j = 0; j < Dim; ++j) {
        if (m_[n] >= least_mass_ && free(static_cast<int>(n), j)) result[n][j] = 2 * w[n][j] - M_w[n][j] / m_[n];
      }
    }
    return result;
  }

  /// Of a node for the points of element e: one without mass has the mean of the element's others.
  Vec<Dim> velocity_of(int n, int e, const std::vector<Vec<Dim>>& v, const Scheme& scheme) const {
    if (m_[n] >= least_mass_ || !scheme.mends_massless) return v[n];
    Vec<Dim> mean{};
    int count = 0;
    for (const int other : body_.mesh->element_nodes(e)) {
      if (m_[other] < least_mass_) continue;
      ++count;
      for (int j = 0; j < Dim; ++j) mean[j] += v[other][j];
    }
    for (double& x : mean) x /= std::max(count, 1);
    return mean;
  }

  Kinematics strain_and_move(std::size_t k, const std::vector<Vec<Dim>>& v, double dt, const StepSettings& settings) {
    Point& point = points[k];
    Matrix L{};  // L dt
    double mean = 0;
    for (std::size_t i = 0; i < at_[k].node.size(); ++i) {
      const Vec<Dim> v_i = velocity_of(at_[k].node[i], point.element, v, settings.scheme);
      for (int j = 0; j < Dim; ++j) {
        for (int l = 0; l < Dim; ++l) L[j][l] += v_i[j] * at_[k].B[i][l] * dt;
        point.x[j] += v_i[j] * dt * at_[k].N[i];
        work_gravity += point.m * body_.gravity[j] * v_i[j] * dt * at_[k].N[i];
      }
      if (body_.mesh->axisymmetric) L[2][2] += v_i[0] * at_[k].B[i][2] * dt;
    }
    if (settings.scheme.affine) {
      for (auto& row : point.C) row.fill(0);
      for (std::size_t i = 0; i < at_[k].node.size(); ++i) {
        for (int j = 0; j < Dim; ++j) {
          for (int l = 0; l < Dim; ++l)
            point.C[j][l] += velocity_of(at_[k].node[i], point.element, v, settings.scheme)[j] * at_[k].B_own[i][l];
        }
      }
    }
    for (const auto& [n, B] : at_[k].mean) {
      for (int j = 0; j < Dim; ++j) mean += v[n][j] * B[j] * dt;
      if (body_.mesh->axisymmetric) mean += v[n][0] * B[2] * dt;
    }
    if (!at_[k].mean.empty()) {
      const double more = at_[k].share * (mean - L[0][0] - L[1][1] - L[2][2]) / mean_directions();
      for (int j = 0; j < mean_directions(); ++j) L[j][j] += more;
    }
    point.Omega *= determinant(one_and(1, L));
    return {L, settings.scheme.middle};
  }

  /// Of the rate at which a wave crosses the point's element: c²/h² over the modulus.
  double per_mass(std::size_t k) const {
    const Point& point = points[k];
    const double h = body_.mesh->size_of(point.element), before = point.Omega / at_[k].taken;
    const double own = std::max(1.0, at_[k].w) * before / (point.m * h * h);
    return at_[k].taken * (least_per_mass_.empty() ? own : std::max(own, least_per_mass_[point.element]));
  }

  /// Pressures even out among the points of an element of which some are open.
  void share_gaps(std::vector<Kinematics>& strains, double dt) {
    if constexpr (HasGap<decltype(points[0].state)>) {
      const int directions = mean_directions();
      std::map<int, std::vector<std::size_t>> of_element;
      for (std::size_t k = 0; k < points.size(); ++k) of_element[points[k].element].push_back(k);
      for (const auto& [e, members] : of_element) {
        const double h = body_.mesh->size_of(e);
        double volume = 0, carrying = 0, s = 0, M = 0, rate2 = 0;
        bool open = false;
        for (const auto k : members) {
          const Point& point = points[k];
          volume += point.Omega;
          s += point.Omega * own_mean_stress(point);
          rate2 += point.Omega * per_mass(k);
          if (point.state.gap > 0) {
            open = true;
          } else {
            carrying += point.Omega;
            M += point.Omega * model_.p_wave_modulus(point.state);
          }
        }
        const double mean = s / volume;
        for (const auto k : members) {  // none opens by more than the element
          Point& point = points[k];
          const double most = std::pow(h, Dim) * (directions > Dim ? point.x[0] : 1);
          double dilation = 0;
          for (int j = 0; j < directions; ++j) dilation += strains[k].strain[j][j];
          if (point.Omega - point.Omega * std::exp(-point.state.gap) > most && dilation > 0)
            take(k, strains[k], -dilation);
        }
        if (!open || carrying == 0) continue;
        const double theta = 0.5 * std::min(1.0, dt * std::sqrt(M / carrying * rate2 / volume));
        for (const auto k : members) {
          const double delta = theta * (mean - own_mean_stress(points[k])) / (M / carrying);
          take(k, strains[k], delta);
          shared += std::abs(delta);
        }
      }
    }
  }
  void take(std::size_t k, Kinematics& strain, double delta) {
    points[k].Omega *= std::exp(delta);
    at_[k].taken *= std::exp(delta);
    for (int j = 0; j < mean_directions(); ++j) strain.strain[j][j] += delta / mean_directions();
  }
  /// Of σ, tension positive.
  double own_mean_stress(const Point& point) const {
    double sum = 0;
    for (int j = 0; j < mean_directions(); ++j) sum -= point.state.sigma[j];
    return sum / mean_directions();
  }

  void stress(std::size_t k, const Kinematics& strain, double dt, const StepSettings& settings) {
    Point& point = points[k];
    const auto [turned, separated] = update_stress<N>(model_, point.state, strain, dt, settings.integration);
    const auto waves = scheme::waves(settings.scheme, is_elastic(body_.blocks()[0].model));
    const double modulus = model_.p_wave_modulus(point.state);
    const double beta = waves.time > 0 ? waves.time : waves.share / std::sqrt(modulus * per_mass(k));
    point.ahead = point.state.sigma;
    for (int c = 0; c < N && beta > 0 && !separated; ++c)
      point.ahead[c] += beta / dt * (point.state.sigma[c] - turned[c]);
  }

  /// Does a point linger in its element, late?
  bool lingers(const Point& point, double lateness) const {
    const auto& mesh = *body_.mesh;
    if (lateness == 0 || (mesh.grid && mesh.grid->functions == GridFunctions::gimp)) return false;
    double least = 1e300, most = 0;
    for (const int n : mesh.element_nodes(point.element)) {
      const double m = this->is_simplex(point.element) ? m_[n] / this->full_volume_[n] : m_[n];
      least = std::min(least, m);
      most = std::max(most, m);
    }
    if (least < 0.2 * most) return false;
    // From the point straight into the element a way of the lateness leads to where it is inside, and the other way
    // outside the mesh nothing is held: these tests keep their soil off the sides of the mesh.
    if (mesh.grid) {
      const auto at = mesh.grid->cell(point.element);
      for (int j = 0; j < Dim; ++j) {
        const double s = (point.x[j] - mesh.grid->origin[j]) / mesh.grid->spacing[j] - at[j];
        if (s < -lateness || s > 1 + lateness) return false;
      }
      return true;
    }
    return with_shape<Dim>(mesh.type_of(point.element), [&]<class Shape>(Shape) {
      const auto xi = Shape::local_coordinates(node_positions<Shape>(mesh, point.element), point.x);
      return Shape::beyond(xi) <= lateness;
    });
  }

  int element_of(const Point& point, double lateness) const {
    const auto& mesh = *body_.mesh;
    const auto holds = [&](int e) {
      if (mesh.grid) return grid_holds(*mesh.grid, e, point.x);
      return with_shape<Dim>(mesh.type_of(e), [&]<class Shape>(Shape) {
        return Shape::beyond(Shape::local_coordinates(node_positions<Shape>(mesh, e), point.x)) <=
               body_.locator.tolerance();
      });
    };
    if (holds(point.element) || lingers(point, lateness)) return point.element;
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

  const Model& model_;
  std::vector<double> m_;           ///< of the nodes, in this step
  std::vector<std::uint8_t> held_;  ///< of the nodes, in this step
};

}  // namespace scarp::test
