// Averages over an internal length on every kind of mesh: uniform stays uniform, a spike spreads as the kernel says.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "step/soils.hpp"

namespace scarp::test {
namespace {

constexpr std::array plane_kinds{Background::grid,  Background::gimp,      Background::b_spline,
                                 Background::quads, Background::triangles, Background::mixed};
constexpr std::array solid_kinds{Background::grid, Background::quads, Background::triangles, Background::mixed};

template <int Dim>
Mesh<Dim> mesh_of(Background kind, int n) {
  if constexpr (Dim == 2) {
    return plane_mesh(kind, n);
  } else {
    return solid_mesh(kind, n);
  }
}

/// Bonded soil in all of the unit square or cube at rest, two points along each edge of a grid's cells.
template <int Dim>
Body<Dim> filled(Mesh<Dim> mesh, int n, double length) {
  Body<Dim> body(std::make_unique<const Mesh<Dim>>(std::move(mesh)), {});
  Block<Dim> block("soil", subloading(), length);
  resize(block, static_cast<int>(std::lround(std::pow(2 * n, Dim))));
  for (int i = 0; i < block.size(); ++i) {
    int rest = i;
    for (int j = 0; j < Dim; ++j) {
      block.points.x[j][i] = (rest % (2 * n) + 0.5) / (2 * n);
      rest /= 2 * n;
    }
    block.points.volume[i] = block.points.initial_volume[i] = std::pow(2 * n, -Dim);
    block.points.mass[i] = block.points.volume[i];
    block.points.id[i] = i;
  }
  body.fields[0].blocks.push_back(std::move(block));
  locate_points(body);
  return body;
}

template <int Dim>
Column& kappa_of(Body<Dim>& body) {
  return body.blocks()[0].state.end()[-3];
}

/// κ̄ of every point, from dκ̂/dt = ((1 − m) κ + m κ̄ − κ̂) / time with κ̂ far below, so that the growth is positive.
/// κ ≤ κ_c.
template <int Dim>
Column averages_of(Body<Dim>& body) {
  constexpr double low = -1, time = 1;
  auto& state = body.blocks()[0].state;
  Column &kappa_hat = state.end()[-2], &rate = state.end()[-1];
  std::fill(kappa_hat.begin(), kappa_hat.end(), low);
  body.fields[0].averages.every = 1;
  step::average_softening(body, time);
  Column average(rate.size());
  for (std::size_t i = 0; i < rate.size(); ++i) average[i] = (rate[i] * time + low + kappa_of(body)[i]) / 2;
  return average;
}

template <int Dim>
void expect_uniform_stays(Background kind, int n, int along, double length) {
  SCOPED_TRACE(static_cast<int>(kind));
  auto body = soil<Dim>(mesh_of<Dim>(kind, n), subloading(), along, 0, length);
  auto& kappa = kappa_of(body);
  std::fill(kappa.begin(), kappa.end(), 0.07);
  for (const double average : averages_of(body)) ASSERT_NEAR(average, 0.07, 1e-14);
}

TEST(AverageOverALength, LeavesAUniformFieldToRoundOff) {
  // Points of unequal volume in random places of part of the mesh.
  for (const auto kind : plane_kinds) expect_uniform_stays<2>(kind, 24, 36, 0.13);
  for (const auto kind : solid_kinds) expect_uniform_stays<3>(kind, 8, 12, 0.3);
}

struct Spread {
  double variance = 0, total = 0;  ///< along an axis [m²], and Σ κ̄ Ω / κ Ω
};

/// Of spikes at some points in the middle, one after the other, mean.
template <int Dim>
Spread spread(Background kind, int n, double length) {
  auto body = filled<Dim>(mesh_of<Dim>(kind, n), n, length);
  const auto& points = body.blocks()[0].points;
  Spread mean;
  int spikes = 0;
  for (int p = 0; p < points.size(); ++p) {
    const auto at = position_of(points, p);
    bool inside = points.id[p] % 3 == 0;
    for (const double x : at) inside = inside && std::abs(x - 0.5) < (Dim == 2 ? 1.5 : 0.6) / n;
    if (!inside) continue;
    ++spikes;
    auto& kappa = kappa_of(body);
    std::fill(kappa.begin(), kappa.end(), 0.0);
    kappa[static_cast<std::size_t>(p)] = 0.1;
    const auto average = averages_of(body);
    double sum = 0, second = 0;
    for (int i = 0; i < points.size(); ++i) {
      sum += average[i];
      const auto x = position_of(points, i);
      for (int d = 0; d < Dim; ++d) second += average[i] * (x[d] - at[d]) * (x[d] - at[d]) / Dim;
    }
    mean.variance += second / sum;
    mean.total += sum / 0.1;
  }
  EXPECT_GE(spikes, 2);
  return {mean.variance / spikes, mean.total / spikes};
}

/// The kernel exp(−r²/ℓ²) has the variance ℓ²/2 along an axis. Without the correction for the functions' own variance
/// it would be h²/3 more: 4 % at ℓ = 4h, 15 % at 2.1h. On these grids points are at quarters of the cells, where the
/// functions' variance is 3/16 h² instead of the mean h²/6, there and back.
template <int Dim>
void expect_variance(Background kind, int n, double length, double within) {
  const auto s = spread<Dim>(kind, n, length);
  const double h = 1.0 / n, expected = length * length / 2 + (is_grid(kind) ? 2 * (3.0 / 16 - 1.0 / 6) * h * h : 0.0);
  EXPECT_NEAR(s.variance / expected, 1, within) << static_cast<int>(kind) << ", ℓ/h = " << length * n;
  EXPECT_NEAR(s.total, 1, within) << static_cast<int>(kind);
  std::printf("%dD, mesh %d, ℓ = %.1f h: variance %.4f of that expected, total %.4f\n", Dim, static_cast<int>(kind),
              length * n, s.variance / expected, s.total);
}

TEST(AverageOverALength, SpreadsASpikeByItsVarianceInThePlane) {
  for (const auto kind : plane_kinds) {
    // On a grid the kernel ends at 2.5 ℓ (0.5 % less). Irregular elements have variances of their own places.
    const double within = is_grid(kind) ? 0.01 : 0.03;
    expect_variance<2>(kind, 30, 4.0 / 30, within);
    expect_variance<2>(kind, 30, 2.1 / 30, within);
  }
}
TEST(AverageOverALength, SpreadsASpikeByItsVarianceInSpace) {
  for (const auto kind : solid_kinds) expect_variance<3>(kind, 14, 2.1 / 14, is_grid(kind) ? 0.01 : 0.03);
}

}  // namespace
}  // namespace scarp::test
