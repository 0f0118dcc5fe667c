// Absorbing sides of any impedance, from next to nothing to rock without end (docs/theory.md, "Absorbing sides"): what
// they send back, that they take energy, that nothing moves beside them that is at rest.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>
#include <random>

#include "ground.hpp"
#include "scarp/base/error.hpp"

namespace scarp::verification {
namespace {

constexpr double ratios[] = {0.01, 0.3, 1, 3, 30, 1e3, 1e5};

StepSettings with(const Scheme& scheme, double damping = 0) {
  StepSettings settings;
  settings.scheme = scheme;
  settings.damping = damping;
  return settings;
}
const struct {
  const char* name;
  Scheme scheme;
} schemes[] = {{"report", report_scheme()}, {"two-term", undamped(two_term_scheme())}};

// A bar along which plane compression waves go, held at its right end.
constexpr double rho = 2, E = 2e4, nu = 0.25, L = 20, h = 0.25;
constexpr double M = E * (1 - nu) / ((1 + nu) * (1 - 2 * nu));
const double c = std::sqrt(M / rho), Z = rho * c;

Conditions<2> walls(const Body<2>& body) {
  Conditions<2> others(body.mesh->node_count());
  for (const char* side : {"bottom", "top"}) fix(others, body.mesh->node_sets.at(side), 1);
  return others;
}
Body<2> bar() {
  auto body = on_grid({-h, 0}, {L, h}, {static_cast<int>(L / h) + 1, 1}, {0, 0});
  add_box(body, linear_elastic(E, nu), rho, {0, 0}, {L, h}, {2 * static_cast<int>(L / h), 2});
  locate_points(body, true);
  body.conditions = walls(body);
  fix(body.conditions, body.mesh->node_sets.at("right"), 0);
  return body;
}
void open_right(Body<2>& body, double r, double thickness) {
  open_side(body, {}, {body.mesh->node_sets.at("right"), thickness, std::array{r * Z, r * Z}}, walls(body));
}

/// A pulse of 6 m, 24 elements, that is 8 m from the right end.
double pulse(double x) {
  const double s = (x - 12) / 3;
  return std::abs(s) < 1 ? 0.1 * std::pow(std::cos(0.5 * std::numbers::pi * s), 2) : 0;
}
void put_pulse(Body<2>& body) {
  auto& points = body.blocks()[0].points;
  for (int p = 0; p < points.size(); ++p) {
    points.v[0][p] = pulse(points.x[0][p]);
    points.sigma[0][p] = -Z * points.v[0][p];
    points.sigma[1][p] = points.sigma[2][p] = points.sigma[0][p] * nu / (1 - nu);
  }
}
/// Of the pulse that is back where it was: its amplitude.
double amplitude(const Body<2>& body) {
  const auto& points = body.blocks()[0].points;
  double sum = 0, all = 0;
  for (int p = 0; p < points.size(); ++p) {
    const double f = pulse(points.x[0][p]);
    sum += points.v[0][p] * f;
    all += f * f;
  }
  return sum / all;
}

TEST(StiffSide, SendsBackWhatItsImpedanceSays) {
  // The weight of a stiff side sends back some of what it should take: most at a ratio of some tens, where a third of
  // that is lost.
  for (const auto& [name, scheme] : schemes) {
    for (const double r : ratios) {
      auto body = bar();
      open_right(body, r, 0);
      put_pulse(body);
      double taken = 0;
      const double before = 2 * 0.1 * 0.1 * 0.5 * rho * h * 6 * 3 / 8;  // ∫ cos⁴ is 3/8
      run_until(body, 16 / c, 0.8, with(scheme), [&](double, const StepTotals<2>& totals) {
        taken += totals.dissipation_absorbing;
        EXPECT_GE(totals.dissipation_absorbing, -1e-4 * before) << r;
      });
      const double sent = (1 - r) / (1 + r);
      std::printf("%s, ratio %g: %.4f of the amplitude (right: %.4f), %.4f of the energy taken (right: %.4f)\n", name,
                  r, amplitude(body), sent, taken / before, 1 - sent * sent);
      EXPECT_NEAR(amplitude(body), sent, 0.03) << name << ", ratio " << r;
      EXPECT_NEAR(taken / before, 1 - sent * sent, 0.05) << name << ", ratio " << r;
    }
  }
}

TEST(StiffSide, WithoutEndIsAFixedOne) {
  for (const auto& [name, scheme] : schemes) {
    auto fixed = bar(), stiff = bar();
    open_right(stiff, 1e5, 40);
    for (auto* body : {&fixed, &stiff}) {
      put_pulse(*body);
      run_until(*body, 16 / c, 0.8, with(scheme), [](double, const StepTotals<2>&) {});
    }
    const auto &a = fixed.blocks()[0].points, &b = stiff.blocks()[0].points;
    double difference = 0;
    for (int p = 0; p < a.size(); ++p) difference = std::max(difference, std::abs(a.v[0][p] - b.v[0][p]));
    std::printf("%s: velocities beside a fixed and a stiff side differ by up to %.1e of the pulse\n", name,
                difference / 0.1);
    EXPECT_LT(difference, 1e-3 * 0.1);
  }
}

TEST(StiffSide, BooksAStepToTheLastDigit) {
  // Without stress at its start only what stands for the soil beyond works on the nodes in a step: what it and PIC take
  // and store is the change of kinetic energy.
  std::mt19937 random(7);
  std::uniform_real_distribution<double> some(-1, 1);
  for (const auto& [name, scheme] : schemes) {
    for (const double r : ratios) {
      for (const double damping : {0.0, 0.3}) {
        auto body = bar();
        open_right(body, r, 5 * h);
        auto& points = body.blocks()[0].points;
        for (int p = 0; p < points.size(); ++p) points.v[0][p] = some(random);
        double stored = 0;
        for (auto& node : body.fields[0].outside.sides.node) {
          node.R[0] = some(random);
          node.u[0] = 1e-3 * some(random) / r;
          stored -= 0.5 * node.k[0] * node.u[0] * node.u[0];
        }
        const auto settings = with(scheme, damping);
        const auto totals = advance(body, 0.8 * critical_time_step(body, scheme, damping), settings);
        for (const auto& node : body.fields[0].outside.sides.node) stored += 0.5 * node.k[0] * node.u[0] * node.u[0];
        EXPECT_NEAR(totals.kinetic_energy - totals.kinetic_energy_before,
                    totals.work_boundary - totals.dissipation_absorbing - totals.stored_sides -
                        totals.dissipation_damping - totals.dissipation_pic,
                    1e-12 * totals.kinetic_energy)
            << name << ", ratio " << r << ", damping " << damping;
        EXPECT_NEAR(totals.stored_sides, stored, 1e-12 * totals.kinetic_energy) << name << ", ratio " << r;
      }
    }
  }
}

template <int Dim>
void open_all(Body<Dim>& body, const StepSettings& settings, double r) {
  const double M_p = Soil::E * 0.7 / (1.3 * 0.4), G = Soil::E / 2.6;  // ν = 0.3
  const std::array impedance{r * std::sqrt(Soil::rho * M_p), r * std::sqrt(Soil::rho * G)};
  const Conditions<Dim> none(body.mesh->node_count());
  for (const char* side : {"left", "right", "front", "back", "bottom"}) {
    const auto found = body.mesh->node_sets.find(side);
    if (found != body.mesh->node_sets.end()) open_side(body, settings, {found->second, 10.0, impedance}, none);
  }
}

/// Ground between absorbing sides, at rest under its weight.
template <int Dim>
void rests(Body<Dim> body, double r, const std::string& what) {
  const auto settings = with(two_term_scheme()), damped = with(two_term_scheme(), 0.7);
  const double dt = 0.5 * critical_time_step(body, settings.scheme);
  double before = 0, fastest = 0;
  for (int s = 0; s < 1500; ++s) before = advance(body, dt, damped).max_velocity;
  ASSERT_LT(before, 1e-6);  // 1e-15 but on triangles, whose balance is another
  open_all(body, settings, r);
  for (int s = 0; s < 500; ++s) fastest = std::max(fastest, advance(body, dt, settings).max_velocity);
  std::printf("%s, ratio %g: %.1e m/s, at the start %.1e\n", what.c_str(), r, fastest, before);
  EXPECT_LT(fastest, 2 * before + 1e-12) << what << ", ratio " << r;
}

/// Soil without weight (what hardly anything holds would topple under it) between absorbing sides, knocked about.
template <int Dim>
void bears(Body<Dim> body, double r, int steps, const std::string& what) {
  const auto settings = with(two_term_scheme());
  auto& points = body.blocks()[0].points;
  body.gravity = {};
  for (auto& sigma : points.sigma) std::fill(sigma.begin(), sigma.end(), 0.0);
  open_all(body, settings, r);
  const double dt = 0.8 * critical_time_step(body, settings.scheme);
  std::mt19937 random(7);
  std::uniform_real_distribution<double> some(-1e-4, 1e-4);
  double before = 0, most = 0, taken = 0;
  for (int p = 0; p < points.size(); ++p) {
    for (int j = 0; j < Dim; ++j) {
      points.v[j][p] = some(random);
      before += 0.5 * points.mass[p] * points.v[j][p] * points.v[j][p];
    }
  }
  StepTotals<Dim> totals;
  for (int s = 0; s < steps; ++s) {
    totals = advance(body, dt, settings);
    most = std::max(most, totals.kinetic_energy);
    taken += totals.dissipation_absorbing;
  }
  std::printf("%s, ratio %g: %.2g of the energy after %d steps, sides took %.2g\n", what.c_str(), r,
              totals.kinetic_energy / before, steps, taken / before);
  EXPECT_LE(most, before) << what << ", ratio " << r;
  EXPECT_LT(totals.kinetic_energy, 0.5 * before) << what << ", ratio " << r;
  EXPECT_GT(taken, 0) << what << ", ratio " << r;
}

constexpr double all_ratios[] = {0.01, 0.3, 1, 1.3, 2, 3, 10, 30, 1e3, 1e5};
Mesh<2> plane(Cells cells) {
  return cut_up(make_grid({0, 0}, {3, 2.5}, {6, 5}), cells);
}
Mesh<3> space() {
  return make_grid<3>({0, 0, 0}, {1.5, 1.5, 1.5}, {3, 3, 3});
}

TEST(StiffSide, LeavesGroundAtRest) {
  for (const double r : all_ratios) {
    for (const auto cells : {Cells::grid, Cells::quads, Cells::triangles})
      rests<2>(ground<2>(plane(cells), {0.25, 2}), r, name_of(cells));
    rests<3>(ground<3>(space(), {0.25, 1}), r, "hexahedra");
  }
}

TEST(StiffSide, BearsTenThousandSteps) {
  for (const double r : all_ratios) {
    for (const auto cells : {Cells::grid, Cells::triangles}) {
      for (const double height : {2.0, 1.85})  // whole elements, and the uppermost filled in part
        bears<2>(ground<2>(plane(cells), {0.25, height}), r, 10000, name_of(cells));
    }
    bears<3>(ground<3>(space(), {0.25, 1}), r, 2000, "hexahedra");
  }
}

TEST(StiffSide, IsNoWallWithFriction) {
  auto body = bar();
  wall(body.conditions, *body.mesh, body.mesh->node_sets.at("right"), 0, 0.2);
  try {
    soil_beyond(body, body.fields[0], {body.mesh->node_sets.at("right"), {}, {}});
    ADD_FAILURE() << "not refused";
  } catch (const InputError& error) {
    EXPECT_NE(error.problem().find("is no wall with friction"), std::string::npos) << error.what();
    EXPECT_NE(error.value().find("friction = 0.2 at the node at (20, 0)"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace scarp::verification
