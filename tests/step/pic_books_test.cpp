// What PIC takes is booked of sums at nodes in a scheme of two terms (docs/theory.md, "Energy ledger"). By its
// definition it is the kinetic energy that the same step would leave without PIC, less that which it leaves.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "soils.hpp"

namespace scarp::test {
namespace {

StepSettings with(double pic_time, double damping = 0) {
  return {.scheme = two_term_scheme(pic_time), .damping = damping, .integration = {1e-4, 1e-5}};
}

/// Takes a step with PIC and, from the same state, one without in `other`: what is booked of PIC is their difference to
/// round-off, and there is something to book.
template <int Dim>
StepTotals<Dim> step_both(Body<Dim>& body, Body<Dim>& other, double dt, double damping) {
  other.fields[0].blocks = body.fields[0].blocks;
  reorder(other);
  const auto kept = advance(other, dt, with(std::numeric_limits<double>::infinity(), damping));
  const auto totals = advance(body, dt, with(0.03, damping));
  const double taken = kept.kinetic_energy - totals.kinetic_energy;
  EXPECT_EQ(kept.dissipation_pic, 0);
  EXPECT_GT(std::abs(taken), 1e-6 * kept.kinetic_energy);
  EXPECT_NEAR(totals.dissipation_pic, taken, 1e-13 * kept.kinetic_energy);
  return totals;
}

template <int Dim>
void run(Mesh<Dim> mesh, int along, double damping = 0) {
  auto body = soil<Dim>(mesh, elastic(), along, 1), other = soil<Dim>(std::move(mesh), elastic(), along, 1);
  const double dt = 0.3 * critical_time_step(body, with(0.03).scheme, damping);
  std::int64_t changed = 0;
  for (int s = 0; s < 60 && !testing::Test::HasFailure(); ++s)
    changed += step_both(body, other, dt, damping).changed_element;
  EXPECT_GT(changed, 0) << "no point has changed element: the case tells less than it should";
}

class BooksOfPic : public testing::TestWithParam<Background> {};

TEST_P(BooksOfPic, InThePlane) {
  run<2>(plane_mesh(GetParam(), 8), 16);
}
TEST_P(BooksOfPic, WithDamping) {
  run<2>(plane_mesh(GetParam(), 8), 16, 0.3);
}
TEST_P(BooksOfPic, OfABodyOfRevolution) {
  if (GetParam() == Background::gimp) GTEST_SKIP() << "points that are boxes are no rings";
  run<2>(revolved(plane_mesh(GetParam(), 8)), 16);
}
TEST_P(BooksOfPic, InSpace) {
  run<3>(solid_mesh(GetParam(), 5), 8);
}
INSTANTIATE_TEST_SUITE_P(All, BooksOfPic,
                         testing::Values(Background::grid, Background::gimp, Background::b_spline, Background::quads,
                                         Background::triangles, Background::mixed));

/// Points on a line between elements: the other nodes of these have no mass, and move with those that do.
TEST(BooksOfPicOnALine, NodesWithoutMass) {
  const auto make = [] {
    Body<2> body(std::make_unique<const Mesh<2>>(make_grid({0, 0}, {1, 1}, {4, 4})), {0, -9.81});
    Block<2> block("line", elastic());
    resize(block, 8);
    auto& points = block.points;
    for (int i = 0; i < block.size(); ++i) {
      points.x[0][i] = 0.5;
      points.x[1][i] = 0.28 + 0.06 * i;
      points.v[0][i] = 0.3 * std::sin(5.0 * i);
      points.v[1][i] = 0.4 * std::cos(3.0 * i);
      points.volume[i] = points.initial_volume[i] = 0.005;
      points.mass[i] = 2 * points.volume[i];
      points.id[i] = i;
    }
    body.fields[0].blocks.push_back(std::move(block));
    locate_points(body);
    return body;
  };
  auto body = make(), other = make();
  EXPECT_GT(step_both(body, other, 1e-4, 0).massless_nodes, 0);
}

}  // namespace
}  // namespace scarp::test
