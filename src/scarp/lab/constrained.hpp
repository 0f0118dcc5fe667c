// A soil under six linear constraints on its strain and stress increments, as a law of its own: what the integrators
// drive is then the share of a stage, not a strain. For a law of rates the strain rate is found at every state that
// meets E·ε̇ + S·σ̇ = b, so that the constraints hold along the whole increment and not only at its ends; for a law with
// an update of its own the strain of every substep, E·Δε + S·Δσ = b, so that they hold at the end of each.
#pragma once

#include <Eigen/Dense>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "scarp/lab/test.hpp"
#include "scarp/material/increment.hpp"
#include "scarp/material/integrate/embedded.hpp"
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

/// What a strain does to the soil: the change of stress (NaN where it cannot be told), and whether the law answers.
struct Answer {
  Vector6 stress;
  bool sound;
};

/// Newton's method for the strain d that meets E·d + S·Δσ(d) = b, where Δσ(d) is the soil's answer. Residuals of stress
/// are measured by what the strain makes of elastic soil, never by Δσ: that is the difference of an elastic and a
/// plastic part, and vanishes at critical state and in perfect plasticity while its rounding does not.
class Search {
 public:
  struct Scales {
    double stiffness;   ///< of elastic soil [stress]
    double rounding;    ///< of the stress that Δσ is a change of [stress]
    double coarse;      ///< a relative residual that will do where it falls no further
    double difference;  ///< of strains for the derivatives, relative
    double smallest;    ///< and absolute
  };

  Search(const ConstraintMatrices& constraints, const Vector6& b, std::function<Answer(const Vector6&)> response,
         const Scales& scales);

  /// The answer that the search from d leads to; none where it leads to none.
  std::optional<Vector6> from(const Vector6& d) const;
  /// Size of the strain that elastic soil would meet b with.
  double elastic_strain() const { return weight_.cwiseProduct(b_).norm(); }
  /// Of elastic soil, for the rounding of the stress: a b that asks for less is met by doing nothing.
  double rounding_strain() const { return scales_.rounding / scales_.stiffness; }

 private:
  struct Point {
    Vector6 d, stress, residual;
    double merit;  ///< ‖residual‖ as a strain
    bool sound;
  };
  Point at(const Vector6& d) const;
  /// Is the residual no more than `share` of the terms that it is the sum of, or rounding?
  bool met(const Point& point, double share) const;
  std::optional<Point> next(const Point& point, bool downhill) const;
  Matrix6 tangent(const Point& point) const;

  const ConstraintMatrices& c_;
  Vector6 b_;
  std::function<Answer(const Vector6&)> response_;
  Scales scales_;
  Vector6 weight_;  ///< of the residuals in the merit
};

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

  /// How the increment starts.
  struct Start {
    Sym<double, 6> strain;  ///< of the whole increment, as the present rate would have it
    double work;            ///< second-order, dσ:dε/‖dε‖² [stress]
    double softness;        ///< strain over that of elastic soil
  };
  /// None where no strain meets the constraints.
  std::optional<Start> start(const Soil& soil) const {
    constexpr double little = HasUpdate<Model> ? 1e-4 : 1.0;
    const Share share{little};
    const auto strain = strain_of<ModifiedEuler>(soil, share, 1e-4);
    if (!strain) return {};
    const auto stress = as_sym(answer<ModifiedEuler>(soil, as_vector(*strain), share, 1e-4).stress);
    const double elastic = Search(c_, little * b_, {}, scales(soil, 1e-4)).elastic_strain();
    return Start{(1 / little) * *strain, dot(stress, *strain) / std::max(dot(*strain, *strain), 1e-300),
                 norm(*strain) / elastic};
  }

  /// The strain of a share of the increment: at the present rate, or of a law's own update over that share. None where
  /// no strain meets the constraints.
  template <class Pair>
  std::optional<Sym<double, 6>> strain_of(const Soil& soil, const Share& share, double tolerance) const {
    const Search search(
        c_, share.value * b_, [&](const Vector6& d) { return answer<Pair>(soil, d, share, tolerance); },
        scales(soil, tolerance));
    if (share.value < 1 && search.elastic_strain() < 100 * search.rounding_strain()) return {};
    for (const auto& guess : guesses_) {
      const auto found = search.from(share.value * as_vector(guess));
      if (found && (TimeDependent<Model> || found->norm() <= softest * search.elastic_strain())) return as_sym(*found);
    }
    return {};
  }

  /// The soil's answer to a strain rate.
  Rate<Soil, double> soil_rate(const Soil& soil, const Sym<double, 6>& strain) const {
    return rate_of(model_, soil, Increment<double, 6>{strain, dt_});
  }

  /// One substep of a law with an update of its own, along a straight strain.
  template <class Pair>
  Trial<State<double, 6>, double> step(const State<double, 6>& s, const Share& share, double tolerance) const {
    const auto found = strain_of<Pair>(s.soil, share, tolerance);
    const auto strain = found.value_or(Sym<double, 6>::zero());
    const auto soil = attempt<Pair>(model_, s.soil, Increment<double, 6>{strain, share.value * dt_}, tolerance);
    Trial<State<double, 6>, double> trial{{soil.state, s.eps + strain}, soil.error, soil.flags};
    trial.flags.sound = soil.flags.sound && found.has_value();
    return trial;
  }

  /// The same for a law that advances by the pair that the integration chose. (One that has rates, too, goes by these.)
  template <class Pair>
  Trial<State<double, 6>, double> update(const State<double, 6>& s, const Share& share, double tolerance)
      const requires HasUpdate<Model> && UpdatesByPair<Model, Pair, Soil, Increment<double, 6>> {
    return step<Pair>(s, share, tolerance);
  }

  bool admissible(const State<double, 6>& s) const { return model_.admissible(s.soil); }
  double error_norm(const State<double, 6>& s, const State<double, 6>& e) const {
    return std::hypot(model_.error_norm(s.soil, e.soil), norm(e.eps));
  }
  UpdateFlags<double> accept(State<double, 6>& s, double tolerance) const { return model_.accept(s.soil, tolerance); }
  bool idle() const { return b_.isZero(0) && (!TimeDependent<Model> || dt_ == 0); }

 private:
  /// More strain than this many times that of elastic soil is none: what meets a stress beyond the strength by it does
  /// so by rounding.
  static constexpr double softest = 1e5;

  template <class Pair>
  Answer answer(const Soil& soil, const Vector6& strain, const Share& share, double tolerance) const {
    const Increment<double, 6> increment{as_sym(strain), share.value * dt_};
    if constexpr (HasUpdate<Model>) {
      const auto trial = attempt<Pair>(model_, soil, increment, tolerance);
      if (!trial.flags.sound) return {Vector6::Constant(std::numeric_limits<double>::quiet_NaN()), false};
      return {as_vector(trial.state.sigma - soil.sigma), true};
    } else {
      const auto rate = rate_of(model_, soil, increment);
      return {as_vector(rate.change.sigma), static_cast<bool>(rate.sound)};
    }
  }

  Search::Scales scales(const Soil& soil, double tolerance) const {
    const double stiffness = model_.p_wave_modulus(soil);
    if constexpr (HasUpdate<Model>) {
      const double rounding = 64 * std::numeric_limits<double>::epsilon() * norm(soil.sigma);
      return {stiffness, rounding, std::min(1e-8, tolerance), 1e-6, 1e5 * rounding / stiffness + 1e-13};
    } else {
      return {stiffness, 0.0, 1e-9, 1e-7, 1e-10};
    }
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
  const auto whole = law.template strain_of<ModifiedEuler>(s.soil, Share{1}, 1e-4);
  const auto strain = whole.value_or(Sym<double, 6>::zero());
  auto soil = law.soil_rate(s.soil, strain);
  Rate<typename Constrained<Model>::template State<double, 6>, double> r{{soil.change, strain},
                                                                         whole.has_value() && soil.sound};
  for_each_component([&](double& x) { x *= share.value; }, r.change);
  return r;
}

template <class Model>
auto updated(const Constrained<Model>& law, const typename Constrained<Model>::template State<double, 6>& s,
             const Share& share, double tolerance) requires HasUpdate<Model> {
  return law.template step<ModifiedEuler>(s, share, tolerance);
}

template <class Model>
bool is_idle(const Constrained<Model>& law, const Share&) {
  return law.idle();
}

}  // namespace scarp::lab
