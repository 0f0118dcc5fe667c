// Elastic energy of points. Oracle: ½ σ : ε Ω with the strain that Hooke's law has for a stress, component by
// component.
#include "scarp/exec/elastic_energy.hpp"

#include <gtest/gtest.h>

#include <array>
#include <random>
#include <vector>

namespace scarp::exec {
namespace {

constexpr double E = 2e4, nu = 0.27;

/// σ = λ tr ε I + 2 G ε of plain components xx, yy, zz, xy(, yz, zx).
template <std::size_t N>
std::array<double, N> hooke(const std::array<double, N>& eps) {
  const double lambda = E * nu / ((1 + nu) * (1 - 2 * nu)), G = E / (2 * (1 + nu));
  std::array<double, N> sigma;
  for (std::size_t i = 0; i < N; ++i) sigma[i] = 2 * G * eps[i] + (i < 3 ? lambda * (eps[0] + eps[1] + eps[2]) : 0);
  return sigma;
}

template <std::size_t N>
double density(const std::array<double, N>& sigma, const std::array<double, N>& eps) {
  double sum = 0;
  for (std::size_t i = 0; i < N; ++i) sum += (i < 3 ? 0.5 : 1.0) * sigma[i] * eps[i];  // xy and yx
  return sum;
}

template <int Dim>
void expect_energy_of_hooke() {
  constexpr std::size_t N = sym_size<Dim>;
  std::mt19937 random(2);
  std::uniform_real_distribution<double> u(-1e-3, 1e-3);
  Block<Dim> block("soil", LinearElastic({E, nu}));
  resize(block, 20);
  std::vector<double> expected;
  for (int i = 0; i < block.size(); ++i) {
    std::array<double, N> eps;
    for (double& component : eps) component = u(random);
    const auto sigma = hooke(eps);
    block.points.volume[i] = 0.1 + 0.01 * i;
    const auto mandel = to_mandel<static_cast<int>(N)>(sigma);
    for (std::size_t c = 0; c < N; ++c) block.points.sigma[c][i] = mandel[static_cast<int>(c)];
    expected.push_back(block.points.volume[i] * density(sigma, eps));
  }
  // Of some of the points, in any order.
  const std::vector<int> order{7, 3, 11, 0, 19};
  for (int count = 0; count <= 5; ++count) {
    double sum = 0;
    for (int k = 0; k < count; ++k) sum += expected[order[k]];
    EXPECT_NEAR(elastic_energy(block, {order.data(), count}), sum, 1e-12 * (sum + 1e-300)) << count;
  }
  const int one = 3;
  EXPECT_GT(elastic_energy(block, {&one, 1}), 0);
}

TEST(ElasticEnergy, IsThatOfHookesLaw) {
  expect_energy_of_hooke<2>();
  expect_energy_of_hooke<3>();
}

}  // namespace
}  // namespace scarp::exec
