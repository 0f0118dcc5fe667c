// Integration of many increments in lanes against integrate() of each.
#include "scarp/material/integrate/lanes.hpp"

#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "material/samples.hpp"

namespace scarp::test {
namespace {

constexpr IntegrationSettings settings{1e-4, 2e-2};  // a smallest substep that some increments need less than

template <class Model, int N>
struct End {
  typename Model::template State<double, N> state;
  IntegrationReport report;
};

/// Increments from none at all to some that need many substeps, and some that end in failure.
template <int N>
std::vector<Task<Subloading, N>> tasks(const Subloading& model, int count) {
  std::mt19937 generator(41);
  std::uniform_real_distribution<double> uniform(0, 1);
  std::vector<Task<Subloading, N>> all;
  for (int i = 0; i < count; ++i) {
    const double size = i % 7 == 0 ? 0.0 : std::pow(10.0, -5 + 3.5 * uniform(generator));
    all.push_back({random_state<N>(generator, model), {random_tensor<N>(generator, size), 0.0}});
  }
  return all;
}

template <int N>
std::vector<End<Subloading, N>> in_lanes(const Subloading& model, const std::vector<Task<Subloading, N>>& all,
                                         const std::vector<int>& order) {
  std::vector<End<Subloading, N>> ends(all.size());
  int seen = 0;
  integrate_lanes<ModifiedEuler, Subloading, N>(
      model, static_cast<int>(order.size()),
      [&](int i) { return all[static_cast<std::size_t>(order[static_cast<std::size_t>(i)])]; },
      [&](int i, const auto& state, const IntegrationReport& report) {
        ends[static_cast<std::size_t>(order[static_cast<std::size_t>(i)])] = {state, report};
        ++seen;
      },
      settings, 0.5);
  EXPECT_EQ(seen, static_cast<int>(order.size()));
  return ends;
}

template <int N>
void expect_lanes_are_integrate(int count) {
  const auto model = subloading(full_constants());
  const auto all = tasks<N>(model, count);
  std::vector<int> order(all.size());
  std::iota(order.begin(), order.end(), 0);
  const auto ends = in_lanes<N>(model, all, order);
  int failed = 0, most = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    auto s = all[i].state;
    const auto report = integrate<ModifiedEuler>(model, s, all[i].whole, settings, 0.5);
    EXPECT_EQ(ends[i].report.end, report.end);
    EXPECT_EQ(ends[i].report.substeps, report.substeps);
    EXPECT_EQ(ends[i].report.rejected, report.rejected);
    EXPECT_NEAR(ends[i].report.reached, report.reached, 1e-9);
    EXPECT_EQ(ends[i].report.flags.sound, report.flags.sound);
    // 1e-15 in the error estimate moves every substep by as much, and rounding grows where the soil softens.
    EXPECT_LT(norm(ends[i].state.sigma - s.sigma), 1e-9 * norm(s.sigma)) << i;
    EXPECT_NEAR(ends[i].state.p_c, s.p_c, 1e-9 * s.p_c);
    failed += report.end != IntegrationEnd::done;
    most = std::max(most, report.substeps);
  }
  if (count > 100) {
    EXPECT_GT(failed, 0);
    EXPECT_GT(most, 15);
  }
}

TEST(Lanes, GiveWhatIntegrateGives) {
  for (int count : {0, 1, 3, 200}) {
    expect_lanes_are_integrate<4>(count);
    expect_lanes_are_integrate<6>(count);
  }
}

// To the last bit, or results would depend on how points are cut into chunks.
TEST(Lanes, DoNotSeeEachOther) {
  const auto model = subloading(full_constants());
  const auto all = tasks<4>(model, 60);
  std::vector<int> order(all.size());
  std::iota(order.begin(), order.end(), 0);
  const auto ends = in_lanes<4>(model, all, order);
  std::mt19937 generator(42);
  std::shuffle(order.begin(), order.end(), generator);
  const auto others = in_lanes<4>(model, all, order);
  for (std::size_t i = 0; i < all.size(); ++i) {
    EXPECT_EQ(ends[i].report.substeps, others[i].report.substeps);
    auto a = ends[i].state, b = others[i].state;
    for_each_component([](double& x, double& y) { EXPECT_EQ(x, y); }, a, b);
  }
}

}  // namespace
}  // namespace scarp::test
