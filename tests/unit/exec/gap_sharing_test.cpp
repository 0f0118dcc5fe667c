// Points of an element that share their openings. Oracles: the formula at the head of gap_sharing.hpp, worked out for
// two points by hand; volumes, of which none is made or lost.
#include "scarp/exec/gap_sharing.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

namespace scarp::exec {
namespace {

constexpr double E = 1e4, nu = 0.25, rho = 2, size = 0.5;
constexpr double M = E * (1 - nu) / ((1 + nu) * (1 - 2 * nu));

/// Two points of an element of 0.5 m: the first is open, without stress, the second carries 30 kPa all round.
struct Pair {
  explicit Pair(const std::string& model = "mohr-coulomb", double gap = 0.01)
      : block("sand",
              *make_model(model,
                          model == "linear-elastic"
                              ? std::map<std::string, double>{{"E", E}, {"nu", nu}}
                              : std::map<std::string, double>{{"E", E}, {"nu", nu}, {"c", 0}, {"phi", 30}, {"psi", 0}},
                          {})
                   .model) {
    resize(block, 2);
    strains.reserve(2);
    for (int p = 0; p < 2; ++p) {
      block.points.volume[p] = volume[p];
      block.points.mass[p] = rho * volume[p];
      for (int c = 0; c < 3; ++c) block.points.sigma[c][p] = p == 1 ? -30 : 0;  // tension positive
      strains.volume[p] = volume[p];
      strains.per_mass[p] = 1 / (rho * size * size);
      for (auto& column : strains.deps) column[p] = 0;
    }
    if (model != "linear-elastic") block.state.back()[0] = gap;  // the last of the columns
  }

  const std::vector<double> volume{0.06, 0.04};
  Block<2> block;
  Strains<2> strains;
  std::vector<int> order{0, 1};
};

TEST(GapSharing, PressuresEvenOutAsFastAsWavesRun) {
  const double c = std::sqrt(M / rho);
  for (const double dt : {1e-4, 1e-3, 1.0}) {
    for (const int directions : {2, 3}) {
      Pair pair;
      GapSharing<2> sharing(pair.block, pair.strains, directions, dt);
      ASSERT_TRUE(sharing.active());
      sharing.in_element({pair.order.data(), 2}, size, 0);
      const double mean = (0.06 * 0 + 0.04 * -30) / 0.1;
      const double theta = 0.5 * std::min(1.0, c * dt / size);
      const std::vector<double> delta{theta * (mean - 0) / M, theta * (mean + 30) / M};
      EXPECT_LT(delta[0], 0);  // the open one closes
      for (int p = 0; p < 2; ++p) {
        EXPECT_NEAR(pair.block.points.volume[p], pair.volume[p] * std::exp(delta[p]), 1e-16);
        EXPECT_NEAR(pair.strains.volume[p], pair.volume[p] * std::exp(0.5 * delta[p]), 1e-16);
        EXPECT_NEAR(pair.strains.per_mass[p], std::exp(delta[p]) / (rho * size * size), 1e-14);
        for (int j = 0; j < 4; ++j)
          EXPECT_NEAR(pair.strains.deps[j][p], j < directions ? delta[p] / directions : 0, 1e-18) << j;
      }
      // None is made or lost, to first order; it costs what the pressures do on it.
      EXPECT_NEAR(0.06 * delta[0] + 0.04 * delta[1], 0, 1e-18);
      EXPECT_NEAR(sharing.work(), pair.strains.volume[1] * -30 * delta[1], 1e-12 * std::abs(sharing.work()));
      EXPECT_LT(sharing.work(), 0);
    }
  }
}

TEST(GapSharing, RestsWhereNoneIsOpen) {
  Pair closed("mohr-coulomb", 0);
  GapSharing<2> sharing(closed.block, closed.strains, 2, 1e-3);
  sharing.in_element({closed.order.data(), 2}, size, 0);
  EXPECT_EQ(closed.block.points.volume[0], closed.volume[0]);
  EXPECT_EQ(closed.strains.deps[0][1], 0);
  EXPECT_EQ(sharing.work(), 0);
}

TEST(GapSharing, IsForLawsThatOpen) {
  Pair elastic("linear-elastic");
  EXPECT_FALSE(GapSharing<2>(elastic.block, elastic.strains, 2, 1e-3).active());
  Pair cone("drucker-prager");
  EXPECT_TRUE(GapSharing<2>(cone.block, cone.strains, 2, 1e-3).active());
}

// A point that has opened by the volume of its element, 0.25 m², opens no further, but closes.
TEST(GapSharing, OpensNoFurtherThanItsElement) {
  for (const double strain : {1e-3, -1e-3}) {
    Pair pair("mohr-coulomb", 2.0);
    for (int p = 0; p < 2; ++p)
      for (int c = 0; c < 3; ++c) pair.block.points.sigma[c][p] = 0;  // nothing to share
    pair.block.points.volume[0] = 0.4;                                // 0.35 of it opened: 1 − exp(−2) = 0.865
    pair.strains.deps[0][0] = strain;
    GapSharing<2> sharing(pair.block, pair.strains, 2, 1e-3);
    sharing.in_element({pair.order.data(), 2}, size, 0);
    EXPECT_NEAR(pair.strains.deps[0][0] + pair.strains.deps[1][0], strain > 0 ? 0 : strain, 1e-18);
    EXPECT_NEAR(pair.block.points.volume[0], strain > 0 ? 0.4 * std::exp(-strain) : 0.4, 1e-15);
  }
}

}  // namespace
}  // namespace scarp::exec
