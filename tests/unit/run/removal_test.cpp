// Soil that is taken away in lifts. Oracle: which points stand where at which time, looked at one by one.
#include "scarp/run/removal.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <set>

#include "scarp/base/error.hpp"
#include "scarp/run/build.hpp"
#include "unit/input/minimal.hpp"

namespace scarp::run {
namespace {

using input::test::minimal;

/// The box of 0.5 to 1 m by 0.5 to 2 m that stage "cut" of the minimal case takes, over 3 s.
input::RemovalInput box(int lifts) {
  input::RemovalInput removal;
  removal.polygon = {{0.5, 0.5}, {1.0, 0.5}, {1.0, 2.0}, {0.5, 2.0}};
  removal.lifts = lifts;
  removal.over = lifts > 1 ? 3 : 0;
  return removal;
}

bool is_in_box(const Vec<2>& x, double bottom) {
  return x[0] > 0.5 && x[0] < 1.0 && x[1] > std::max(0.5, bottom) && x[1] < 2.0;
}

std::set<int> ids_of(const Body<2>& body) {
  std::set<int> ids;
  for (const auto& block : body.blocks()) ids.insert(block.points.id.begin(), block.points.id.end());
  return ids;
}

TEST(Removal, GoesFromTheTopDown) {
  const auto input = box(3);  // whose bottoms, at 1.5 and 1 m, lie between points
  Body<2> body = build_body(input::test::read(minimal));
  for (auto& block : body.blocks())
    for (int i = 0; i < block.size(); ++i) block.points.v[0][i] = 1 + 0.1 * block.points.id[i];
  const Body<2> whole = build_body(input::test::read(minimal));
  Ledger<2> ledger;
  Removal<2> removal(input, 10);
  for (int lift = 1; lift <= 3; ++lift) {
    EXPECT_DOUBLE_EQ(removal.next_time(), 10 + 1.5 * (lift - 1));  // the first at once, the last 3 s later
    EXPECT_FALSE(removal.finished());
    const auto before = ids_of(body);
    removal.take_due(removal.next_time() - 1e-9, body, ledger);
    EXPECT_EQ(ids_of(body), before) << "too early";
    removal.take_due(removal.next_time(), body, ledger);
    // What is left: all but what is in the upper `lift` thirds of the box.
    std::set<int> left;
    double mass = 0, energy = 0;
    for (const auto& block : whole.blocks()) {
      for (int i = 0; i < block.size(); ++i) {
        const int id = block.points.id[i];
        if (!is_in_box(position_of(block.points, i), 2.0 - 0.5 * lift)) {
          left.insert(id);
          continue;
        }
        mass += block.points.mass[i];
        energy += 0.5 * block.points.mass[i] * (1 + 0.1 * id) * (1 + 0.1 * id);
      }
    }
    EXPECT_EQ(ids_of(body), left) << "lift " << lift;
    EXPECT_EQ(ledger.removed_points, whole.point_count() - static_cast<int>(left.size()));
    EXPECT_NEAR(ledger.removed_mass, mass, 1e-12);
    EXPECT_NEAR(ledger.removed_kinetic_energy, energy, 1e-12 * energy);
  }
  EXPECT_TRUE(removal.finished());
  EXPECT_EQ(removal.next_time(), std::numeric_limits<double>::infinity());
  EXPECT_LT(body.point_count(), whole.point_count());
  // The elements that it has emptied are no longer active.
  for (const int e : body.fields[0].active.element) {
    bool holds = false;
    for (const auto& block : body.blocks())
      for (const int of_point : block.points.element) holds = holds || of_point == e;
    EXPECT_TRUE(holds) << "element " << e;
  }
}

TEST(Removal, TakesAllThatIsDueAtOnce) {
  const auto lifts = box(4), once = box(1);
  Body<2> a = build_body(input::test::read(minimal)), b = build_body(input::test::read(minimal));
  Ledger<2> ledger;
  Removal<2> in_lifts(lifts, 0), at_once(once, 0);
  in_lifts.take_due(100, a, ledger);
  EXPECT_TRUE(in_lifts.finished());
  EXPECT_EQ(at_once.next_time(), 0);
  at_once.take_due(0, b, ledger);
  EXPECT_TRUE(at_once.finished());
  EXPECT_EQ(ids_of(a), ids_of(b));
}

TEST(Removal, RefusesToLeaveNoSoil) {
  input::RemovalInput all;
  all.polygon = {{-1, -1}, {5, -1}, {5, 5}, {-1, 5}};
  Body<2> body = build_body(input::test::read(minimal));
  Ledger<2> ledger;
  Removal<2> removal(all, 0);
  EXPECT_THROW(removal.take_due(0, body, ledger), RunError);
}

}  // namespace
}  // namespace scarp::run
