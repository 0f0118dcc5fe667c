// The limit of the time step in simplices that hold few points.
#include <gtest/gtest.h>

#include <random>

#include "soils.hpp"

namespace scarp::test {
namespace {

/// Elastic soil in the lower three quarters of a cube cut into tetrahedra, eight points in each six of them: many lie
/// on faces, and go to one of the tetrahedra there, so that half of all hold none. No gravity; velocities at random.
Body<3> tetrahedra_with_few_points() {
  constexpr int n = 4, along = 2 * n;
  Body<3> body(std::make_unique<const Mesh<3>>(irregular(n, 0, Solid::tetrahedra, false)), {0, 0, 0});
  Block<3> block("soil", LinearElastic({1e4, 0.3}));
  resize(block, along * along * (along * 3 / 4));
  std::mt19937 random(1);
  std::uniform_real_distribution<double> velocity(-1e-3, 1e-3);
  auto& points = block.points;
  for (int p = 0; p < block.size(); ++p) {
    const int at[3] = {p % along, p / along % along, p / (along * along)};
    for (int j = 0; j < 3; ++j) {
      points.x[j][p] = (at[j] + 0.5) / along;
      points.v[j][p] = velocity(random);
    }
    points.volume[p] = points.initial_volume[p] = 1.0 / (along * along * along);
    points.mass[p] = 1.8 * points.volume[p];
    points.id[p] = p;
  }
  body.fields[0].blocks.push_back(std::move(block));
  locate_points(body);
  return body;
}

/// The largest kinetic energy in 300 steps of 0.8 of what is the critical step with `bounds`, over that at the start.
double growth(bool bounds) {
  Body<3> body = tetrahedra_with_few_points();
  StepSettings settings;
  settings.scheme = two_term_scheme();
  settings.scheme.bounds_by_nodes = bounds;
  const double dt = 0.8 * critical_time_step(body, settings.scheme);
  StepTotals<3> start;
  record_motion(body, start);
  double largest = 0;
  for (int s = 0; s < 300 && largest < 1e6 * start.kinetic_energy; ++s) {
    largest = std::max(largest, advance(body, dt, settings).kinetic_energy);
  }
  return largest / start.kinetic_energy;
}

TEST(NodeRates, TetrahedraWithFewPointsAreStable) {
  EXPECT_LT(growth(true), 1.0);
}

TEST(NodeRates, ElementsAloneWouldNotSee) {
  // If this fails, the case above tells nothing any more.
  EXPECT_GT(growth(false), 1e3);
}

TEST(NodeRates, FullTrianglesKeepTheirLimit) {
  // Eleven points per square of two triangles: inside the soil there is as good as no bound by nodes. At its sides
  // nodes have less mass.
  auto body = soil<2>(plane_mesh(Background::triangles, 10), elastic(), 20, 0);
  Scheme alone = two_term_scheme();
  alone.bounds_by_nodes = false;
  const double by_elements = critical_time_step(body, alone), with_nodes = critical_time_step(body, two_term_scheme());
  EXPECT_LE(with_nodes, by_elements);
  EXPECT_GT(with_nodes, 0.7 * by_elements);
}

}  // namespace
}  // namespace scarp::test
