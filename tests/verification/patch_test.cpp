// Uniform stress carried through the mesh, and rigid rotation of a stressed body.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "../step/soils.hpp"
#include "body_maker.hpp"
#include "scarp/transfer/nodes_to_points.hpp"

namespace scarp::verification {
namespace {

constexpr double sigma_0 = -1.0;  // of a stiffness of 100

/// The bar of stress_noise(): its elements along itself and of what runs ahead of the waves in a mesh, its points
/// across.
struct Bar {
  GridFunctions functions = GridFunctions::linear;
  int length = 60, ahead = 12, points_across = 4;
};

/// A long bar of uniform stress between smooth walls, moving along itself through `cells` elements; returns the largest
/// change of σ_xx over |σ_0| among points that no wave from the free ends has reached.
double stress_noise(double cells, double points_per_cell, QuadratureRule quadrature, const Bar& its = {}) {
  constexpr double E = 100, v = 5;  // wave speed 10, elements of 1
  const double length = its.length;
  auto body = on_grid({0, 0}, {length + 20, 2}, {its.length + 20, 2}, {0, 0}, its.functions);
  auto& bar = add_box(body, linear_elastic(E, 0.0), 1.0, {4, 0}, {4 + length, 2},
                      {static_cast<int>(length * points_per_cell), its.points_across});
  for (int p = 0; p < bar.size(); ++p) {
    bar.points.v[0][p] = v;
    bar.points.sigma[0][p] = sigma_0;
    bar.points.x[0][p] += 1e-3;  // off the symmetric places, where all would cross at once
  }
  locate_points(body);
  for (const char* side : {"bottom", "top"}) fix(body.conditions, body.mesh->node_sets.at(side), 1);
  const double end = cells / v;
  run_until(body, end, 0.3, {.quadrature = quadrature, .integration = {}}, [](double, const StepTotals<2>&) {});
  const double reached = 10 * end + its.ahead;  // elements that the waves may have come to
  double worst = 0;
  const auto& points = body.blocks()[0].points;
  for (int p = 0; p < points.size(); ++p) {
    const double place = points.x[0][p] - points.u(0, p) - 4;
    if (place < reached || place > length - reached) continue;
    worst = std::max(worst, std::abs(points.sigma[0][p] - sigma_0));
  }
  return worst / std::abs(sigma_0);
}

TEST(Patch, UniformStressStaysUniformWithinElements) {
  // Oracle: a uniform stress has no internal force at inner nodes, so nothing changes; round-off of 10² steps.
  EXPECT_LT(stress_noise(0.2, 2, QuadratureRule::points), 1e-12);
  EXPECT_LT(stress_noise(0.2, 2, QuadratureRule::corrected), 1e-12);
}

TEST(Patch, UniformStressAcrossElementsHasTheKnownCrossingNoise) {
  // Linear shape functions: a node feels σ (Ω_left − Ω_right)/h of the soil in the elements beside it. With two points
  // per element all cross together and the sums stay equal; with two and a half the number alternates between 2 and 3,
  // and the force at a node jumps by σ/2.5. Reported, and bounded by the stress itself.
  const double even = stress_noise(4, 2, QuadratureRule::points), uneven = stress_noise(4, 2.5, QuadratureRule::points);
  EXPECT_LT(even, 1e-6);
  EXPECT_LT(uneven, 1.0);
  EXPECT_GT(uneven, 1e-3);  // if it vanished, the shape functions would not be linear
  std::printf("crossing noise over 4 elements: %.2e (2 points per element), %.2e (2.5)\n", even, uneven);
}

TEST(Patch, CorrectedQuadratureCarriesUniformStressAcrossElementsWithAnyNumberOfPoints) {
  // Oracle: uniform stress has no internal force at nodes inside, wherever the points are. What is left comes from the
  // free ends, ahead of the waves (1e-7); eq. 4 as printed leaves 0.1 with two and a half points per element.
  for (const double points_per_cell : {2.0, 2.5, 3.3}) {
    const double noise = stress_noise(4, points_per_cell, QuadratureRule::corrected);
    EXPECT_LT(noise, 1e-6) << points_per_cell;
    std::printf("corrected quadrature, crossing noise over 4 elements: %.2e (%g points per element)\n", noise,
                points_per_cell);
  }
}

/// A bar long enough for what runs ahead of the waves to fade to nothing (a factor of some 4 per element), with points
/// in squares, whose domains are a partition of it.
double smooth_stress_noise(GridFunctions functions, double points_per_cell, QuadratureRule quadrature) {
  const double noise = stress_noise(
      4, points_per_cell, quadrature,
      {.functions = functions, .length = 140, .ahead = 55, .points_across = static_cast<int>(2 * points_per_cell)});
  std::printf("%s, %s, crossing noise over 4 elements: %.2e (%g points per element)\n",
              functions == GridFunctions::gimp ? "GIMP" : "B-splines",
              quadrature == QuadratureRule::points ? "points" : "corrected", noise, points_per_cell);
  return noise;
}

TEST(Patch, GimpCarriesUniformStressAcrossElements) {
  // Oracle: where domains are a partition of the soil, Σ Ω_p S_i' = ∫ N_i' = 0 at nodes inside. Round-off of 10³ steps.
  for (const double points_per_cell : {2.0, 2.5, 3.0, 3.5}) {
    EXPECT_LT(smooth_stress_noise(GridFunctions::gimp, points_per_cell, QuadratureRule::corrected), 1e-11);
  }
}

TEST(Patch, BSplinesCarryUniformStressAcrossElements) {
  // Oracle: a whole number of evenly spaced points per element integrates the hats that N_i' is made of exactly,
  // wherever they are; the corrected quadrature does it for any number. Round-off of 10³ steps.
  for (const double points_per_cell : {2.0, 2.5, 3.0, 3.5}) {
    EXPECT_LT(smooth_stress_noise(GridFunctions::b_spline, points_per_cell, QuadratureRule::corrected), 1e-11);
  }
  for (const double points_per_cell : {2.0, 3.0}) {
    EXPECT_LT(smooth_stress_noise(GridFunctions::b_spline, points_per_cell, QuadratureRule::points), 1e-11);
  }
  // Eq. 4 as printed: the hats have a part of (sin(2.5 π)/(2.5 π))² = 1.6 % at the frequency of these points.
  const double uneven = smooth_stress_noise(GridFunctions::b_spline, 2.5, QuadratureRule::points);
  EXPECT_GT(uneven, 1e-4);
  EXPECT_LT(uneven, 0.05);
}

/// The four components of Q A Qᵀ for a turn by `angle`, anticlockwise, by the plain formula.
std::array<double, 4> turned(const std::array<double, 4>& a, double angle) {
  const double c = std::cos(angle), s = std::sin(angle), xy = a[3] / sqrt2;
  return {c * c * a[0] + s * s * a[1] - 2 * c * s * xy, s * s * a[0] + c * c * a[1] + 2 * c * s * xy, a[2],
          sqrt2 * (c * s * (a[0] - a[1]) + (c * c - s * s) * xy)};
}

TEST(RigidRotation, TurnsStressBetaAndCentreWithTheBody) {
  // Nodes move with v = ω × x exactly; steps 6 to 10 and 7 then see pure spin.
  const auto model = test::subloading();
  auto body = on_grid({-1, -1}, {1, 1}, {2, 2}, {0, 0});
  auto& block = add_box(body, model, 1.8, {-0.8, -0.8}, {0.8, 0.8}, {4, 4});
  const std::array<double, 4> sigma{-60, -100, -70, 20 * sqrt2}, beta{-0.1, 0.25, -0.15, 0.05 * sqrt2},
      a{30, 50, 35, -10 * sqrt2};
  for (int p = 0; p < block.size(); ++p) {
    for (int c = 0; c < 4; ++c) {
      block.points.sigma[c][p] = sigma[c];
      block.state[c][p] = beta[c];
      block.state[4 + c][p] = a[c];
    }
    block.state[12][p] = 250;  // p_c
    block.state[13][p] = 2;    // R_b
  }
  locate_points(body);
  constexpr int steps = 100;
  const double angle = std::numbers::pi / 2,
               w = 2 * std::tan(angle / steps / 2);  // exact turn per step by Hughes–Winget
  PointIncrements<2> increments;
  increments.reserve(block.size());
  for (int s = 0; s < steps; ++s) {
    // ω dt = w: L dt = [[0, −w], [w, 0]], from nodal displacements through step 6.
    transfer::MotionSums<2> sums;
    constexpr double no_correction[8] = {};
    for (int slot = 0; slot < body.fields[0].active.size(); ++slot) {
      const int e = body.fields[0].active.element[slot];
      const auto x_i = node_positions<Q4>(*body.mesh, e);
      std::array<transfer::Motion<2>, 4> motion;
      transfer::ElementMotion<GridLinear<2>> element{{}, no_correction, 1, body.mesh->size_of(e)};
      for (int i = 0; i < 4; ++i) {
        motion[i].du(0) = -w * x_i[i][1];
        motion[i].du(1) = w * x_i[i][0];
        element.motion[i] = motion[i].row.data();
      }
      transfer::nodes_to_points<false, GridLinear<2>>(
          GridLinear<2>::Cell(*body.mesh, e), element, {}, {}, block.points,
          {block.order.data() + block.begin[slot], block.begin[slot + 1] - block.begin[slot]}, increments,
          block.begin[slot], std::false_type{}, sums, [](const auto&...) {});
    }
    exec::StressTotals totals;
    exec::update_stresses(block, {block.order.data(), block.size()}, increments, 0, 1.0, {}, totals);
  }
  const auto sigma_exact = turned(sigma, angle), beta_exact = turned(beta, angle), a_exact = turned(a, angle);
  for (int p = 0; p < block.size(); ++p) {
    for (int c = 0; c < 4; ++c) {
      // Round-off of a hundred rotations; the strain of nodes that move on tangents is round-off of L too.
      EXPECT_NEAR(block.points.sigma[c][p], sigma_exact[c], 1e-11);
      EXPECT_NEAR(block.state[c][p], beta_exact[c], 1e-13);
      EXPECT_NEAR(block.state[4 + c][p], a_exact[c], 1e-11);
    }
    EXPECT_NEAR(block.state[12][p], 250, 1e-10);
    EXPECT_NEAR(block.state[13][p], 2, 1e-12);
  }
}

}  // namespace
}  // namespace scarp::verification
