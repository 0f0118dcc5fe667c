// Absorbing sides (step/sides.hpp) at a bar between smooth walls, along which plane compression waves go.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "body_maker.hpp"
#include "scarp/base/error.hpp"

namespace scarp::verification {
namespace {

constexpr double rho = 2, E = 2e4, nu = 0.25, L = 20, h = 0.25;
constexpr double M = E * (1 - nu) / ((1 + nu) * (1 - 2 * nu));
const double c = std::sqrt(M / rho), Z = rho * c;

/// A bar 0 to L, one element high, that its right side holds and its left one does not; gravity along it.
Body<2> bar(double g = 0) {
  auto body = on_grid({-h, 0}, {L, h}, {static_cast<int>(L / h) + 1, 1}, {g, 0});
  add_box(body, linear_elastic(E, nu), rho, {0, 0}, {L, h}, {2 * static_cast<int>(L / h), 2});
  locate_points(body);
  for (const char* side : {"bottom", "top"}) fix(body.conditions, body.mesh->node_sets.at(side), 1);
  fix(body.conditions, body.mesh->node_sets.at("right"), 0);
  return body;
}

/// Only its walls go on holding it.
Conditions<2> walls(const Body<2>& body) {
  Conditions<2> others(body.mesh->node_count());
  for (const char* side : {"bottom", "top"}) fix(others, body.mesh->node_sets.at(side), 1);
  return others;
}

void open_right(Body<2>& body, std::optional<double> thickness,
                std::optional<std::array<double, 2>> impedance = std::nullopt) {
  open_side(body, {}, {body.mesh->node_sets.at("right"), thickness, impedance}, walls(body));
}

/// A wave that goes to the right: v = f(x), σ = −Z v.
void put_pulse(Body<2>& body) {
  auto& points = body.blocks()[0].points;
  for (int p = 0; p < points.size(); ++p) {
    const double s = (points.x[0][p] - 12) / 3;  // 6 m long, 24 elements
    const double v = std::abs(s) < 1 ? 0.1 * std::pow(std::cos(0.5 * std::numbers::pi * s), 2) : 0;
    points.v[0][p] = v;
    points.sigma[0][p] = -Z * v;
    points.sigma[1][p] = points.sigma[2][p] = -Z * v * nu / (1 - nu);
  }
}

/// Kinetic and stored energy of the points.
double energy(const Body<2>& body) {
  const auto& points = body.blocks()[0].points;
  double sum = 0;
  for (int p = 0; p < points.size(); ++p) {
    const double sigma = points.sigma[0][p];
    sum += 0.5 * points.mass[p] * (points.v[0][p] * points.v[0][p] + points.v[1][p] * points.v[1][p]) +
           0.5 * points.volume[p] * sigma * sigma / M;
  }
  return sum;
}

TEST(AbsorbingSide, LetsAPulseGo) {
  for (const double safety : {0.2, 0.9}) {
    auto body = bar();
    open_right(body, 0.0);
    put_pulse(body);
    const double before = energy(body);
    double taken = 0, held = 0, spring = 0;
    run_until(body, 16 / c, safety, {}, [&](double, const StepTotals<2>& totals) {
      taken += totals.dissipation_absorbing;
      held += totals.work_boundary;
      spring += totals.stored_sides;
    });
    const double left = energy(body) / before;
    EXPECT_LT(left, 0.01);
    EXPECT_NEAR(taken, before, 0.01 * before);
    EXPECT_EQ(held, 0);
    EXPECT_EQ(spring, 0);
    std::printf("pulse, safety %.1f: %.4f %% of its energy left, %.2f %% taken\n", safety, 100 * left,
                100 * taken / before);
  }
}

TEST(AbsorbingSide, SendsBackWhatAnotherImpedanceSays) {
  // (Z' − Z)/(Z' + Z) of the amplitude: a third at twice the impedance.
  auto body = bar();
  open_right(body, 0.0, std::array<double, 2>{2 * Z, 2 * Z});
  put_pulse(body);
  const double before = energy(body);
  run_until(body, 16 / c, 0.5, {}, [](double, const StepTotals<2>&) {});
  EXPECT_NEAR(std::sqrt(energy(body) / before), 1.0 / 3, 0.02);
}

TEST(AbsorbingSide, KeepsTheForceWithWhichItWasHeld) {
  auto body = bar(-10);  // gravity presses the bar to the left, where a wall is
  fix(body.conditions, body.mesh->node_sets.at("left"), 0);
  auto& points = body.blocks()[0].points;
  for (int p = 0; p < points.size(); ++p) points.sigma[0][p] = -50;
  for (int n = 0; n < body.mesh->node_count(); ++n) {  // all held: this stress is no equilibrium elsewhere
    if (body.mesh->node(n)[0] < L - 0.5 * h) fix(body.conditions, std::array{n}, 0);
  }
  auto others = body.conditions;
  for (const int n : body.mesh->node_sets.at("right"))
    others.fixed[n] = static_cast<std::uint8_t>(others.fixed[n] & ~1u);
  open_side(body, {}, {body.mesh->node_sets.at("right"), 40.0, std::nullopt}, others);
  double force = 0;
  for (const auto& node : body.fields[0].outside.sides.node) force += node.R[0];
  // The stress times its area, and what weight the nodes have: half of the last element's.
  EXPECT_NEAR(force, -50 * h + 10 * rho * h * 0.5 * h, 1e-9);
  for (int n = 0; n < 100; ++n) advance(body, 0.5 * critical_time_step(body), {});
  for (const double v : points.v[0]) EXPECT_LT(std::abs(v), 1e-12);
}

TEST(AbsorbingSide, GivesAsMuchAsTheSoilBeyondWould) {
  // The weight ρ g L of the bar, drawn to the left, on a spring M/δ: u = ρ g L δ / M; without one it goes on with
  // ρ g L / Z.
  constexpr double g = 0.1, delta = 30;
  auto body = bar(-g);
  open_right(body, delta);
  double balanced = 0, kinetic = 0, work = 0;
  run_until(body, 10 * (L + delta) / c, 0.5, {}, [&](double, const StepTotals<2>& totals) {
    balanced += totals.work_gravity + totals.work_boundary - totals.work_stress - totals.dissipation_absorbing -
                totals.stored_sides;
    work += totals.work_gravity;
    kinetic = totals.kinetic_energy;
  });
  const double u = -rho * g * L * delta / M;
  for (const auto& node : body.fields[0].outside.sides.node) EXPECT_NEAR(node.u[0], u, 0.01 * std::abs(u));
  EXPECT_LT(std::abs(kinetic - balanced), 0.01 * work);

  auto dashpot = bar(-g);
  open_right(dashpot, 0.0);
  double v = 0;
  run_until(dashpot, 10 * L / c, 0.5, {},
            [&](double, const StepTotals<2>& totals) { v = totals.momentum[0] / totals.mass; });
  EXPECT_NEAR(v, -rho * g * L / Z, 0.01 * rho * g * L / Z);
}

TEST(AbsorbingSide, TakesNoMoreThanHalfOfALightNodesMotion) {
  // C dt / m from small to large: v* never has the other sign of v where nothing else acts, and energy falls.
  Sides<2> sides;
  sides.of_node.resize(1);
  sides.of_node.set(0, 0);
  sides.node.resize(1);
  sides.node[0].mass = 1;
  for (const double kappa : {0.1, 1.0, 1.9, 2.1, 10.0, 1e4}) {
    sides.node[0].C = {kappa, kappa};
    Vec<2> a{}, F{};
    sides.damp(0, 1, {1, -2}, 1, a, F);
    EXPECT_GE(1 + a[0], -1e-14) << kappa;
    EXPECT_LT(1 + a[0], 1) << kappa;
    EXPECT_NEAR(F[0], a[0], 1e-12) << kappa;  // m a is the dashpot's force alone
    EXPECT_NEAR(a[1], -2 * a[0], 1e-12) << kappa;
  }
}

TEST(AbsorbingSide, IsRefusedWhereItCannotBe) {
  auto body = bar();
  const auto refused = [&](const AbsorbingSide& side, const std::string& problem) {
    try {
      soil_beyond(body, body.fields[0], side);
      ADD_FAILURE() << "not refused: " << problem;
    } catch (const InputError& error) {
      EXPECT_NE(error.problem().find(problem), std::string::npos) << error.what();
    }
  };
  refused({body.mesh->node_sets.at("right"), 4.9 * h, {}}, "at least five elements thick");
  std::vector<int> inside, all;
  for (int n = 0; n < body.mesh->node_count(); ++n) {
    all.push_back(n);
    if (std::abs(body.mesh->node(n)[0] - 10) < 1e-9) inside.push_back(n);
  }
  refused({inside, {}, {}}, "flat sides of the mesh");
  refused({all, {}, {}}, "flat sides of the mesh");
  refused({{body.mesh->node_sets.at("right")[0]}, {}, {}}, "flat sides of the mesh");
}

}  // namespace
}  // namespace scarp::verification
