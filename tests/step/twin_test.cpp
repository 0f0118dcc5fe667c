// The fast step and its twin (twin.hpp) stay together over hundreds of steps.
#include "twin.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>

#include "soils.hpp"

namespace scarp::test {
namespace {

/// Largest difference of a number from that of the twin, over the largest of its kind.
class Difference {
 public:
  void add(double fast, double twin) {
    largest_ = std::max(largest_, std::abs(twin));
    difference_ = std::max(difference_, std::isnan(fast) ? 1e300 : std::abs(fast - twin));
  }
  double relative() const { return difference_ / largest_; }

 private:
  double largest_ = 1e-300, difference_ = 0;
};

template <class Model, int Dim>
double difference(const Body<Dim>& body, const Twin<Model, Dim>& twin) {
  const auto& block = body.blocks()[0];
  const auto& points = block.points;
  constexpr int N = sym_size<Dim>;
  Difference x, v, sigma, Omega;
  std::vector<Difference> state(block.state.size());
  for (int i = 0; i < block.size(); ++i) {
    const auto& of_twin = twin.points[points.id[i]];
    for (int j = 0; j < Dim; ++j) {
      x.add(points.x[j][i], of_twin.x[j]);
      v.add(points.v[j][i], of_twin.v[j]);
    }
    Omega.add(points.volume[i], of_twin.Omega);
    int c = 0;
    for_each_component(
        [&](double y) {
          if (c < N) sigma.add(points.sigma[c][i], -y);
          if (c >= 3 * N) state[c - N].add(block.state[c - N][i], y);
          ++c;
        },
        of_twin.state);
  }
  double worst = std::max({x.relative(), v.relative(), sigma.relative(), Omega.relative()});
  if (state.size() > 1) worst = std::max({worst, state.end()[-1].relative(), state.end()[-2].relative()});
  return worst;
}

/// Runs both for `steps` steps of 0.3 critical ones and expects them together: 1e-10 of the largest number of each
/// kind, where round-off of single operations is 1e-16 and a step makes thousands of them, some on differences.
template <class Model, int Dim>
void run_both(Mesh<Dim> mesh, const AnyModel& model, int along, int steps, const StepSettings& settings,
              double speed = 1) {
  auto body = soil<Dim>(std::move(mesh), model, along, speed);
  Twin<Model, Dim> twin(body, std::get<Model>(body.blocks()[0].model));
  body.fields[0].buffers.bounds.every = 1;  // as the twin has it
  const double dt = 0.3 * critical_time_step(body);
  double worst = 0;
  std::int64_t changed = 0;
  for (int s = 1; s <= steps; ++s) {
    const auto totals = advance(body, dt, settings);
    twin.advance(dt, settings);
    changed += totals.changed_element;
    ASSERT_NEAR(totals.kinetic_energy, twin.kinetic_energy, 1e-10 * twin.kinetic_energy);
    ASSERT_NEAR(totals.work_gravity, twin.work_gravity, 1e-10 * totals.weight * dt);
    worst = std::max(worst, difference(body, twin));
    ASSERT_LT(worst, 1e-10) << "step " << s;
  }
  EXPECT_GT(changed, 0) << "no point has changed element: the case tells less than it should";
  std::printf("worst difference %.1e after %d steps, %d points, %lld changes of element\n", worst, steps,
              body.point_count(), static_cast<long long>(changed));
  if (std::is_same_v<Model, MohrCoulomb>) {
    EXPECT_GT(twin.shared, 0);
  }
}

const StepSettings plain{.integration = {1e-4, 1e-5}}, all_on{.scheme = report_scheme(0.98),
                                                              .damping = 0.1,
                                                              .quadrature = QuadratureRule::corrected,
                                                              .integration = {1e-4, 1e-5}};

/// The report's with walls that meet the motion.
StepSettings by_motion() {
  StepSettings s = all_on;
  s.scheme.wall = WallRule::by_motion;
  return s;
}
/// The standard, with a damping of waves that is felt and a PIC share of 3 % in a step of 1e-3.
StepSettings two_term(double damping = 0) {
  StepSettings s{.scheme = two_term_scheme(0.03), .damping = damping, .integration = {1e-4, 1e-5}};
  s.scheme.damping.share = 0.2;
  return s;
}
StepSettings apic() {
  return {.scheme = apic_scheme(), .integration = {1e-4, 1e-5}};
}

class InThePlane : public testing::TestWithParam<Background> {};
class InSpace : public testing::TestWithParam<Background> {};

TEST_P(InThePlane, LinearElastic) {
  run_both<LinearElastic, 2>(plane_mesh(GetParam(), 10), elastic(), 13, 400, plain);
}
TEST_P(InThePlane, LinearElasticWithDampingAndPic) {
  run_both<LinearElastic, 2>(plane_mesh(GetParam(), 10), elastic(), 13, 400, all_on);
}
TEST_P(InThePlane, LinearElasticOnAWallByMotion) {
  run_both<LinearElastic, 2>(plane_mesh(GetParam(), 10), elastic(), 13, 400, by_motion());
}
TEST_P(InThePlane, SumOverPointsAsPrinted) {
  run_both<LinearElastic, 2>(plane_mesh(GetParam(), 10), elastic(), 13, 200,
                             {.quadrature = QuadratureRule::points, .integration = {1e-4, 1e-5}});
}
TEST_P(InThePlane, Subloading) {
  run_both<Subloading, 2>(plane_mesh(GetParam(), 10), subloading(), 13, 300, all_on, 0.5);
}
TEST_P(InThePlane, BodyOfRevolution) {
  if (GetParam() == Background::gimp) GTEST_SKIP() << "points that are boxes are no rings";
  run_both<LinearElastic, 2>(revolved(plane_mesh(GetParam(), 10)), elastic(), 13, 300, plain);
}
TEST_P(InThePlane, BodyOfRevolutionAsPrinted) {
  if (GetParam() == Background::gimp) GTEST_SKIP() << "points that are boxes are no rings";
  run_both<LinearElastic, 2>(revolved(plane_mesh(GetParam(), 10)), elastic(), 13, 100,
                             {.quadrature = QuadratureRule::points, .integration = {1e-4, 1e-5}});
}
TEST_P(InThePlane, BodyOfRevolutionOfSubloadingSoil) {
  if (GetParam() == Background::gimp) GTEST_SKIP() << "points that are boxes are no rings";
  run_both<Subloading, 2>(revolved(plane_mesh(GetParam(), 10)), subloading(), 13, 200, all_on, 0.1);
}
TEST_P(InThePlane, LinearElasticWithTwoTerms) {
  run_both<LinearElastic, 2>(plane_mesh(GetParam(), 10), elastic(), 13, 300, two_term(0.1));
}
TEST_P(InThePlane, SubloadingWithTwoTerms) {
  run_both<Subloading, 2>(plane_mesh(GetParam(), 10), subloading(), 13, 200, two_term(), 0.5);
}
TEST_P(InThePlane, SandThatOpensWithTwoTerms) {
  run_both<MohrCoulomb, 2>(plane_mesh(GetParam(), 10), sand(), 13, 200, two_term());
}
TEST_P(InThePlane, BodyOfRevolutionWithTwoTerms) {
  if (GetParam() == Background::gimp) GTEST_SKIP() << "points that are boxes are no rings";
  run_both<LinearElastic, 2>(revolved(plane_mesh(GetParam(), 10)), elastic(), 13, 200, two_term());
}
TEST_P(InThePlane, LinearElasticWithApic) {
  run_both<LinearElastic, 2>(plane_mesh(GetParam(), 10), elastic(), 13, 300, apic());
}
TEST_P(InSpace, LinearElasticWithTwoTerms) {
  // So many points that tetrahedra are full, too.
  const int along = GetParam() == Background::triangles ? 14 : 8;
  run_both<LinearElastic, 3>(solid_mesh(GetParam(), 6), elastic(), along, 150, two_term(0.1));
}
TEST_P(InSpace, SandThatOpensWithTwoTerms) {
  run_both<MohrCoulomb, 3>(solid_mesh(GetParam(), 6), sand(), 8, 100, two_term());
}
TEST_P(InSpace, LinearElasticWithApic) {
  run_both<LinearElastic, 3>(solid_mesh(GetParam(), 6), elastic(), 8, 100, apic());
}
TEST_P(InSpace, LinearElastic) {
  run_both<LinearElastic, 3>(solid_mesh(GetParam(), 6), elastic(), 8, 150, all_on);
}
TEST_P(InSpace, LinearElasticOnAWallByMotion) {
  run_both<LinearElastic, 3>(solid_mesh(GetParam(), 6), elastic(), 8, 150, by_motion());
}
TEST_P(InSpace, Subloading) {
  run_both<Subloading, 3>(solid_mesh(GetParam(), 6), subloading(), 8, 200, all_on, 0.5);
}

const auto backgrounds = testing::Values(Background::grid, Background::gimp, Background::b_spline, Background::quads,
                                         Background::triangles, Background::mixed);
const auto name = [](const auto& its) {
  return std::array{"grid", "gimp", "b_spline", "quads", "triangles", "mixed"}[static_cast<int>(its.param)];
};
INSTANTIATE_TEST_SUITE_P(Twin, InThePlane, backgrounds, name);
INSTANTIATE_TEST_SUITE_P(Twin, InSpace, backgrounds, name);

}  // namespace
}  // namespace scarp::test
