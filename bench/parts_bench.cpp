// Parts of a step but the law: its phases on each kind of mesh, finding elements, and ordering points. Phases are timed
// within whole steps, by the step's own profile, so that caches hold what they hold in a run.
#include <benchmark/benchmark.h>

#include <array>
#include <chrono>
#include <cstddef>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "ground.hpp"
#include "scarp/exec/arrange.hpp"
#include "scarp/mesh/chunks.hpp"
#include "scarp/run/build.hpp"
#include "scarp/step/soundness.hpp"
#include "scarp/step/step.hpp"

namespace scarp::bench {
namespace {

constexpr int points = 96000;

enum class Ground { q4, b_spline, mesh, t3, h8 };

template <Ground kind>
auto make_ground() {
  const AnyModel elastic = LinearElastic({1e4, 0.25});
  if constexpr (kind == Ground::q4) return run::build_body(grid_case<2>(points, elastic));
  if constexpr (kind == Ground::b_spline) {
    auto input = grid_case<2>(points, elastic);
    input.method.shape = GridFunctions::b_spline;
    return run::build_body(input);
  }
  if constexpr (kind == Ground::mesh) return mesh_body(points, elastic, ElementShape::quadrilaterals);
  if constexpr (kind == Ground::t3) return mesh_body(points, elastic, ElementShape::triangles);
  if constexpr (kind == Ground::h8) return run::build_body(grid_case<3>(points, elastic));
}

void set_time_per_point(benchmark::State& loop, int count) {
  loop.counters["ns_per_point"] =
      benchmark::Counter(count, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

/// Whole steps, with the time of each phase as a counter [ns per point].
template <Ground kind>
void phases_of_step(benchmark::State& loop) {
  auto body = make_ground<kind>();
  compress(body, 0.01);
  StepSettings settings;
  settings.profile = true;
  std::array<double, phases> seconds{};
  for (auto _ : loop) {
    const auto totals = advance(body, 1e-5, settings);
    for (int i = 0; i < phases; ++i) seconds[i] += totals.seconds[i];
  }
  const double point_steps = static_cast<double>(loop.iterations()) * body.point_count();
  for (int i = 0; i < phases; ++i) loop.counters[phase_names[i]] = 1e9 * seconds[i] / point_steps;
  set_time_per_point(loop, body.point_count());
}

/// The element of each point from its old one; `share` of the points, in percent, have moved by an element since.
template <Ground kind>
void locate(benchmark::State& loop) {
  auto body = make_ground<kind>();
  constexpr int Dim = std::tuple_size_v<decltype(body.gravity)>;
  auto& soil = body.fields[0].blocks.front().points;
  std::mt19937 random(5);
  std::uniform_int_distribution<int> percent(0, 99);
  for (int i = 0; i < soil.size(); ++i)
    if (percent(random) < loop.range(0)) soil.x[0][i] += soil.x[0][i] < soil.x[0][0] + 20 ? 1.0 : -1.0;
  SearchCounts counts;
  for (auto _ : loop) {
    for (int i = 0; i < soil.size(); ++i) {
      Vec<Dim> x;
      for (int j = 0; j < Dim; ++j) x[j] = soil.x[j][i];
      benchmark::DoNotOptimize(body.locator.find(x, soil.element[i], counts));
    }
  }
  set_time_per_point(loop, soil.size());
}

/// The order of the points by element after `share` of them, in percent, went to the element beside theirs; with
/// `arrange` their arrays are put into that order, too.
void order(benchmark::State& loop, bool arrange) {
  Body<2> body = make_ground<Ground::q4>();
  std::vector<Block<2>> start = body.fields[0].blocks;
  std::mt19937 random(5);
  std::uniform_int_distribution<int> percent(0, 99);
  auto& element = start.front().points.element;
  for (int& e : element)
    if (percent(random) < loop.range(0)) ++e;
  for (auto _ : loop) {
    loop.PauseTiming();
    body.fields[0].blocks.front().points = start.front().points;
    loop.ResumeTiming();
    sort_by_element<2>(
        body.fields[0].blocks, body.mesh->element_count(), [&](int e) { return chunk_of(*body.mesh, e); },
        body.fields[0].active);
    if (arrange) exec::arrange_in_order(body.fields[0].blocks);
  }
  set_time_per_point(loop, body.point_count());
}

/// What is looked at after each step, and the look at all points every few hundred steps, as shares of a step of the
/// Q4 grid [%].
void checks(benchmark::State& loop) {
  Body<2> body = make_ground<Ground::q4>();
  compress(body, 0.01);
  const StepSettings settings;
  using Clock = std::chrono::steady_clock;
  Clock::duration steps{}, looks{};
  const int every = static_cast<int>(loop.range(0));
  const auto totals = advance(body, 1e-5, settings);
  for (auto _ : loop) {
    const auto start = Clock::now();
    benchmark::DoNotOptimize(advance(body, 1e-5, settings));
    const auto between = Clock::now();
    body.fields[0].buffers.steps_since_look = every > 1 ? step::look_every : 0;
    step::refuse_nonsense(body, 1e-5, totals);
    looks += Clock::now() - between;
    steps += between - start;
  }
  loop.counters["percent"] = 100.0 / every * static_cast<double>(looks.count()) / static_cast<double>(steps.count());
}

BENCHMARK(checks)->Name("checks/each_step")->Arg(1);
BENCHMARK(checks)->Name("checks/all_points")->Arg(step::look_every);
BENCHMARK(phases_of_step<Ground::q4>)->Name("step/q4");
BENCHMARK(phases_of_step<Ground::b_spline>)->Name("step/b_spline");
BENCHMARK(phases_of_step<Ground::mesh>)->Name("step/mesh");
BENCHMARK(phases_of_step<Ground::t3>)->Name("step/t3");
BENCHMARK(phases_of_step<Ground::h8>)->Name("step/h8");
BENCHMARK(locate<Ground::q4>)->Name("locate/q4")->Arg(0)->Arg(2);
BENCHMARK(locate<Ground::mesh>)->Name("locate/mesh")->Arg(0)->Arg(2);
BENCHMARK(locate<Ground::t3>)->Name("locate/t3")->Arg(0)->Arg(2);
BENCHMARK(locate<Ground::h8>)->Name("locate/h8")->Arg(0)->Arg(2);
BENCHMARK_CAPTURE(order, sort, false)->Name("order/sort")->Arg(2);
BENCHMARK_CAPTURE(order, arrange, true)->Name("order/sort_and_arrange")->Arg(2);

}  // namespace
}  // namespace scarp::bench
