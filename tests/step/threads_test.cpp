// The same bits on any number of threads, after points have changed element, been put in order and been removed.
#include <gtest/gtest.h>

#include <bit>
#include <cstdint>

#include "scarp/exec/parallel.hpp"
#include "soils.hpp"

namespace scarp::test {
namespace {

/// All numbers of the points, in their order, as bits.
template <int Dim>
std::vector<std::uint64_t> bits(Body<Dim>& body, const StepTotals<Dim>& totals) {
  std::vector<std::uint64_t> all;
  for_each_column(body.blocks()[0], [&](const auto& column) {
    for (const auto value : column) {
      if constexpr (sizeof(value) == 8) {
        all.push_back(std::bit_cast<std::uint64_t>(value));
      } else {
        all.push_back(value);
      }
    }
  });
  for (const double value : {totals.kinetic_energy, totals.work_stress, totals.work_gravity, totals.dissipation_damping,
                             totals.dissipation_friction, totals.stress.critical_dt}) {
    all.push_back(std::bit_cast<std::uint64_t>(value));
  }
  return all;
}

template <int Dim>
std::vector<std::uint64_t> run(int threads, Mesh<Dim> mesh, const AnyModel& model, int along, int steps, double speed,
                               double length = 0, const Scheme& scheme = report_scheme(0.99)) {
  exec::set_threads(threads);
  auto body = soil<Dim>(std::move(mesh), model, along, speed, length);
  const double dt = 0.3 * critical_time_step(body);
  const StepSettings settings{
      .scheme = scheme, .damping = 0.05, .quadrature = QuadratureRule::corrected, .integration = {1e-4, 1e-5}};
  StepTotals<Dim> totals;
  std::int64_t changed = 0;
  for (int s = 0; s < steps; ++s) {
    totals = advance(body, dt, settings);
    changed += totals.changed_element;
    if (s != steps / 2) continue;
    // A cut: what stands to the right above.
    std::vector<std::uint8_t> gone;
    const auto& points = body.blocks()[0].points;
    for (int i = 0; i < points.size(); ++i) gone.push_back(points.x[0][i] > 0.6 && points.x[Dim - 1][i] > 0.5);
    remove_points(body.blocks()[0], gone);
    reorder(body);
  }
  EXPECT_GT(10 * changed, body.point_count());  // so all were put in order at least once
  if (length > 0) {
    const auto& kappa_hat = body.blocks()[0].state.end()[-2];
    EXPECT_GT(*std::max_element(kappa_hat.begin(), kappa_hat.end()), 0) << "nothing has softened";
  }
  exec::set_threads(1);
  return bits(body, totals);
}

template <class Make>
void expect_same(Make&& make) {
  const auto one = make(1);
  for (const int threads : {2, 3, 8}) EXPECT_TRUE(one == make(threads)) << threads << " threads";
}

TEST(SameBitsOn1And2And3And8Threads, ElasticOnAGrid) {
  expect_same([](int threads) { return run<2>(threads, plane_mesh(Background::grid, 40), elastic(), 60, 100, 1.0); });
}
TEST(SameBitsOn1And2And3And8Threads, SubloadingOnAGrid) {
  expect_same(
      [](int threads) { return run<2>(threads, plane_mesh(Background::grid, 40), subloading(), 60, 100, 1.0); });
}
TEST(SameBitsOn1And2And3And8Threads, SubloadingOnAMixedMesh) {
  expect_same(
      [](int threads) { return run<2>(threads, plane_mesh(Background::mixed, 40), subloading(), 60, 100, 1.0); });
}
TEST(SameBitsOn1And2And3And8Threads, SubloadingWithBSplines) {
  expect_same(
      [](int threads) { return run<2>(threads, plane_mesh(Background::b_spline, 40), subloading(), 60, 100, 1.0); });
}
TEST(SameBitsOn1And2And3And8Threads, SubloadingWithGimp) {
  expect_same(
      [](int threads) { return run<2>(threads, plane_mesh(Background::gimp, 40), subloading(), 60, 100, 1.0); });
}
TEST(SameBitsOn1And2And3And8Threads, ElasticWithBSplinesInSpace) {
  expect_same(
      [](int threads) { return run<3>(threads, solid_mesh(Background::b_spline, 10), elastic(), 14, 60, 1.0); });
}
TEST(SameBitsOn1And2And3And8Threads, ElasticWithGimpInSpace) {
  expect_same([](int threads) { return run<3>(threads, solid_mesh(Background::gimp, 10), elastic(), 14, 60, 1.0); });
}
TEST(SameBitsOn1And2And3And8Threads, SubloadingInSpace) {
  expect_same(
      [](int threads) { return run<3>(threads, solid_mesh(Background::grid, 12), subloading(), 14, 100, 1.0); });
}
TEST(SameBitsOn1And2And3And8Threads, ElasticOnAMixedMeshInSpace) {
  expect_same([](int threads) { return run<3>(threads, solid_mesh(Background::mixed, 10), elastic(), 14, 60, 1.0); });
}

TEST(SameBitsOn1And2And3And8Threads, EveryModelOnAGrid) {
  const auto models = every_model();
  EXPECT_EQ(models.size() + 1, std::variant_size_v<AnyModel>) << "umat is the only one left out";
  for (const auto& model : models) {
    SCOPED_TRACE(description_of(model).name);
    expect_same([&](int threads) { return run<2>(threads, plane_mesh(Background::grid, 30), model, 40, 60, 0.5); });
  }
}
// Averages over a length of 2.5 elements, on every kind of mesh and for every law that softens.
TEST(SameBitsOn1And2And3And8Threads, SofteningOverALengthInThePlane) {
  for (const auto kind : {Background::grid, Background::gimp, Background::b_spline, Background::quads,
                          Background::triangles, Background::mixed}) {
    SCOPED_TRACE(static_cast<int>(kind));
    expect_same([&](int threads) { return run<2>(threads, plane_mesh(kind, 30), subloading(), 44, 60, 1.0, 0.08); });
  }
}
TEST(SameBitsOn1And2And3And8Threads, SofteningOverALengthInSpace) {
  for (const auto kind : {Background::grid, Background::mixed}) {
    SCOPED_TRACE(static_cast<int>(kind));
    expect_same([&](int threads) { return run<3>(threads, solid_mesh(kind, 10), subloading(), 14, 60, 1.0, 0.25); });
  }
}
TEST(SameBitsOn1And2And3And8Threads, EveryLawThatSoftensOverALength) {
  int softening = 0;
  for (const auto& model : every_model()) {
    if (!(kappa_c_of(model) > 0)) continue;
    ++softening;
    SCOPED_TRACE(description_of(model).name);
    expect_same(
        [&](int threads) { return run<2>(threads, plane_mesh(Background::grid, 30), model, 40, 60, 2.0, 0.1); });
  }
  EXPECT_EQ(softening, 6);
}
TEST(SameBitsOn1And2And3And8Threads, StandardSchemeWithItsMeansOverPatchesAndCells) {
  for (const auto kind : {Background::triangles, Background::mixed, Background::gimp}) {
    SCOPED_TRACE(static_cast<int>(kind));
    expect_same([&](int threads) {
      return run<2>(threads, plane_mesh(kind, 30), subloading(), 44, 40, 1.0, 0, two_term_scheme());
    });
  }
  for (const auto kind : {Background::triangles, Background::gimp}) {
    SCOPED_TRACE(static_cast<int>(kind));
    expect_same([&](int threads) {
      return run<3>(threads, solid_mesh(kind, 8), elastic(), 14, 40, 1.0, 0, two_term_scheme());
    });
  }
}
TEST(SameBitsOn1And2And3And8Threads, ElasticBodyOfRevolution) {
  expect_same(
      [](int threads) { return run<2>(threads, revolved(plane_mesh(Background::grid, 40)), elastic(), 60, 100, 1.0); });
}

}  // namespace
}  // namespace scarp::test
