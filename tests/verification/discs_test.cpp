// Colliding and turning discs: momenta and energy.
#include "discs.hpp"

#include <gtest/gtest.h>

#include <cstdio>

namespace scarp::verification {
namespace {

constexpr double pi = std::numbers::pi;

/// Lowest, highest and last energy of a run, parts of that at the start.
struct Energies {
  double low = 1, high = 1, end = 1;
};

Energies energies(const DiscRun& run) {
  Energies e;
  const double start = run.history.front().kinetic;
  for (const auto& at : run.history) {
    e.end = (at.kinetic + at.stored) / start;
    e.low = std::min(e.low, e.end);
    e.high = std::max(e.high, e.end);
  }
  return e;
}

class Discs : public testing::TestWithParam<GridFunctions> {};

TEST_P(Discs, CollisionKeepsMomentumAndFlipEnergy) {
  const auto flip = collide(20, {GetParam()});
  // Two discs of ρπR² that move at 0.1 √2.
  EXPECT_NEAR(flip.history.front().kinetic, disc_solid.rho * pi * disc_radius * disc_radius * 0.02, 1e-12);
  // Σ N_i = 1 and Σ ∇N_i = 0: internal forces sum to zero. Round-off of some 10³ sums in each of some 10² steps.
  EXPECT_LT(flip.momentum, 1e-13);
  // FLIP and the step in time make and lose nothing in the mean; the quadrature with the points does, as their order is
  // lost in the collision: 3 or 4 % with five points per element.
  const auto e = energies(flip);
  EXPECT_GT(e.low, 0.96);
  EXPECT_LT(e.high, 1.03);
  std::printf("colliding discs, %s, FLIP: momentum %.1e, energy %.4f to %.4f, %.4f at the end, kinetic %.4f\n",
              name_of(GetParam()).c_str(), flip.momentum, e.low, e.high, e.end,
              flip.history.back().kinetic / flip.history.front().kinetic);
}

TEST_P(Discs, PicTakesEnergyAndKeepsMomentum) {
  double before = 1.0;
  for (const double flip : {0.99, 0.9, 0.0}) {
    Method method{GetParam()};
    method.flip = flip;
    const auto run = collide(20, method);
    EXPECT_LT(run.momentum, 1e-13);
    const auto e = energies(run);
    // Each step takes about (1 − φ²) of what the mesh does not see: energy never grows by more than FLIP's own drift (1
    // %), and the more PIC, the less is left.
    EXPECT_LT(e.high, 1.01);
    EXPECT_LT(e.end, before);
    before = e.end;
    std::printf("colliding discs, %s, flip %.2f: energy at the end %.4f, kinetic %.4f\n", name_of(GetParam()).c_str(),
                flip, e.end, run.history.back().kinetic / run.history.front().kinetic);
  }
  EXPECT_LT(before, 0.7);  // pure PIC
}

/// Moment of inertia ½ ρπR⁴ times Ω.
constexpr double exact_spin = 0.5 * 1000 * pi * disc_radius * disc_radius * disc_radius * disc_radius * disc_spin;

TEST_P(Discs, TurningDiscKeepsItsAngularMomentumAsTheMeshIsRefined) {
  // L = Σ x_p × m_p v_p. Positions move with Σ N_i v_i where v_i = Σ m_p v_p N_i / m_i (eqs 7, 8), so that the motion
  // adds Σ_p m_p (Σ_i N_i v_i) × v_p dt = Σ_i m_i v_i × v_i dt = 0. Eq. 6 adds Σ_i c_i × f_i dt with c_i = Σ m_p x_p
  // N_i / m_i; the internal forces have no moment about the origin, Σ_i x_i × f_i = 0 (σ is symmetric and Σ x_i ∇N_i =
  // I). So dL = Σ_i (c_i − x_i) × f_i dt: what the lumped mass loses where a node's mass is not centred on it, at the
  // edge of the disc above all. It falls with the mesh: to half at least, where h is halved.
  double lost = 1;
  for (const int n : {20, 40}) {
    const auto run = turn_disc(n, {GetParam()});
    EXPECT_NEAR(run.history.front().angular_momentum, exact_spin, 1e-12 * exact_spin);
    EXPECT_LT(run.momentum, 1e-13);
    const double now = std::abs(run.history.back().angular_momentum / exact_spin - 1);
    EXPECT_LT(now, 0.5 * lost);
    lost = now;
    // Energy within what the collision keeps. The corrected quadrature adds some: the weights of points change as they
    // move, and what is stored comes back at another weight (1.04 with linear functions, n = 40; with eq. 4 as printed
    // nothing is gained). With velocities v^t + a dt in place of eq. 8 it would err by 7 to 21 %.
    const auto e = energies(run);
    EXPECT_GT(e.low, 0.97);
    EXPECT_LT(e.high, 1.05);
    std::printf("turning disc, %s, n = %d: angular momentum less %.2e after a turn, energy %.4f to %.4f\n",
                name_of(GetParam()).c_str(), n, now, e.low, e.high);
  }
}

TEST_P(Discs, MotionWithoutStressKeepsAngularMomentumToRoundOff) {
  // Of dL above only the motion is left where there are no forces, and that is zero to round-off as long as points move
  // with the functions that their momentum was mapped with.
  auto body = turning_disc(20, {GetParam()});
  for (auto& block : body.blocks) block.model = LinearElastic({1e-30, 0});
  for (int s = 0; s < 100; ++s) advance(body, 0.005, Method{GetParam()}.settings());
  const auto end = motions_of(body, disc_solid, {0.5, 0.5});
  EXPECT_NEAR(end.angular_momentum, exact_spin, 1e-13 * exact_spin);
}

INSTANTIATE_TEST_SUITE_P(Shapes, Discs, testing::ValuesIn(all_shapes), [](const auto& its) {
  std::string name = name_of(its.param);
  std::erase(name, '-');
  return name;
});

}  // namespace
}  // namespace scarp::verification
