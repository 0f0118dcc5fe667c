// Nothing is allocated inside a step, also when points change element.
#include <gtest/gtest.h>

#include "counting_new.hpp"
#include "soils.hpp"

namespace scarp::test {
namespace {

struct Counts {
  long allocations = 0;
  std::int64_t changed = 0;
};

template <int Dim>
Counts count(Body<Dim>& body, int steps, const Scheme& scheme = {}) {
  Counts counts;
  StepSettings settings;
  settings.scheme = scheme;
  const double dt = 0.3 * critical_time_step(body);
  advance(body, dt, settings);  // the first step sizes its buffers
  const long before = allocations();
  for (int s = 0; s < steps; ++s) counts.changed += advance(body, dt, settings).changed_element;
  counts.allocations = allocations() - before;
  return counts;
}

TEST(Allocation, NoneInStepsOfTheFullModel) {
  auto body = soil<2>(plane_mesh(Background::grid, 10), subloading(), 20, 0.5);
  EXPECT_EQ(count(body, 100).allocations, 0);
}

TEST(Allocation, NoneInStepsWherePointsChangeElement) {
  for (const auto background : {Background::grid, Background::gimp, Background::b_spline, Background::mixed}) {
    auto body = soil<2>(plane_mesh(background, 10), elastic(), 20, 1.0);
    const auto counts = count(body, 300);
    EXPECT_GT(counts.changed, 100);
    EXPECT_EQ(counts.allocations, 0);
  }
}

TEST(Allocation, NoneWithTheStandardScheme) {
  for (const auto background : {Background::grid, Background::gimp, Background::b_spline, Background::mixed}) {
    auto body = soil<2>(plane_mesh(background, 10), elastic(), 20, 1.0);
    const auto counts = count(body, 300, two_term_scheme());
    EXPECT_GT(counts.changed, 100);
    EXPECT_EQ(counts.allocations, 0);
  }
}

TEST(Allocation, NoneInSpace) {
  for (const auto background : {Background::grid, Background::gimp, Background::b_spline}) {
    auto body = soil<3>(solid_mesh(background, 6), elastic(), 10, 1.0);
    const auto counts = count(body, 100);
    EXPECT_GT(counts.changed, 100);
    EXPECT_EQ(counts.allocations, 0);
  }
}

}  // namespace
}  // namespace scarp::test
