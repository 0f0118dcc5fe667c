// A soil under six linear constraints on its strain and stress increments, as a law of its own: what the integrators
// drive is then the share of a stage, not a strain. At every state the strain rate is found that meets
// E·ε̇ + S·σ̇ = b, so that the constraints hold along the whole increment and not only at its ends.
#pragma once

#include <Eigen/Dense>
#include <array>
#include <cmath>
#include <optional>

#include "scarp/lab/test.hpp"
#include "scarp/material/increment.hpp"
#include "scarp/material/state.hpp"

namespace scarp::lab {

using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Vector6 = Eigen::Matrix<double, 6, 1>;

inline Vector6 as_vector(const Sym<double, 6>& a) {
  return Vector6(a.c.data());
}
inline Sym<double, 6> as_sym(const Vector6& v) {
  Sym<double, 6> a;
  for (int i = 0; i < 6; ++i) a[i] = v[i];
  return a;
}

/// E and S of six constraints in Mandel components (a form counts each tensor component once).
struct ConstraintMatrices {
  explicit ConstraintMatrices(const std::array<LinearForm, 6>& forms);
  Matrix6 E, S;

  /// E·ε + S·σ
  Vector6 value(const Sym<double, 6>& eps, const Sym<double, 6>& sigma) const {
    return E * as_vector(eps) + S * as_vector(sigma);
  }
};

/// Solves J x = b by rows of equal size; the shortest solution where several remain.
Vector6 solve_scaled(const Matrix6& J, const Vector6& b);

/// Is `residual` nothing but rounding beside the terms it is the sum of?
bool is_rounding(const Vector6& residual, const ConstraintMatrices& c, const Vector6& eps, double stress,
                 const Vector6& b);

/// A share of an increment of a stage.
struct Share {
  double value;
};
inline Share operator*(double share, const Share& whole) {
  return {share * whole.value};
}
inline Share as_increment(const Share& share) {
  return share;
}

template <class Model>
class Constrained {
  using Soil = typename Model::template State<double, 6>;

 public:
  template <class T, int N>
  struct State {
    Soil soil;
    Sym<double, 6> eps;

    template <class F, class... States>
    static void each(F&& f, States&... s) {
      Soil::each(f, s.soil...);
      f(s.eps...);
    }
  };

  /// `b` and `dt` are those of the whole increment; `guesses` are strains to start the search for the strain rate from,
  /// the first one that leads to an answer wins.
  Constrained(const Model& model, const ConstraintMatrices& constraints, const Vector6& b, double dt,
              std::vector<Sym<double, 6>> guesses)
      : model_(model), c_(constraints), b_(b), dt_(dt), guesses_(std::move(guesses)) {}

  /// The strain of the whole increment, as the present rate would have it; none where no strain meets the constraints.
  std::optional<Sym<double, 6>> strain(const Soil& soil) const {
    for (const auto& guess : guesses_) {
      if (const auto found = search(soil, as_vector(guess))) return as_sym(*found);
    }
    return {};
  }

  /// The soil's answer to a strain rate.
  Rate<Soil, double> soil_rate(const Soil& soil, const Sym<double, 6>& strain) const {
    return rate_of(model_, soil, Increment<double, 6>{strain, dt_});
  }

  bool admissible(const State<double, 6>& s) const { return model_.admissible(s.soil); }
  double error_norm(const State<double, 6>& s, const State<double, 6>& e) const {
    return std::hypot(model_.error_norm(s.soil, e.soil), norm(e.eps));
  }
  Notes<double> accept(State<double, 6>& s, double tolerance) const { return model_.accept(s.soil, tolerance); }
  bool idle() const { return b_.isZero(0) && (!TimeDependent<Model> || dt_ == 0); }

 private:
  /// Newton's iteration. A rate-independent law is linear in the strain rate on each of its branches (elastic,
  /// plastic), so it ends after a few: with an answer on the branch that it assumed, or going round between branches,
  /// none of which answers.
  std::optional<Vector6> search(const Soil& soil, Vector6 d) const {
    for (int i = 0; i < 30; ++i) {
      const auto at = soil_rate(soil, as_sym(d));
      const Vector6 sigma = as_vector(at.change.sigma);
      const Vector6 residual = c_.E * d + c_.S * sigma - b_;
      if (!residual.allFinite()) return {};
      if (is_rounding(residual, c_, d, stress_size(soil, d, sigma), b_)) {
        if (at.sound) return d;
        return {};
      }
      d -= solve_scaled(c_.E + c_.S * tangent(soil, d, sigma), residual);
    }
    return {};
  }

  /// What the rounding of σ̇ is measured by. Creep of a law that depends on time has σ̇ = 0 as the difference of elastic
  /// stresses that are not.
  double stress_size(const Soil& soil, const Vector6& d, const Vector6& sigma) const {
    if constexpr (TimeDependent<Model>) return std::max(sigma.norm(), model_.p_wave_modulus(soil) * d.norm());
    return sigma.norm();
  }

  /// ∂σ̇/∂ε̇ by differences, exact but for rounding on a linear branch.
  Matrix6 tangent(const Soil& soil, const Vector6& d, const Vector6& sigma) const {
    const double h = std::max(1e-7 * d.norm(), 1e-10);
    Matrix6 D;
    for (int i = 0; i < 6; ++i) {
      Vector6 moved = d;
      moved[i] += h;
      D.col(i) = (as_vector(soil_rate(soil, as_sym(moved)).change.sigma) - sigma) / h;
    }
    return D;
  }

  const Model& model_;
  const ConstraintMatrices& c_;
  Vector6 b_;
  double dt_;
  std::vector<Sym<double, 6>> guesses_;
};

template <class Model>
Rate<typename Constrained<Model>::template State<double, 6>, double> rate_of(
    const Constrained<Model>& law, const typename Constrained<Model>::template State<double, 6>& s,
    const Share& share) {
  const auto whole = law.strain(s.soil);
  const auto strain = whole.value_or(Sym<double, 6>::zero());
  auto soil = law.soil_rate(s.soil, strain);
  Rate<typename Constrained<Model>::template State<double, 6>, double> r{{soil.change, strain},
                                                                         whole.has_value() && soil.sound};
  for_each_component([&](double& x) { x *= share.value; }, r.change);
  return r;
}

template <class Model>
bool is_idle(const Constrained<Model>& law, const Share&) {
  return law.idle();
}

}  // namespace scarp::lab
