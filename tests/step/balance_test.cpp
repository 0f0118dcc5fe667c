// What is held, as the initial imbalance or as the reaction of a side that is let go, is what the next step finds at
// the nodes: in every mesh, for stress of any kind.
#include <gtest/gtest.h>

#include <random>

#include "soils.hpp"

namespace scarp::test {
namespace {

/// Ground that fills the lower 0.6 of the mesh, at rest, under stress that differs from point to point.
Body<2> ground(Background background) {
  Body<2> body(std::make_unique<const Mesh<2>>(plane_mesh(background, 10)), {0, -9.81});
  Block<2> block("soil", elastic());
  constexpr int along = 30, up = 18;
  resize(block, along * up);
  std::mt19937 random(5);
  std::uniform_real_distribution<double> stress(-9, -1);
  auto& points = block.points;
  for (int i = 0; i < along * up; ++i) {
    points.x[0][i] = (i % along + 0.5) / along;
    points.x[1][i] = (i / along + 0.5) / along;
    points.volume[i] = points.initial_volume[i] = 1.0 / (along * along);
    points.mass[i] = 1.8 * points.volume[i];
    points.id[i] = i;
    for (auto& component : points.sigma) component[i] = stress(random);
  }
  body.fields[0].blocks.push_back(std::move(block));
  locate_points(body);
  for (const char* side : {"left", "right"}) fix(body.conditions, body.mesh->node_sets.at(side), 0);
  for (int j = 0; j < 2; ++j) fix(body.conditions, body.mesh->node_sets.at("bottom"), j);
  return body;
}

class Held : public testing::TestWithParam<Background> {};

TEST_P(Held, ImbalanceLeavesNothingOutOfBalance) {
  StepSettings settings;
  settings.scheme = two_term_scheme();
  auto free = ground(GetParam()), held = ground(GetParam());
  const double dt = 1e-4;
  const auto loose = advance(free, dt, settings);
  EXPECT_GT(loose.unbalanced_force, loose.weight);  // or there is nothing to hold
  hold_imbalance(held, settings);
  held.fields[0].outside.release.share = 1;
  const auto still = advance(held, dt, settings);
  EXPECT_LT(still.unbalanced_force, 1e-12 * loose.unbalanced_force);
}

TEST_P(Held, SidesThatAreLetGoKeepTheirForce) {
  if (GetParam() == Background::gimp || GetParam() == Background::b_spline)
    GTEST_SKIP() << "sides are let go with linear functions";
  StepSettings settings;
  settings.scheme = two_term_scheme();
  auto body = ground(GetParam());
  hold_imbalance(body, settings);  // within: what is left is the force with which sides hold
  body.fields[0].outside.release.share = 1;
  auto others = body.conditions;
  for (const char* side : {"left", "right", "bottom"})
    for (const int n : body.mesh->node_sets.at(side)) others.fixed[n] = 0;
  for (const char* side : {"left", "right", "bottom"})
    open_side(body, settings, {body.mesh->node_sets.at(side), 0.0, std::nullopt}, others);
  const auto totals = advance(body, 1e-4, settings);
  EXPECT_LT(totals.unbalanced_force, 1e-11 * totals.weight);
}

const auto backgrounds = testing::Values(Background::grid, Background::gimp, Background::b_spline, Background::quads,
                                         Background::triangles, Background::mixed);
const auto name = [](const auto& its) {
  return std::array{"grid", "gimp", "b_spline", "quads", "triangles", "mixed"}[static_cast<int>(its.param)];
};
INSTANTIATE_TEST_SUITE_P(Balance, Held, backgrounds, name);

}  // namespace
}  // namespace scarp::test
