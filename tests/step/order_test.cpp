// The same results to the last bit however points lie in their arrays, whenever these are put in order, and whatever
// soil there is elsewhere: sums go by chunks of the mesh and by the points' ids.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <functional>
#include <map>
#include <numeric>
#include <random>
#include <utility>

#include "scarp/base/error.hpp"
#include "scarp/exec/arrange.hpp"
#include "soils.hpp"

namespace scarp::test {
namespace {

using Bits = std::vector<std::uint64_t>;

/// All numbers of each point but the element that holds it, by id.
template <int Dim>
std::map<int, Bits> bits_of(Block<Dim>& block) {
  std::map<int, Bits> points;
  const auto& id = block.points.id;
  for_each_column(block, [&](const auto& column) {
    for (std::size_t i = 0; i < column.size(); ++i) {
      if constexpr (sizeof(column[i]) == 8) {
        points[id[i]].push_back(std::bit_cast<std::uint64_t>(column[i]));
      } else if (static_cast<const void*>(&column) != static_cast<const void*>(&block.points.element)) {
        points[id[i]].push_back(column[i]);
      }
    }
  });
  return points;
}

/// Every book of a step that depends on all points.
template <int Dim>
Bits bits_of(StepTotals<Dim> totals) {
  Bits all;
  StepTotals<Dim>::each_sum(totals, [&](double sum) { all.push_back(std::bit_cast<std::uint64_t>(sum)); });
  for (const double extreme : {totals.max_velocity, totals.stress.critical_dt})
    all.push_back(std::bit_cast<std::uint64_t>(extreme));
  return all;
}

struct Outcome {
  std::map<int, Bits> points;
  std::vector<Bits> totals;  ///< of each step
  std::int64_t changed = 0;
  bool operator==(const Outcome& other) const { return points == other.points && totals == other.totals; }
};

/// What is done to a body before each step.
template <int Dim>
using Disturb = std::function<void(Body<Dim>&, int step)>;

/// As tests/step/threads_test.cpp throws soil: with a cut in the middle; with the time step of the step before.
template <int Dim>
Outcome thrown(Body<Dim> body, const Scheme& scheme, int steps, const Disturb<Dim>& disturb) {
  const StepSettings settings{
      .scheme = scheme, .damping = 0.05, .quadrature = QuadratureRule::corrected, .integration = {1e-4, 1e-5}};
  Outcome outcome;
  double critical = critical_time_step(body, scheme, settings.damping);
  for (int s = 0; s < steps; ++s) {
    disturb(body, s);
    const auto totals = advance(body, 0.3 * critical, settings);
    critical = totals.stress.critical_dt;
    outcome.totals.push_back(bits_of(totals));
    outcome.changed += totals.changed_element;
    if (s != steps / 2) continue;
    std::vector<std::uint8_t> gone;
    const auto& points = body.fields[0].blocks[0].points;
    for (int i = 0; i < points.size(); ++i) gone.push_back(points.x[0][i] > 0.6 && points.x[Dim - 1][i] > 0.5);
    remove_points(body.fields[0].blocks[0], gone);
    reorder(body);
  }
  EXPECT_GT(20 * outcome.changed, body.point_count()) << "points hardly changed element";
  outcome.points = bits_of(body.fields[0].blocks[0]);
  return outcome;
}

/// Arrays of the points in any order.
template <int Dim>
void shuffle(Body<Dim>& body, int step) {
  std::mt19937 random(static_cast<unsigned>(step));
  for (auto& block : body.blocks()) {
    std::shuffle(block.order.begin(), block.order.end(), random);
  }
  exec::arrange_in_new_memory(body.fields[0].blocks);
  reorder(body);
}

/// Arrays are put in order at each step, or never, or the points are at random places in them from the start, or at
/// each step anew.
template <int Dim>
void expect_same(const std::function<Body<Dim>()>& make, int steps, const Scheme& scheme) {
  const Disturb<Dim> never = [](Body<Dim>& body, int) { body.fields[0].out_of_place = std::int64_t{-1} << 40; };
  const Disturb<Dim> always = [&](Body<Dim>& body, int) { exec::arrange_in_order(body.fields[0].blocks); };
  const Disturb<Dim> at_first = [&](Body<Dim>& body, int s) {
    if (s == 0) shuffle(body, s);
    never(body, s);
  };
  const Disturb<Dim> each_time = [&](Body<Dim>& body, int s) { shuffle(body, s); };
  const auto as_it_is = thrown<Dim>(make(), scheme, steps, [](Body<Dim>&, int) {});
  EXPECT_TRUE(as_it_is == thrown<Dim>(make(), scheme, steps, never)) << "never put in order";
  EXPECT_TRUE(as_it_is == thrown<Dim>(make(), scheme, steps, always)) << "always in order";
  EXPECT_TRUE(as_it_is == thrown<Dim>(make(), scheme, steps, at_first)) << "in any order at first";
  EXPECT_TRUE(as_it_is == thrown<Dim>(make(), scheme, steps, each_time)) << "in any order at each step";
}

const auto report = report_scheme(0.99), standard = two_term_scheme(0.01);

TEST(SameBitsHoweverPointsLie, OnAGrid) {
  for (const auto& scheme : {report, standard}) {
    expect_same<2>([] { return soil<2>(plane_mesh(Background::grid, 30), elastic(), 45, 1.0); }, 60, scheme);
    expect_same<2>([] { return soil<2>(plane_mesh(Background::grid, 30), subloading(), 45, 1.0); }, 60, scheme);
  }
}
TEST(SameBitsHoweverPointsLie, OnAMixedMesh) {
  for (const auto& scheme : {report, standard}) {
    expect_same<2>([] { return soil<2>(plane_mesh(Background::mixed, 30), elastic(), 45, 1.0); }, 60, scheme);
    expect_same<2>([] { return soil<2>(plane_mesh(Background::mixed, 30), subloading(), 45, 1.0); }, 60, scheme);
  }
}
TEST(SameBitsHoweverPointsLie, WithBSplines) {
  for (const auto& scheme : {report, standard})
    expect_same<2>([] { return soil<2>(plane_mesh(Background::b_spline, 30), subloading(), 45, 1.0); }, 60, scheme);
}
TEST(SameBitsHoweverPointsLie, WithGimp) {
  for (const auto& scheme : {report, standard})
    expect_same<2>([] { return soil<2>(plane_mesh(Background::gimp, 30), subloading(), 45, 1.0); }, 60, scheme);
}
TEST(SameBitsHoweverPointsLie, InABodyOfRevolution) {
  for (const auto& scheme : {report, standard})
    expect_same<2>([] { return soil<2>(revolved(plane_mesh(Background::grid, 30)), elastic(), 45, 1.0); }, 60, scheme);
}
TEST(SameBitsHoweverPointsLie, WithSandThatOpens) {
  expect_same<2>([] { return soil<2>(plane_mesh(Background::grid, 30), sand(), 45, 1.0); }, 60, standard);
}
TEST(SameBitsHoweverPointsLie, SofteningOverALength) {
  for (const auto kind : {Background::grid, Background::mixed})
    expect_same<2>([&] { return soil<2>(plane_mesh(kind, 30), subloading(), 45, 1.0, 0.08); }, 60, report);
}
TEST(SameBitsHoweverPointsLie, InSpace) {
  for (const auto kind : {Background::grid, Background::mixed, Background::gimp})
    expect_same<3>([&] { return soil<3>(solid_mesh(kind, 10), elastic(), 14, 1.0); }, 30, report);
  expect_same<3>([] { return soil<3>(solid_mesh(Background::grid, 10), subloading(), 14, 1.0); }, 30, standard);
}

/// A twelfth of a body's points, far from the others.
void throw_lump(Body<2>& body, Vec<2> by, double speed, int first_id) {
  auto& soil = body.fields[0].blocks[0];
  const int count = soil.size(), more = count / 12;
  std::vector<int> which(static_cast<std::size_t>(count + more));
  std::iota(which.begin(), which.end(), 0);
  for (int i = 0; i < more; ++i) which[count + i] = i;
  for_each_column(soil, [&]<class Array>(Array& column) {
    Array longer(which.size());
    for (std::size_t i = 0; i < which.size(); ++i) longer[i] = column[which[i]];
    column.swap(longer);
  });
  for (int i = count; i < count + more; ++i) {
    soil.points.id[i] = first_id + i;
    for (int j = 0; j < 2; ++j) {
      soil.points.x[j][i] += by[j];
      soil.points.v[j][i] = speed;
    }
  }
}

/// The points of a body that have their own half of a mesh, with or without a lump of soil in the other half that flies
/// through it and changes the active elements in every step.
Outcome beside(const AnyModel& model, GridFunctions functions, bool lump, int first_id) {
  const auto small = soil<2>(plane_mesh(Background::grid, 30), model, 45, 1.0);
  auto mesh = make_grid({0, 0}, {3, 1}, {90, 30}, functions);
  Body<2> body(std::make_unique<const Mesh<2>>(std::move(mesh)), {0, -9.81});
  body.fields[0].blocks.push_back(small.fields[0].blocks[0]);
  if (lump) throw_lump(body, {1.3, 0.05}, 3, first_id);
  locate_points(body);
  wall(body.conditions, *body.mesh, body.mesh->node_sets.at("bottom"), 1, 0.4);
  const StepSettings settings{.scheme = standard, .damping = 0.05, .integration = {1e-4, 1e-5}};
  Outcome outcome;
  const auto start = body.fields[0].active.element;
  for (int s = 0; s < 100; ++s) outcome.changed += advance(body, 1e-3, settings).changed_element;
  EXPECT_GT(outcome.changed, 0);
  EXPECT_NE(start, body.fields[0].active.element);
  outcome.points = bits_of(body.fields[0].blocks[0]);
  std::erase_if(outcome.points, [&](const auto& point) { return point.first >= 45 * 45; });
  EXPECT_EQ(outcome.points.size(), 45 * 45);
  return outcome;
}

TEST(SameBitsWhateverIsElsewhere, InThePlane) {
  for (const auto functions : {GridFunctions::linear, GridFunctions::gimp, GridFunctions::b_spline}) {
    for (const auto& model : {elastic(), subloading()}) {
      EXPECT_TRUE(beside(model, functions, false, 0) == beside(model, functions, true, 10000));
    }
  }
}

// Triangles' damping of waves takes the time step that their nodes allow: a lump that makes elements new in every step
// is not to make those of the soil find it sooner.
Outcome beside_on_triangles(bool lump) {
  auto mesh = irregular(50, 0.2, Kind::triangles);
  const auto small = soil<2>(irregular(20, 0.2, Kind::triangles), elastic(), 30, 1.0);
  Body<2> body(std::make_unique<const Mesh<2>>(std::move(mesh)), {0, -9.81});
  body.fields[0].blocks.push_back(small.fields[0].blocks[0]);
  auto& points = body.fields[0].blocks[0].points;
  for (auto& x : points.x)
    for (double& one : x) one *= 0.4;
  for (auto* column : {&points.volume, &points.initial_volume, &points.mass})
    for (double& one : *column) one *= 0.16;
  if (lump) throw_lump(body, {0.5, 0.05}, 10, 10000);
  locate_points(body);
  const StepSettings settings{.scheme = two_term_scheme(), .integration = {1e-4, 1e-5}};
  Outcome outcome;
  for (int s = 0; s < 100; ++s) outcome.changed += advance(body, 1e-4, settings).changed_element;
  EXPECT_GT(outcome.changed, 0);
  outcome.points = bits_of(body.fields[0].blocks[0]);
  std::erase_if(outcome.points, [&](const auto& point) { return point.first >= 30 * 30; });
  EXPECT_EQ(outcome.points.size(), 30 * 30);
  return outcome;
}

TEST(SameBitsWhateverIsElsewhere, OnTriangles) {
  EXPECT_TRUE(beside_on_triangles(false) == beside_on_triangles(true));
}

/// The critical time step that a step leaves and the one found of the points between steps, where no point went to an
/// element whose weight is not known yet.
int same_critical_steps(Body<2> body, const Scheme& scheme, std::int64_t& separated) {
  const StepSettings settings{.scheme = scheme, .damping = 0.05, .integration = {1e-4, 1e-5}};
  const double dt = 0.1 * critical_time_step(body, scheme, settings.damping);
  int compared = 0;
  for (int s = 0; s < 40; ++s) {
    const auto totals = advance(body, dt, settings);
    if (totals.changed_element > 0) continue;
    ++compared;
    separated += totals.stress.separated;
    EXPECT_EQ(totals.stress.critical_dt, critical_time_step(body, scheme, settings.damping)) << "step " << s;
  }
  return compared;
}

// Some points of sand open, so that those in their batches are looked at one by one.
TEST(CriticalTimeStep, HasOneFormula) {
  std::int64_t separated = 0;
  for (const auto kind : {Background::grid, Background::quads}) {
    for (const auto& model : {elastic(), subloading(), sand()})
      EXPECT_GT(same_critical_steps(soil<2>(plane_mesh(kind, 20), model, 30, 0.05), report, separated), 5);
  }
  EXPECT_GT(separated, 0);
}

TEST(FirstFailedPoint, IsThatOfTheLowestRegionAndId) {
  std::vector<exec::FailedPoint> all{
      {1, 3, IntegrationEnd::done}, {0, 9, IntegrationEnd::done}, {}, {0, 7, {}}, {2, 0, {}}};
  std::mt19937 random(1);
  for (int times = 0; times < 20; ++times) {
    std::shuffle(all.begin(), all.end(), random);
    exec::FailedPoint first;
    for (const auto& one : all) first.keep_first(one);
    EXPECT_EQ(first.region, 0);
    EXPECT_EQ(first.id, 7);
  }
}

/// What is said of a body all of whose points leave the mesh in one step.
std::string words_of_leaving(const Disturb<2>& disturb) {
  auto body = soil<2>(plane_mesh(Background::grid, 10), elastic(), 12, 0);
  disturb(body, 5);
  for (auto& v : body.fields[0].blocks[0].points.v) std::fill(v.begin(), v.end(), 1e3);
  try {
    advance(body, 2e-3, {});
  } catch (const RunError& error) {
    return error.what();
  }
  return "";
}

TEST(FirstLostPoint, IsThatOfTheLowestId) {
  const auto words = words_of_leaving([](Body<2>&, int) {});
  EXPECT_NE(words.find("point 0 of region"), std::string::npos) << words;
  EXPECT_EQ(words, words_of_leaving(shuffle<2>));
}

}  // namespace
}  // namespace scarp::test
