// The ten reference curves of an independent program (reference/README.md), replayed under strain control.
#include "reference.hpp"

#include <gtest/gtest.h>
#include <cmath>
#include <cstdio>

#include "lanes.hpp"
#include "samples.hpp"
#include "scarp/material/integrate/embedded.hpp"

namespace scarp::test {
namespace {

/// Largest differences over a curve, each relative to the range of its own component over the curve (a component that
/// stays zero: absolute).
struct Differences {
  std::array<double, 27> largest{}, low, high;
  Differences() {
    low.fill(1e300);
    high.fill(-1e300);
  }
  void add(const SubloadingState& found, const SubloadingState& expected) {
    std::size_t i = 0;
    for_each_component(
        [&](const double& x, const double& y) {
          largest[i] = std::max(largest[i], std::abs(x - y));
          low[i] = std::min(low[i], y);
          high[i] = std::max(high[i], y);
          ++i;
        },
        found, expected);
  }
  double relative(std::size_t first, std::size_t count) const {
    double r = 0;
    for (std::size_t i = first; i < first + count; ++i) {
      const double range = high[i] - low[i];
      r = std::max(r, range > 1e-9 ? largest[i] / range : largest[i]);
    }
    return r;
  }
  double all() const { return relative(0, 27); }
};

class ReferenceCurve : public testing::TestWithParam<std::string> {};

template <class Pair>
Differences replay(const Reference& reference, double tolerance, double R_tolerance) {
  const auto model = subloading(reference.constants);
  auto s = reference.initial;
  EXPECT_NEAR(model.homothety(s).R, reference.R, 1e-10);
  Differences differences;
  double R_error = 0;
  for (std::size_t i = 1; i < reference.replay.size(); ++i) {
    const auto& point = reference.replay[i];
    const auto report = integrate<Pair>(model, s, point.eps - reference.replay[i - 1].eps, {tolerance, 1e-9});
    if (report.end != IntegrationEnd::done) {
      ADD_FAILURE() << reference.name << " stops at point " << i;
      return differences;
    }
    EXPECT_FALSE(report.flags.corrected);
    differences.add(s, point.state);
    R_error = std::max(R_error, std::abs(model.homothety(s).R - point.R));
  }
  std::printf("  tolerance %.0e: sigma %.1e beta %.1e a %.1e epsp %.1e p_c %.1e R_b %.1e of their ranges, R %.1e\n",
              tolerance, differences.relative(0, 6), differences.relative(6, 6), differences.relative(12, 6),
              differences.relative(18, 6), differences.relative(24, 1), differences.relative(25, 1), R_error);
  EXPECT_LT(R_error, R_tolerance);
  return differences;
}

// The goal is 1e-3 of the range. Found: 3e-6 or less, but for components that hardly move (σ_zz of drained simple
// shear, held constant but for the chords, 1e-4 of its small range; β under cyclic stress, 2.5e-5).
TEST_P(ReferenceCurve, ModifiedEuler) {
  const auto differences = replay<ModifiedEuler>(read_reference(GetParam()), 1e-6, 2e-6);
  EXPECT_LT(differences.all(), GetParam() == "16_full_drn_dss" ? 2e-4 : 4e-5);
}

// What is left at 1e-9 are the changes between elastic and plastic inside a substep, and the files' 11 digits.
TEST_P(ReferenceCurve, DormandPrince) {
  EXPECT_LT(replay<DormandPrince>(read_reference(GetParam()), 1e-9, 2e-7).all(), 3e-6);
}

// The path of the material point method: increments of at most 1e-4 in one attempt each, in SIMD lanes. Every lane
// gives what double gives; rounding is amplified along the curve where it softens.
TEST_P(ReferenceCurve, InBatches) {
  const auto reference = read_reference(GetParam());
  const auto model = subloading(reference.constants);
  auto s = reference.initial;
  Subloading::State<Batch, 6> lanes;
  for_each_component([](auto& x, const double& y) { x = Batch(y); }, lanes, s);
  for (std::size_t i = 1; i < reference.replay.size(); ++i) {
    const auto step = reference.replay[i].eps - reference.replay[i - 1].eps;
    const int n = 1 + static_cast<int>(norm(step) / 1e-4);
    const auto part = (1.0 / n) * step;
    Sym<Batch, 6> parts;
    for (int c = 0; c < 6; ++c) parts[c] = Batch(part[c]);
    for (int k = 0; k < n; ++k) {
      s = attempt<ModifiedEuler>(model, s, part, 1e-4).state;
      lanes = attempt<ModifiedEuler>(model, lanes, parts, 1e-4).state;
    }
    for (std::size_t l = 0; l < batch_lanes; ++l) {
      ASSERT_LT(norm(lane(lanes.sigma, l) - s.sigma), 1e-12 * norm(s.sigma)) << "point " << i;
      ASSERT_NEAR(lane(lanes.p_c, l), s.p_c, 1e-12 * s.p_c);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, ReferenceCurve, testing::ValuesIn(reference_names()),
                         [](const auto& one) { return "curve_" + one.param; });

}  // namespace
}  // namespace scarp::test
