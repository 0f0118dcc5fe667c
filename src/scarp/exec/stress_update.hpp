// Step 7 of the report for points of a block: rotation, stress and state, many points per instruction. Points whose
// increment needs more than one substep are finished apart.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <tuple>
#include <type_traits>
#include <vector>

#include "scarp/exec/trial_state.hpp"
#include "scarp/material/integrate/embedded.hpp"
#include "scarp/points/lanes.hpp"
#include "scarp/points/points.hpp"
#include "scarp/transfer/point_increments.hpp"

namespace scarp::exec {

/// What is done about waves: the damping of the rate of stress, β = ξ h/c or as given, σ* = σ + (β/dt) (σ − Q σ^t Qᵀ)
/// being what nodes feel; and the limit of the time step, for which the highest ω² is that of a lumped mass (4 c²/h²)
/// times `highest2`. Waves of ω are stable where ω² dt² + 2 ω² β dt ≤ 4, so that
///     dt ≤ k h/c,   k = √(1/highest2 + ξ²) − ξ.
struct WaveSettings {
  double share = 0, time = 0;  ///< ξ; β [s], which goes before
  double highest2 = 1;
  bool open_are_soft = false;  ///< a point that is open counts with the volume that it will have when it has closed

  bool damped() const { return share > 0 || time > 0; }
  /// 1/k² where c²/h² = rate2 [1/s²].
  template <class T>
  T per_limit2(const T& rate2) const {
    if (time > 0) return limit2<T>(T(time) * sqrt(rate2));
    return limit2<T>(T(share));
  }

 private:
  template <class T>
  T limit2(const T& xi) const {
    const T k = sqrt(T(1 / highest2) + xi * xi) - xi;
    return T(1.0) / (k * k);
  }
};

/// A point whose stress update failed. The first of several is that of the lowest region and id.
struct FailedPoint {
  int region = 0;  ///< its place among the blocks of the body; 0 where only one is known
  int id = -1;     ///< -1: none
  IntegrationEnd end = IntegrationEnd::done;

  void keep_first(const FailedPoint& other) {
    const bool earlier = id < 0 || std::tie(other.region, other.id) < std::tie(region, id);
    if (other.id >= 0 && earlier) *this = other;
  }
};

/// What stress updates did.
struct StressTotals {
  double damping = 0;  ///< Σ Ω ½ (σ* − σ at t, and at t + dt) : dε
  double work = 0;     ///< Σ Ω ½ (σ^t + σ^{t+dt}) : dε, with σ^t rotated with the body
  double critical_dt = std::numeric_limits<double>::infinity();  ///< least 1 / (c/(k h) + |v|/h)
  std::int64_t substeps = 0;
  int most_substeps = 0;
  std::int64_t failures = 0, corrected = 0, separated = 0, on_floor = 0, no_stiffness = 0;
  FailedPoint first_failed;

  /// Adds counts and extremes, no sums.
  void add_counts(const StressTotals& other);
};

/// Updates stress, state, shear strain and flags of some points of a block over the time dt, from their strain and spin
/// increments in `increments` from place `at` on.
template <int Dim>
void update_stresses(Block<Dim>& block, PointRange range, const PointIncrements<Dim>& increments, int at, double dt,
                     const IntegrationSettings& settings, StressTotals& totals, const WaveSettings& waves = {});

/// The same to the columns of a trial that is prepared for the block, which stays as it is.
template <int Dim>
void trial_stresses(const Block<Dim>& block, TrialState<Dim>& trial, PointRange range,
                    const PointIncrements<Dim>& increments, int at, double dt, const IntegrationSettings& settings,
                    StressTotals& totals, const WaveSettings& waves = {});

/// The least 1 / (c/(k h) + |v|/h) over the points of a block, with c the compression wave speed of their present
/// stiffness; infinite where no point has stiffness. `weight` is that of the points in the quadrature of the active
/// element in each slot, `least_per_mass` a bound of PointIncrements::per_mass from below in each element, or empty.
template <int Dim>
double critical_time_step(const Block<Dim>& block, const Mesh<Dim>& mesh, const ActiveElements& active,
                          const Column& weight, const Column& least_per_mass, const WaveSettings& waves);

/// f(component, its column, whether that is of sigma) for each component of a state that this model keeps in a column
/// of `sigma` or `state`: sigma, tension positive in the arrays of the points and compression positive in the law, and
/// the law's own. The rest of a state goes to `without(component)`.
template <int Dim, class Model, class Sigma, class States, class S, class F, class G>
inline void for_each_kept(const Model& model, Sigma& sigma, States& state, S& s, F&& f, G&& without) {
  constexpr int N = sym_size<Dim>;
  const int columns = state_columns<N>(model);
  int c = 0;
  for_each_component(
      [&](auto& x) {
        if (c < N) {
          f(x, sigma[c], std::true_type{});
        } else if (c - N < columns) {
          f(x, state[c - N], std::false_type{});
        } else {
          without(x);
        }
        ++c;
      },
      s);
}

/// State of some points of a block of this model, compression positive; load(column) gives a number of each.
template <int Dim, class S, class Model, class Load>
inline S loaded(const Model& model, const Block<Dim>& block, Load&& load) {
  S s;
  for_each_kept<Dim>(
      model, block.points.sigma, block.state, s,
      [&](auto& x, const Column& column, auto of_sigma) {
        x = load(column);
        if constexpr (of_sigma) x = -x;
      },
      [](auto& x) { x = std::decay_t<decltype(x)>(0.0); });
  return s;
}

/// To the columns `sigma` and `state`; store(number of each, column).
template <int Dim, class S, class Model, class Store>
inline void store(const Model& model, const S& s, std::array<Column, sym_size<Dim>>& sigma, std::vector<Column>& state,
                  Store&& to) {
  for_each_kept<Dim>(
      model, sigma, state, s,
      [&](const auto& x, Column& column, auto of_sigma) {
        if constexpr (of_sigma) {
          to(-x, column);
        } else {
          to(x, column);
        }
      },
      [](const auto&) {});
}
template <int Dim, class S, class Model, class Store>
inline void store(const Model& model, const S& s, Block<Dim>& block, Store&& to) {
  store<Dim>(model, s, block.points.sigma, block.state, to);
}

/// State of point i of a block of this model, compression positive.
template <int Dim, class Model>
typename Model::template State<double, sym_size<Dim>> state_of(const Block<Dim>& block, const Model& model, int i) {
  return loaded<Dim, typename Model::template State<double, sym_size<Dim>>>(
      model, block, [i](const Column& column) { return column[i]; });
}

/// Calls f(model, state of point i) for point i of a block.
template <int Dim, class F>
void with_state(const Block<Dim>& block, int i, F&& f) {
  std::visit([&](const auto& model) { f(model, state_of<Dim>(block, model, i)); }, block.model);
}

}  // namespace scarp::exec
