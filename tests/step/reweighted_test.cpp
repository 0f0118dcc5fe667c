// H1: where the energy of a step comes from that no force has worked for (docs/theory.md, "Energy ledger").
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "scarp/mesh/grid.hpp"
#include "scarp/step/step.hpp"
#include "soils.hpp"

namespace scarp::test {
namespace {

constexpr double E = 100, rho = 2, g = 10;

/// A free column of linear-elastic soil with ν = 0, 1.5 m wide and 3 m high, that moves through a grid of elements of
/// 0.5 m under gravity and swings in its own length: nothing holds it and nothing turns, so that every step's energies
/// are known to the last bit.
Body<2> column(double velocity) {
  Body<2> body(std::make_unique<const Mesh<2>>(make_grid({0, 0}, {2.5, 8}, {5, 16})), {0, -g});
  Block<2> block("column", LinearElastic({E, 0}));
  constexpr int across = 4, along = 8;  // 1.33 points along an element: not in step
  resize(block, across * along);
  auto& points = block.points;
  for (int p = 0; p < block.size(); ++p) {
    points.x[0][p] = 0.5 + 1.5 * (p % across + 0.5) / across;
    points.x[1][p] = 3 + 3.0 * (p / across + 0.5) / along;
    points.volume[p] = points.initial_volume[p] = 1.5 * 3 / block.size();
    points.mass[p] = rho * points.volume[p];
    points.id[p] = p;
    points.v[1][p] = velocity + 0.05 * std::sin(2 * (points.x[1][p] - 3));
    points.sigma[1][p] = -0.5;
  }
  body.fields[0].blocks.push_back(std::move(block));
  locate_points(body);
  return body;
}

/// What a point was when a step started, by its number.
struct Point {
  double Omega, w;
  std::array<double, 4> sigma;
};

/// w of every point by the definition: V / Σ Ω of an element in which, and around which, there are points, where these
/// fill from a half to twice of it.
std::vector<double> weights(const Body<2>& body, const std::vector<int>& element) {
  const auto& points = body.blocks()[0].points;
  std::map<int, double> volume;
  for (int i = 0; i < points.size(); ++i) volume[element[points.id[i]]] += points.volume[i];
  std::vector<double> w(points.size(), 1);
  for (int i = 0; i < points.size(); ++i) {
    const int e = element[points.id[i]];
    bool inside = true;
    for (const int other : body.mesh->elements_around(e)) inside = inside && volume.count(other) > 0;
    const auto& side = body.mesh->grid->spacing;
    const double share = volume[e] / (side[0] * side[1]);
    if (inside && share > 0.5 && share < 2) w[points.id[i]] = 1 / share;
  }
  return w;
}

std::vector<int> elements(const Body<2>& body) {
  const auto& points = body.blocks()[0].points;
  std::vector<int> e(points.size());
  for (int i = 0; i < points.size(); ++i) e[points.id[i]] = points.element[i];
  return e;
}

/// With ν = 0: ½ σ:σ / E.
double density(const std::array<double, 4>& sigma) {
  double all2 = 0;
  for (const double x : sigma) all2 += x * x;
  return all2 / (2 * E);
}
std::array<double, 4> stress_of(const Points<2>& points, int i) {
  return {points.sigma[0][i], points.sigma[1][i], points.sigma[2][i], points.sigma[3][i]};
}

struct Energies {
  double R = 0;           ///< change of kinetic and stored energy less the work of gravity
  double jumps = 0;       ///< first term: −½ Σ Δ(F_int · v dt) between one step and the next
  double ends = 0;        ///< what of that the first and the last step leave
  double smooth = 0;      ///< of stored energy, as volumes change where points stay
  double reweighted = 0;  ///< second term, as the program books it
  double by_hand = 0;     ///< the same from the weights above
  double largest = 0;     ///< stored energy
  std::int64_t crossings = 0;
};

double kinetic_energy(const Points<2>& points) {
  double sum = 0;
  for (int i = 0; i < points.size(); ++i)
    sum += 0.5 * points.mass[i] * (points.v[0][i] * points.v[0][i] + points.v[1][i] * points.v[1][i]);
  return sum;
}
double momentum(const Points<2>& points) {
  double sum = 0;
  for (int i = 0; i < points.size(); ++i) sum += points.mass[i] * points.v[1][i];
  return sum;
}

/// F_int · v of the body as it is: a step of no length leaves both at the nodes, and everything else as it was.
double power_of_nodes(Body<2>& body) {
  advance(body, 0, {});
  double power = 0;
  for (int k = 0; k < body.fields[0].assembly.size(); ++k) {
    const auto at = static_cast<std::size_t>(body.fields[0].assembly.first_accumulator(k));
    const double* sum = body.fields[0].buffers.sums.data() + at * transfer::node_sums<2>;  // m, p, F_int
    if (sum[0] < body.fields[0].least_mass) continue;
    for (int j = 0; j < 2; ++j) power += sum[3 + j] * sum[1 + j] / sum[0];
  }
  return power;
}

Energies follow(double velocity, double dt, int steps) {
  auto body = column(velocity);
  const auto& points = body.blocks()[0].points;
  Energies its;
  const double start_kinetic = kinetic_energy(points), start_momentum = momentum(points);
  double stored_start = 0, stored = 0, S_before = 0, gravity = 0;
  for (int s = 0; s < steps; ++s) {
    const auto old_elements = elements(body);
    const auto w_old = weights(body, old_elements);
    std::vector<Point> before(points.size());
    stored = 0;
    for (int i = 0; i < points.size(); ++i) {
      const int id = points.id[i];
      before[id] = {points.volume[i], w_old[id], stress_of(points, i)};
      stored += w_old[id] * points.volume[i] * density(before[id].sigma);
    }
    if (s == 0) stored_start = stored;
    its.largest = std::max(its.largest, stored);

    const double Q = power_of_nodes(body) * dt;
    const auto totals = advance(body, dt, {});
    its.crossings += totals.changed_element;
    gravity += totals.work_gravity;
    its.reweighted += totals.energy_reweighted;
    const auto w_stay = weights(body, old_elements);  // as if all had stayed, with the volumes that they have now
    const auto w_new = weights(body, elements(body));
    double S = 0;
    for (int i = 0; i < points.size(); ++i) {
      const int id = points.id[i];
      const auto& was = before[id];
      const auto now = stress_of(points, i);
      for (int c = 0; c < 4; ++c) S += was.w * was.Omega * now[c] * (now[c] - was.sigma[c]) / E;
      its.smooth += (w_stay[id] * points.volume[i] - was.w * was.Omega) * density(now);
      its.by_hand += (w_new[id] - w_stay[id]) * points.volume[i] * density(now);
    }
    (s == 0 ? its.ends : its.jumps) -= 0.5 * (Q - S_before);
    S_before = S;
    if (s == steps - 1) its.ends += 0.5 * S;
  }
  double stored_end = 0;
  const auto w = weights(body, elements(body));
  for (int i = 0; i < points.size(); ++i)
    stored_end += w[points.id[i]] * points.volume[i] * density(stress_of(points, i));
  its.ends += 0.5 * dt * g * (momentum(points) - start_momentum);
  its.R = kinetic_energy(points) - start_kinetic + stored_end - stored_start - gravity;
  return its;
}

void expect_all_accounted_for(const Energies& its) {
  EXPECT_NEAR(its.R, its.jumps + its.ends + its.smooth + its.reweighted, 1e-9 * its.largest);
  EXPECT_NEAR(its.reweighted, its.by_hand, 1e-9 * its.largest);
  std::printf("R %.3e = jumps %.3e + ends %.3e + smooth %.3e + reweighted %.3e, of %.3e kJ/m stored; %lld crossings\n",
              its.R, its.jumps, its.ends, its.smooth, its.reweighted, its.largest,
              static_cast<long long>(its.crossings));
}

TEST(Reweighted, TermsOfH1AreAllThereIsWithCrossings) {
  // Falls by 0.8 m, 1.6 elements: every point changes element once or twice.
  const auto its = follow(0, 2e-3, 200);
  expect_all_accounted_for(its);
  EXPECT_GT(its.crossings, 40);
  EXPECT_GT(std::abs(its.reweighted), 1e-3 * its.largest);  // or there is nothing to tell
}

TEST(Reweighted, NothingWithoutCrossings) {
  // Three steps, in which no point goes further than 0.2 mm.
  const auto its = follow(0.02, 2e-3, 3);
  EXPECT_EQ(its.crossings, 0);
  EXPECT_EQ(its.reweighted, 0);
  expect_all_accounted_for(its);
}

TEST(Reweighted, CountsTheElementsAroundThoseThatFillOrEmpty) {
  // Soil in no order that turns as it flies: elements get their first points and lose their last one by one, and those
  // around them become or cease to be inside the soil without a point of their own moving. The program's sum over the
  // elements that it thinks are changed is that over all points.
  auto body = soil<2>(make_grid({0, 0}, {1, 1}, {10, 10}), LinearElastic({E, 0}), 13, 1);
  const auto& points = body.blocks()[0].points;
  const double dt = 0.3 * critical_time_step(body);
  double largest = 0;
  for (int s = 0; s < 200; ++s) {
    const auto old_elements = elements(body);
    const auto totals = advance(body, dt, {});
    const auto stay = weights(body, old_elements), now = weights(body, elements(body));
    double by_hand = 0, stored = 0;
    for (int i = 0; i < points.size(); ++i) {
      const double energy = points.volume[i] * density(stress_of(points, i));
      by_hand += (now[points.id[i]] - stay[points.id[i]]) * energy;
      stored += energy;
    }
    largest = std::max(largest, std::abs(by_hand) / stored);
    ASSERT_NEAR(totals.energy_reweighted, by_hand, 1e-12 * stored) << "step " << s;
  }
  EXPECT_GT(largest, 1e-3);
}

TEST(Reweighted, NoneOfTheSumOverPointsAsPrinted) {
  auto body = column(0);
  StepSettings settings;
  settings.quadrature = QuadratureRule::points;
  std::int64_t changed = 0;
  for (int s = 0; s < 200; ++s) {
    const auto totals = advance(body, 2e-3, settings);
    changed += totals.changed_element;
    EXPECT_LT(std::abs(totals.energy_reweighted), 1e-15);  // w = 1 before and after; round-off of other sums
  }
  EXPECT_GT(changed, 40);
}

}  // namespace
}  // namespace scarp::test
