// The return to the yield surface of the linear-elastic, plastic laws, against slow twins that know nothing of regions:
// all planes of the surface at once, and the flow rule by finite differences.
#include <gtest/gtest.h>
#include <algorithm>
#include <cmath>

#include "material/lanes.hpp"
#include "material/samples.hpp"
#include "scarp/material/integrate/embedded.hpp"

namespace scarp::test {
namespace {

using Principal = std::array<double, 3>;
using Constants = std::map<std::string, double>;

template <class Model>
Model law(const Constants& constants) {
  return std::get<Model>(made(Model::description().name, constants));
}

double dot3(const Principal& a, const Principal& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

/// n : σ ≤ limit, with flow along r.
struct Plane {
  Principal n, r;
  double limit;
};

/// The six planes of Mohr and Coulomb for principal stresses in any order, and the three of the cut-off.
std::vector<Plane> planes(double c, double phi, double psi, double tension) {
  const double s = std::sin(phi), v = std::sin(psi);
  std::vector<Plane> all;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j) {
      if (i == j) continue;
      Plane p{{0, 0, 0}, {0, 0, 0}, 2 * c * std::cos(phi)};
      p.n[i] = 1 - s;
      p.n[j] = -1 - s;
      p.r[i] = 1 - v;
      p.r[j] = -1 - v;
      all.push_back(p);
    }
    Plane cut{{0, 0, 0}, {0, 0, 0}, tension};
    cut.n[i] = cut.r[i] = -1;
    all.push_back(cut);
  }
  return all;
}

/// Koiter's conditions by relaxation (Hildreth 1957 where r = n: the closest point in the energy norm): every plane in
/// turn takes what flow it needs, or gives back what it does not.
Principal relaxed(Principal s, const std::vector<Plane>& all, double K, double G) {
  const double lame = K - 2 * G / 3;
  std::vector<double> amount(all.size(), 0.0);
  for (int sweep = 0; sweep < 200000; ++sweep) {
    double change = 0;
    for (std::size_t k = 0; k < all.size(); ++k) {
      const auto& p = all[k];
      const double tr = p.r[0] + p.r[1] + p.r[2];
      const Principal Dr{lame * tr + 2 * G * p.r[0], lame * tr + 2 * G * p.r[1], lame * tr + 2 * G * p.r[2]};
      const double next = std::max(0.0, amount[k] + (dot3(p.n, s) - p.limit) / dot3(p.n, Dr));
      for (std::size_t i = 0; i < 3; ++i) s[i] -= (next - amount[k]) * Dr[i];
      change = std::max(change, std::abs(next - amount[k]) * G);
      amount[k] = next;
    }
    if (change < 1e-13) return s;
  }
  ADD_FAILURE() << "the twin did not converge";
  return s;
}

Principal values(const Sym<double, 6>& sigma) {
  return spectral(sigma).value;
}

/// One return of a random trial stress of Mohr and Coulomb, tension and all; counts how often an apex or edge is met.
void expect_relaxed(double c, double phi, double psi, double tension, double nu) {
  const auto model =
      law<MohrCoulomb>({{"E", 2e4}, {"nu", nu}, {"c", c}, {"phi", phi}, {"psi", psi}, {"tension", tension}});
  const double degree = std::acos(-1.0) / 180;
  const double apex = phi > 0 ? c / std::tan(phi * degree) : 1e30;
  const auto all = planes(c, phi * degree, psi * degree, std::min(tension, apex));
  std::mt19937 generator(21);
  for (int i = 0; i < 400; ++i) {
    MohrCoulomb::State<double, 6> s{};
    s.sigma = random_tensor<6>(generator, 60) + isotropic<double, 6>(i % 2 ? 60 : 0);
    const Principal trial = values(s.sigma);
    const auto on = elastoplastic::returned(model, s, Sym<double, 6>::zero());
    const Principal fast = values(on.state.sigma);
    const Principal slow = relaxed(trial, all, model.elasticity().K, model.elasticity().G);
    for (std::size_t k = 0; k < 3; ++k) {
      // The twin stops at changes of 1e-13, and converges in a straight line: some hundred times that.
      ASSERT_NEAR(fast[k], slow[k], 1e-8) << "c " << c << " phi " << phi << " psi " << psi << " t " << tension
                                          << " trial " << trial[0] << " " << trial[1] << " " << trial[2];
    }
    // Elastic and plastic strain add up to the trial's.
    const auto back = s.sigma - on.state.sigma;
    EXPECT_LT(norm(model.elasticity().stress(on.state.epsp) - back), 1e-11);
  }
}

TEST(PlasticReturn, AssociatedFlowFindsTheClosestPoint) {
  for (double nu : {0.0, 0.3, 0.49}) {
    expect_relaxed(10, 30, 30, 1e30, nu);
    expect_relaxed(10, 30, 30, 3, nu);
    expect_relaxed(10, 30, 30, 0, nu);
    expect_relaxed(0, 40, 40, 0, nu);
    expect_relaxed(10, 0, 0, 1e30, nu);
    expect_relaxed(10, 0, 0, 2, nu);
  }
}

TEST(PlasticReturn, NonAssociatedFlowMeetsKoitersConditions) {
  for (double nu : {0.0, 0.3, 0.49}) {
    expect_relaxed(10, 30, 0, 1e30, nu);
    expect_relaxed(10, 30, 10, 4, nu);
    expect_relaxed(5, 45, 0, 0, nu);
    expect_relaxed(0, 35, 5, 0, nu);
  }
}

TEST(PlasticReturn, TrescaIsMohrCoulombWithoutFriction) {
  const auto tresca = law<Tresca>({{"E", 2e4}, {"nu", 0.45}, {"s_u", 12}});
  const auto all = planes(12, 0, 0, 1e30);
  std::mt19937 generator(22);
  for (int i = 0; i < 500; ++i) {
    PlasticState<double, 6> s{};
    s.sigma = random_tensor<6>(generator, 60);
    if (i % 5 == 0) s.sigma = isotropic<double, 6>(50) + (1.0 * (i % 3 - 1)) * Sym<double, 6>{{30, 30, -60, 0, 0, 0}};
    const auto slow = relaxed(values(s.sigma), all, tresca.elasticity().K, tresca.elasticity().G);
    const auto fast = values(elastoplastic::returned(tresca, s, Sym<double, 6>::zero()).state.sigma);
    for (std::size_t k = 0; k < 3; ++k) ASSERT_NEAR(fast[k], slow[k], 1e-8);
  }
}

/// The plastic strain is along ∂g/∂σ at the returned stress; g by central differences.
template <class Potential>
void expect_normal(const PlasticState<double, 6>& s, Potential&& g) {
  Sym<double, 6> gradient;
  for (int i = 0; i < 6; ++i) {
    auto up = s.sigma, down = s.sigma;
    up[i] += 1e-4;
    down[i] -= 1e-4;
    gradient[i] = (g(up) - g(down)) / 2e-4;
  }
  const double along = dot(gradient, s.epsp) / dot(gradient, gradient);
  EXPECT_GE(along, 0);
  EXPECT_LT(norm(s.epsp - along * gradient),
            1e-7 * norm(s.epsp));  // h² = 1e-8 of the curvature, over some stress of 10
}

TEST(PlasticReturn, ConesFlowAlongTheirPotential) {
  const auto clay = law<VonMises>({{"E", 2e4}, {"nu", 0.3}, {"s_u", 10}});
  const auto sand = law<DruckerPrager>({{"E", 2e4}, {"nu", 0.3}, {"c", 4}, {"phi", 30}, {"psi", 10}});
  const double s = 0.5, v = std::sin(std::acos(-1.0) / 18);
  const double M = 6 * s / (3 - s), k = 6 * 4 * std::sqrt(0.75) / (3 - s), M_psi = 6 * v / (3 - v);
  std::mt19937 generator(23);
  int apex = 0;
  for (int i = 0; i < 1000; ++i) {
    DruckerPrager::State<double, 6> trial{};
    trial.sigma = random_tensor<6>(generator, 60);
    const auto soft =
        elastoplastic::returned(clay, static_cast<const PlasticState<double, 6>&>(trial), Sym<double, 6>::zero()).state;
    if (norm(soft.epsp) > 0) {
      EXPECT_NEAR(deviatoric_stress(soft.sigma), std::sqrt(3.0) * 10, 1e-11);
      expect_normal(soft, [](const auto& x) { return deviatoric_stress(x); });
    }
    const auto cone = elastoplastic::returned(sand, trial, Sym<double, 6>::zero()).state;
    const double q = deviatoric_stress(cone.sigma), p = mean(cone.sigma);
    EXPECT_LE(q - M * p - k, 1e-10);
    if (norm(cone.epsp) == 0) continue;
    EXPECT_NEAR(q - M * p - k, 0, 1e-10);
    if (q > 1e-9) {
      if (q > 1) expect_normal(cone, [&](const auto& x) { return deviatoric_stress(x) - M_psi * mean(x); });
    } else {
      ++apex;  // within the cone of flow directions there: ε_v^p ≤ −M_ψ ε_q^p
      EXPECT_NEAR(p, -k / M, 1e-10);
      EXPECT_LE(trace(cone.epsp), -M_psi * 0.8164965809 * norm(deviator(cone.epsp)) + 1e-12);
    }
  }
  EXPECT_GT(apex, 50);
}

/// Every lane of a batch goes its own way: elastic, plane, edge, apex, softening.
template <class Model, int N>
void expect_batch_is_double(const Constants& constants) {
  const auto model = law<Model>(constants);
  std::mt19937 generator(24);
  for (int repeat = 0; repeat < 300; ++repeat) {
    std::array<typename Model::template State<double, N>, batch_lanes> s{};
    std::array<Sym<double, N>, batch_lanes> deps, sigma;
    for (std::size_t l = 0; l < batch_lanes; ++l) {
      s[l].sigma = random_tensor<N>(generator, 30) + isotropic<double, N>(30);
      s[l] = elastoplastic::returned(model, s[l], Sym<double, N>::zero()).state;
      s[l].kappa = 0.002 * static_cast<double>(l % 4);
      s[l] = elastoplastic::returned(model, s[l], Sym<double, N>::zero()).state;
      s[l].epsp = Sym<double, N>::zero();
      sigma[l] = s[l].sigma;
      deps[l] = random_tensor<N>(generator, l % 3 ? 1e-3 : 1e-5);
    }
    const auto many = packed<Model, N>(s);
    const auto all = attempt<ModifiedEuler>(model, many, pack<N>(deps), 1e-4);
    for (std::size_t l = 0; l < batch_lanes; ++l) {
      const auto one = attempt<ModifiedEuler>(model, s[l], deps[l], 1e-4);
      EXPECT_LT(norm(lane(all.state.sigma, l) - one.state.sigma), 1e-12 * (norm(one.state.sigma) + 10));
      EXPECT_LT(norm(lane(all.state.epsp, l) - one.state.epsp), 1e-14);
      EXPECT_NEAR(lane(all.state.kappa, l), one.state.kappa, 1e-14);
      EXPECT_NEAR(lane(all.error, l), one.error, 1e-12);  // a difference of two answers, each rounded
      EXPECT_EQ(all.flags.sound.get(l), one.flags.sound);
      EXPECT_EQ(all.flags.separated.get(l), one.flags.separated);
    }
  }
}

TEST(PlasticReturn, BatchGivesWhatDoubleGives) {
  const Constants clay{{"E", 2e4}, {"nu", 0.3}, {"s_u", 15}, {"s_u_residual", 8}, {"epsp_residual", 0.005}};
  const Constants sand{{"E", 2e4},
                       {"nu", 0.3},
                       {"c", 2},
                       {"phi", 30},
                       {"psi", 5},
                       {"c_residual", 0},
                       {"phi_residual", 25},
                       {"epsp_residual", 0.005}};
  expect_batch_is_double<VonMises, 4>(clay);
  expect_batch_is_double<VonMises, 6>(clay);
  expect_batch_is_double<Tresca, 4>(clay);
  expect_batch_is_double<Tresca, 6>(clay);
  expect_batch_is_double<MohrCoulomb, 4>(sand);
  expect_batch_is_double<MohrCoulomb, 6>(sand);
  expect_batch_is_double<DruckerPrager, 4>(sand);
  expect_batch_is_double<DruckerPrager, 6>(sand);
}

}  // namespace
}  // namespace scarp::test
