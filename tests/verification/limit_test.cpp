// The limit of the time step with local damping.
#include <gtest/gtest.h>

#include "roughness.hpp"

namespace scarp::verification {
namespace {

/// Kinetic energy of a slope after 1000 steps of this length with local damping α; infinite where points get lost.
double left_over(double dt, const Scheme& scheme, double alpha) {
  auto body = soft_slope(Cells::grid, 0.5, 0.37, 0.3);
  for (auto& column : body.blocks()[0].points.sigma) std::fill(column.begin(), column.end(), 0.0);
  StepSettings settings;
  settings.scheme = scheme;
  settings.damping = alpha;
  double kinetic = 0;
  try {
    for (int s = 0; s < 1000; ++s) kinetic = advance(body, dt, settings).kinetic_energy;
  } catch (const std::exception&) {
    return std::numeric_limits<double>::infinity();
  }
  return kinetic;
}

TEST(Limit, CountsLocalDamping) {
  // Local damping makes the force that slows a node 1 + α times as large, and with it ω²: dt ≤ k h/c / √(1 + α). With P
  // before the motion there is no room for that (scheme.hpp: waves). Energies come to less than 1e-3 kJ/m from 10 at
  // the start; without the √ the slope is thrown out of the mesh.
  auto body = soft_slope(Cells::grid, 0.5, 0.37, 0.3);
  for (const double alpha : {0.5, 0.7, 0.9}) {
    for (const Scheme& scheme : {undamped(two_term_scheme()), two_term_scheme()}) {
      const double limit = critical_time_step(body, scheme, alpha);
      EXPECT_LT(left_over(0.8 * limit, scheme, alpha), 1e-3) << "local damping " << alpha;
      EXPECT_DOUBLE_EQ(critical_time_step(body, report_scheme(), alpha), critical_time_step(body, report_scheme()));
    }
    const Scheme scheme = undamped(two_term_scheme());
    EXPECT_NEAR(critical_time_step(body, scheme) / critical_time_step(body, scheme, alpha), std::sqrt(1 + alpha), 1e-9);
  }
  const Scheme scheme = undamped(two_term_scheme());
  EXPECT_GT(left_over(0.8 * critical_time_step(body, scheme), scheme, 0.9), 1);
}

}  // namespace
}  // namespace scarp::verification
