#include "scarp/material/willam_warnke.hpp"

#include <gtest/gtest.h>
#include <cmath>
#include <numbers>

#include "material/lanes.hpp"
#include "material/plain_law.hpp"

namespace scarp::test {
namespace {

TEST(ThirdAngle, IsTheCosineOfAThirdOfTheAngle) {
  for (int i = -1000; i <= 1000; ++i) {
    const double cos3 = i / 1000.0;
    const long double exact = std::cos(std::numbers::pi_v<long double> / 3 - std::acos((long double)cos3) / 3);
    EXPECT_NEAR(cos_third_angle(cos3), static_cast<double>(exact), 5e-16) << cos3;
  }
}

TEST(WillamWarnke, IsOneInCompressionAndKInExtension) {
  for (double k : {0.51, 0.6, 0.75, 0.9, 1.0}) {
    EXPECT_NEAR(willam_warnke(1.0, k), 1, 1e-14);
    EXPECT_NEAR(willam_warnke(-1.0, k), k, 1e-14);
  }
}

// Near k = ½ the root of the numerator is nearly 0 at θ = 0 and its rounding shows: 1e-13 from k = 0.55 on.
TEST(WillamWarnke, IsThePrintedFormula) {
  for (double k : {0.55, 0.6, 0.75, 0.9, 1.0}) {
    for (int i = 0; i <= 600; ++i) {
      const double theta = std::numbers::pi / 3 * i / 600;
      EXPECT_NEAR(willam_warnke(std::cos(3 * theta), k), plain_willam_warnke(theta, k), 1e-13) << k << ' ' << theta;
    }
  }
}

TEST(WillamWarnke, BatchGivesWhatDoubleGives) {
  for (double start = -1; start < 1; start += 0.11) {
    std::array<double, batch_lanes> cos3;
    for (std::size_t i = 0; i < batch_lanes; ++i) cos3[i] = std::min(1.0, start + 0.02 * static_cast<double>(i));
    const Batch h = willam_warnke(pack(cos3), 0.7);
    for (std::size_t i = 0; i < batch_lanes; ++i) EXPECT_NEAR(lane(h, i), willam_warnke(cos3[i], 0.7), 1e-14);
  }
}

// What η_β,cs is for: with β aligned with s and of that ratio, at q/p = M_cs on the yield surface (ξ = 0), the
// plastic potential has no volumetric gradient. ∂g/∂p by central differences.
TEST(AnisotropicLimit, MakesTheCriticalStateIsochoric) {
  for (double alpha : {0.7, 0.9, 1.0, 1.2, std::sqrt(2.0), 1.6}) {
    Subloading::Parameters c{};
    c.M = 0.8;
    c.alpha = alpha;
    const Subloading model(c);
    const double M_cs = 1.1, eta = model.eta_beta_cs(M_cs);
    ASSERT_GT(eta, 0);
    auto along = [](double ratio, double p) {
      return Matrix{{{p - ratio / 3, 0, 0}, {0, p - ratio / 3, 0}, {0, 0, p + ratio * 2 / 3}}};
    };
    const Matrix beta = along(eta, 0);
    const double p_c = 1 + (M_cs - eta) * (M_cs - eta) / (c.M * c.M);
    EXPECT_NEAR(yield_function(c, along(M_cs, 1), beta, p_c), 0, 1e-14);
    const double step = 1e-4;  // g is quadratic: central differences are exact up to rounding
    const double slope = (yield_function(c, along(M_cs, 1 + step), beta, p_c, alpha) -
                          yield_function(c, along(M_cs, 1 - step), beta, p_c, alpha)) /
                         (2 * step);
    EXPECT_NEAR(slope, 0, 1e-11) << alpha;
  }
}

TEST(AnisotropicLimit, OfAssociatedFlow) {
  Subloading::Parameters c{};
  c.M = 0.8;
  c.alpha = 1;
  EXPECT_NEAR(Subloading(c).eta_beta_cs(1.0), 0.6, 1e-15);  // √(M_cs² − M²)
  EXPECT_EQ(Subloading(c).eta_beta_cs(0.7), 0);             // clamped
}

}  // namespace
}  // namespace scarp::test
