// One error-controlled modified Euler update of the full subloading model at many points: what the stress update of a
// time step costs on one core, in batches and on double. docs/performance.md says how to read the figures.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <random>
#include <vector>

#include "scarp/exec/stress_update.hpp"
#include "scarp/material/integrate/embedded.hpp"
#include "scarp/material/models.hpp"
#include "scarp/tensor/batch.hpp"
#include "soil.hpp"

namespace scarp::bench {
namespace {

constexpr int points = 1 << 14;
constexpr double tolerance = 1e-4;

template <class T, int N>
using State = Subloading::State<T, N>;

/// Points as the material point method stores them: a column for each component.
template <int N>
struct Columns {
  static constexpr int size = state_size<Subloading, N>();
  std::vector<Column> state, deps, spin;
};

template <class T>
constexpr int lanes = sizeof(T) / sizeof(double);

template <class T>
T load(const Column& column, int i) {
  if constexpr (lanes<T> == 1) {
    return column[static_cast<std::size_t>(i)];
  } else {
    return T::load_unaligned(column.data() + i);
  }
}

template <class T>
void store(const T& value, Column& column, int i) {
  if constexpr (lanes<T> == 1) {
    column[static_cast<std::size_t>(i)] = value;
  } else {
    value.store_unaligned(column.data() + i);
  }
}

/// A general state, that random strain of the soil has led to.
template <int N>
State<double, N> random_state(const Subloading& model, std::mt19937& generator) {
  std::normal_distribution<double> normal;
  std::uniform_real_distribution<double> uniform(0, 1);
  Sym<double, N> sigma = isotropic<double, N>(55.0);
  sigma[1] = 90 + 20 * uniform(generator);
  std::vector<Problem> problems;
  auto s = model.initial_state<N>(
      sigma, 100, {{"R_b", 2.0}, {"OCR", 1.2 + uniform(generator)}, {"a", 0.5}, {"beta", std::string("K0")}}, problems);
  for (int k = 0; k < 10; ++k) {
    Sym<double, N> deps;
    for (int j = 0; j < N; ++j) deps[j] = 1e-4 * normal(generator);
    deps[1] += 1e-4;
    integrate<ModifiedEuler>(model, s, deps, {tolerance, 1e-4});
  }
  return s;
}

/// Points in general states and increments of 1e-5 that take one substep; two in three load plastically.
template <int N>
Columns<N> make_points(const Subloading& model) {
  Columns<N> c;
  c.state.assign(Columns<N>::size, Column(points, 0.0));
  c.deps.assign(N, Column(points, 0.0));
  c.spin.assign(N == 4 ? 1 : 3, Column(points, 0.0));
  std::mt19937 generator(1);
  std::normal_distribution<double> normal;
  for (std::size_t at = 0; at < points;) {
    const auto s = random_state<N>(model, generator);
    Sym<double, N> deps;
    for (int j = 0; j < N; ++j) deps[j] = 1e-5 * normal(generator) + (j == 1 ? 5e-6 : 0.0);
    const auto trial = attempt<ModifiedEuler>(model, s, deps, tolerance);
    if (!trial.flags.sound || !(trial.error < 0.5 * tolerance)) continue;
    std::size_t field = 0;
    for_each_component([&](const double& x) { c.state[field++][at] = x; }, s);
    for (std::size_t j = 0; j < N; ++j) c.deps[j][at] = deps[static_cast<int>(j)];
    for (auto& column : c.spin) column[at] = 1e-5 * normal(generator);
    ++at;
  }
  return c;
}

template <class T, int N, bool turn>
void update(benchmark::State& loop) {
  const Subloading model = soil();
  const Columns<N> in = make_points<N>(model);
  Columns<N> out = in;
  int good_points = 0;
  for (auto _ : loop) {
    good_points = 0;
    for (int i = 0; i < points; i += lanes<T>) {
      State<T, N> s;
      std::size_t field = 0;
      for_each_component([&](T& x) { x = load<T>(in.state[field++], i); }, s);
      Sym<T, N> deps;
      for (int j = 0; j < N; ++j) deps[j] = load<T>(in.deps[static_cast<std::size_t>(j)], i);
      if constexpr (turn) {
        Spin<T, N> spin;
        for (std::size_t j = 0; j < spin.w.size(); ++j) spin.w[j] = load<T>(in.spin[j], i);
        rotate(s, Rotation<T, N>(spin));
      }
      const auto trial = attempt<ModifiedEuler>(model, s, deps, tolerance);
      const auto good = trial.flags.sound && (trial.error <= T(tolerance));
      const auto end = select_state(good, trial.state, s);
      field = 0;
      for_each_component([&](const T& x) { store(x, out.state[field++], i); }, end);
      good_points += all(good) ? lanes<T> : 0;
    }
    benchmark::ClobberMemory();
  }
  if (good_points < points) loop.SkipWithError("an increment needs more than one substep");
  loop.counters["ns_per_point"] =
      benchmark::Counter(points, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

/// The points in a block of the material point method, with strain increments, tension positive.
struct Soil {
  Block<2> block;
  PointIncrements<2> increments;
};

/// Every sixteenth increment needs `substeps` substeps.
Soil make_soil(const Subloading& model, int substeps) {
  const Columns<4> c = make_points<4>(model);
  Soil soil{Block<2>("bench", model), {}};
  Block<2>& block = soil.block;  // no structured binding: clang 14 does not capture those in a lambda
  PointIncrements<2>& increments = soil.increments;
  resize(block, points);
  block.order.resize(points);
  std::iota(block.order.begin(), block.order.end(), 0);
  increments.reserve(points);
  auto& p = block.points;
  for (std::size_t j = 0; j < 4; ++j) p.sigma[j] = c.state[j];
  for (std::size_t j = 0; j < block.state.size(); ++j) block.state[j] = c.state[j + 4];
  for (std::size_t j = 0; j < 4; ++j) std::copy(c.deps[j].begin(), c.deps[j].end(), increments.deps[j].begin());
  std::copy(c.spin[0].begin(), c.spin[0].end(), increments.spin[0].begin());
  for (auto* column : {&increments.volume, &increments.per_mass}) std::fill(column->begin(), column->end(), 1.0);
  for (auto& column : p.sigma)
    for (double& x : column) x = -x;
  for (auto& column : increments.deps)
    for (double& x : column) x = -x;
  for (std::size_t i = 0; i < points && substeps > 1; i += 16) {
    exec::with_state(block, static_cast<int>(i), [&](const auto& law, const auto& state) {
      Sym<double, 4> deps;
      for (std::size_t j = 0; j < 4; ++j) deps[static_cast<int>(j)] = -increments.deps[j][i];
      int taken = 0;
      double factor = 1;
      for (; taken < substeps && factor < 1e4; factor *= 1.1) {
        auto s = state;
        taken = integrate<ModifiedEuler>(law, s, factor * deps, {tolerance, 1e-4}, 0.5).substeps;
      }
      for (std::size_t j = 0; j < 4; ++j) increments.deps[j][i] *= factor / 1.1;
    });
  }
  return soil;
}

/// The stress update of a time step: rotation, update, stragglers apart, work, critical time step.
void sweep(benchmark::State& loop) {
  const auto [start, increments] = make_soil(soil(), static_cast<int>(loop.range(0)));
  Block<2> block = start;
  double substeps = 0;
  for (auto _ : loop) {
    loop.PauseTiming();
    block.points.sigma = start.points.sigma;
    block.state = start.state;
    loop.ResumeTiming();
    exec::StressTotals totals;
    exec::update_stresses(block, {block.order.data(), points}, increments, 0, 1e-3, {tolerance, 1e-4}, totals);
    if (totals.failures > 0) loop.SkipWithError("an update failed");
    substeps = static_cast<double>(totals.substeps);
  }
  loop.counters["substeps"] = substeps / points;
  loop.counters["ns_per_point"] =
      benchmark::Counter(points, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

/// The same increments point by point on double: rotation and update alone.
void one_by_one(benchmark::State& loop) {
  const Subloading model = soil();
  const auto [start, increments] = make_soil(model, static_cast<int>(loop.range(0)));
  std::vector<State<double, 4>> states(points), ends(points);
  std::vector<Sym<double, 4>> deps(points);
  for (int i = 0; i < points; ++i) {
    exec::with_state(start, i, [&](const auto&, const auto& s) {
      if constexpr (std::is_same_v<std::decay_t<decltype(s)>, State<double, 4>>)
        states[static_cast<std::size_t>(i)] = s;
    });
    for (int j = 0; j < 4; ++j) {
      deps[static_cast<std::size_t>(i)][j] = -increments.deps[static_cast<std::size_t>(j)][static_cast<std::size_t>(i)];
    }
  }
  double substeps = 0;
  for (auto _ : loop) {
    substeps = 0;
    for (std::size_t i = 0; i < points; ++i) {
      ends[i] = states[i];
      rotate(ends[i], Rotation<double, 4>(Spin<double, 4>{{increments.spin[0][i]}}));
      substeps += integrate<ModifiedEuler>(model, ends[i], deps[i], {tolerance, 1e-4}).substeps;
    }
    benchmark::ClobberMemory();
  }
  loop.counters["substeps"] = substeps / points;
  loop.counters["ns_per_point"] =
      benchmark::Counter(points, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

BENCHMARK(update<Batch, 4, false>)->Name("law/batch/plane_strain");
BENCHMARK(update<double, 4, false>)->Name("law/double/plane_strain");
BENCHMARK(update<Batch, 6, false>)->Name("law/batch/3D");
BENCHMARK(update<double, 6, false>)->Name("law/double/3D");
BENCHMARK(update<Batch, 4, true>)->Name("law/batch/plane_strain/turned");
BENCHMARK(update<Batch, 6, true>)->Name("law/batch/3D/turned");
BENCHMARK(sweep)->Name("sweep/batch")->Arg(1)->Arg(10);
BENCHMARK(one_by_one)->Name("sweep/double")->Arg(1)->Arg(10);

}  // namespace
}  // namespace scarp::bench
