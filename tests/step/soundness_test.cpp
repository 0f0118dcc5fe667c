// What is no motion of soil stops the step that makes it, or finds it: with the point, its region, where it is, and
// what is wrong.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <string>

#include "scarp/step/soundness.hpp"
#include "soils.hpp"

namespace scarp::test {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
constexpr int along = 30, up = 18, some_point = 9 * along + 7;
constexpr double dt = 1e-4;

/// Ground at rest in the lower part of the mesh, held at its sides; or free, in the left of it.
Body<2> ground(Background background, const AnyModel& law, double width = 1) {
  Body<2> body(std::make_unique<const Mesh<2>>(plane_mesh(background, 10)), {0, -9.81});
  Block<2> block("clay", law);
  resize(block, along * up);
  auto& points = block.points;
  for (int i = 0; i < along * up; ++i) {
    points.x[0][i] = width * (i % along + 0.5) / along;
    points.x[1][i] = (i / along + 0.5) / along;
    points.volume[i] = points.initial_volume[i] = width / (along * along);
    points.mass[i] = 1.8 * points.volume[i];
    points.id[i] = i;
    for (int c = 0; c < 3; ++c) points.sigma[c][i] = -2;
    set_state(block, i);
  }
  body.fields[0].blocks.push_back(std::move(block));
  locate_points(body);
  if (width < 1) return body;
  for (const char* side : {"left", "right"}) fix(body.conditions, body.mesh->node_sets.at(side), 0);
  for (int j = 0; j < 2; ++j) fix(body.conditions, body.mesh->node_sets.at("bottom"), j);
  return body;
}

StepSettings standard(bool two_terms = true) {
  StepSettings settings;
  if (two_terms) settings.scheme = two_term_scheme();
  return settings;
}

/// The error of a few steps, or nothing.
std::string error_of(Body<2>& body, const StepSettings& settings, int steps = 1, double length = dt) {
  try {
    for (int s = 0; s < steps; ++s) advance(body, length, settings);
  } catch (const RunError& error) {
    return error.what();
  }
  return "";
}

/// Where in the arrays the point with an id is.
int find(const Points<2>& points, int id) {
  return static_cast<int>(std::find(points.id.begin(), points.id.end(), id) - points.id.begin());
}

class Nonsense : public testing::TestWithParam<Background> {
 protected:
  /// What a step says once `spoil(points, i)` has spoilt a point.
  template <class F>
  std::string said(F&& spoil, const AnyModel& law = elastic()) {
    std::string all;
    for (const bool two_terms : {false, true}) {
      for (const bool removes : {false, true}) {
        auto settings = standard(two_terms);
        settings.remove_leaving = removes;
        auto body = ground(GetParam(), law);
        EXPECT_EQ(error_of(body, settings, 2), "");
        auto& block = body.fields[0].blocks[0];
        spoil(block, find(block.points, some_point));
        const std::string what = error_of(body, settings);
        EXPECT_NE(what, "") << "two terms: " << two_terms << ", leaving points removed: " << removes;
        all = what;
      }
    }
    return all;
  }
};

void expect_says(const std::string& what, std::initializer_list<const char*> parts) {
  for (const char* part : parts) EXPECT_NE(what.find(part), std::string::npos) << part << " in: " << what;
}

TEST_P(Nonsense, NotFiniteVelocity) {
  for (const double bad : {nan, infinity, -infinity}) {
    const auto what = said([bad](Block<2>& block, int i) { block.points.v[0][i] = bad; });
    expect_says(what, {"point ", "of region \"clay\"", "not finite", "velocity", "at ("});
  }
}

TEST_P(Nonsense, NotFiniteStress) {
  for (const double bad : {nan, infinity}) {
    for (int c = 0; c < 4; ++c) {
      const auto what = said([=](Block<2>& block, int i) { block.points.sigma[c][i] = bad; });
      expect_says(what, {"of region \"clay\"", "not finite", "sigma"});
    }
  }
}

TEST_P(Nonsense, NotFiniteVolumeOrMass) {
  expect_says(said([](Block<2>& block, int i) { block.points.volume[i] = nan; }), {"not finite", "volume"});
  expect_says(said([](Block<2>& block, int i) { block.points.volume[i] = infinity; }), {"not finite", "volume"});
  expect_says(said([](Block<2>& block, int i) { block.points.mass[i] = nan; }), {"not finite", "volume"});
}

TEST_P(Nonsense, NotFinitePosition) {
  for (int j = 0; j < 2; ++j) {
    expect_says(said([j](Block<2>& block, int i) { block.points.x[j][i] = nan; }), {"not finite", "x", "clay"});
    expect_says(said([j](Block<2>& block, int i) { block.points.x[j][i] = infinity; }), {"not finite", "x", "clay"});
  }
}

TEST_P(Nonsense, NotFiniteState) {
  const std::size_t columns = ground(GetParam(), subloading()).fields[0].blocks[0].state.size();
  for (std::size_t c = 0; c < columns; ++c) {
    auto body = ground(GetParam(), subloading());
    EXPECT_EQ(error_of(body, standard(), 2), "");
    auto& block = body.fields[0].blocks[0];
    block.state[c][find(block.points, some_point)] = nan;
    body.fields[0].buffers.steps_since_look = step::look_every - 1;
    expect_says(error_of(body, standard(), 1, 1e-7), {"not finite", "state", "of region \"clay\""});
  }
}

TEST_P(Nonsense, VolumeThatIsNotPositive) {
  for (const double bad : {-1e-4, 0.0}) {
    const auto what = said([bad](Block<2>& block, int i) { block.points.volume[i] = bad; });
    expect_says(what, {"volume of point 277 of region \"clay\" is not positive", "at ("});
  }
}

TEST_P(Nonsense, VolumeBeyondItsBoundsIsFoundByTheNextLook) {
  for (const double times : {2e6, 5e-4}) {
    auto body = ground(GetParam(), elastic());
    auto& points = body.fields[0].blocks[0].points;
    const int i = find(points, some_point);
    points.initial_volume[i] = points.volume[i] / times;
    expect_says(error_of(body, standard(), step::look_every, 1e-7), {"volume of point 277", "times that at the start"});
  }
}

TEST_P(Nonsense, NumbersThatNothingAsksForAreFoundByTheNextLook) {
  auto body = ground(GetParam(), elastic());
  auto& points = body.fields[0].blocks[0].points;
  points.eps_q[find(points, some_point)] = nan;
  body.fields[0].buffers.steps_since_look = step::look_every - 1;
  expect_says(error_of(body, standard(), 1, 1e-7), {"point 277", "not finite", "eps_q"});
}

TEST_P(Nonsense, PointsThatCrossMoreThanAnElement) {
  for (const double elements : {0.2, 1.7}) {
    auto body = ground(GetParam(), elastic(), 0.5);
    body.gravity = {};
    auto& points = body.fields[0].blocks[0].points;
    for (auto& sigma : points.sigma) std::fill(sigma.begin(), sigma.end(), 0.0);
    std::fill(points.v[0].begin(), points.v[0].end(), elements * 0.1 / dt);
    const auto what = error_of(body, standard());
    if (elements < 1) {
      EXPECT_EQ(what, "");
    } else {
      expect_says(what, {"crosses more than an element in a step", "of region \"clay\"", "elements in dt = 0.0001 s"});
    }
  }
}

TEST_P(Nonsense, SoundGroundGoesOn) {
  auto body = ground(GetParam(), subloading());
  EXPECT_EQ(error_of(body, standard(), step::look_every + 10, 1e-5), "");
}

const auto backgrounds = testing::Values(Background::grid, Background::gimp, Background::b_spline, Background::quads,
                                         Background::triangles, Background::mixed);
const auto name = [](const auto& its) {
  return std::array{"grid", "gimp", "b_spline", "quads", "triangles", "mixed"}[static_cast<int>(its.param)];
};
INSTANTIATE_TEST_SUITE_P(Soundness, Nonsense, backgrounds, name);

}  // namespace
}  // namespace scarp::test
