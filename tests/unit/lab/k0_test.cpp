// K0 from the model against closed forms.
#include "scarp/lab/k0.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "scarp/base/error.hpp"

namespace scarp::lab {
namespace {

constexpr double kappa = 0.02, lambda = 0.12, nu = 0.3, M = 1.2;

/// The Modified Cam Clay limit.
std::map<std::string, double> cam_clay() {
  return {{"kappa", kappa}, {"lambda", lambda}, {"nu", nu},         {"p_e", 0},      {"M", M},      {"M_c", M},
          {"k", 1},         {"alpha", 1},       {"xi", 0},          {"c_R", 1000},   {"c_beta", 0}, {"c_b", 0},
          {"R_bf", 1},      {"c_a", 0},         {"p_atm", 101.325}, {"p_c_floor", 0}};
}

/// Normally consolidated Modified Cam Clay where nothing moves sideways, ε_q = 2/3 ε_v, at a stress ratio η that stays:
/// (λ̄ − κ̄) 2η/(M² − η²) + κ̄ η 2(1 + ν)/(9(1 − 2ν)) = 2/3 λ̄, by bisection; K0 = (3 − η)/(3 + 2η).
double cam_clay_K0() {
  double low = 0, high = M;
  for (int i = 0; i < 100; ++i) {
    const double eta = 0.5 * (low + high);
    const double shear =
        (lambda - kappa) * 2 * eta / (M * M - eta * eta) + kappa * eta * 2 * (1 + nu) / (9 * (1 - 2 * nu));
    (shear < 2.0 / 3.0 * lambda ? low : high) = eta;
  }
  return (3 - low) / (3 + 2 * low);
}

TEST(K0, LinearElasticIsPoissons) {
  const AnyModel model = LinearElastic({1e4, 0.25});
  const K0Curve curve(model, 50, 4);
  for (const double OCR : {1.0, 2.0, 4.0}) EXPECT_DOUBLE_EQ(curve(OCR), 1.0 / 3.0);
}

TEST(K0, NormallyConsolidatedCamClay) {
  const auto model = *make_model("subloading", cam_clay()).model;
  for (const double vertical : {1.0, 100.0}) {
    // Band: increments of 2 % of the elastic stiffness with an error of 1e-6 each, and a start a thousandth as high.
    EXPECT_NEAR(K0Curve(model, vertical, 1)(1), cam_clay_K0(), 2e-4) << vertical;
  }
}

// Modified Cam Clay on its own; unloading from exactly the yield surface, with constant ν as below.
TEST(K0, OfModifiedCamClay) {
  const auto model = *make_model("modified-cam-clay", {{"kappa", kappa},
                                                       {"lambda", lambda},
                                                       {"nu", nu},
                                                       {"p_e", 0},
                                                       {"M", M},
                                                       {"p_atm", 101.325},
                                                       {"p_c_floor", 0}})
                          .model;
  for (const double vertical : {1.0, 100.0}) {
    const K0Curve curve(model, vertical, 2);
    EXPECT_NEAR(curve(1), cam_clay_K0(), 2e-4) << vertical;
    EXPECT_NEAR(curve(2), 2 * curve(1) - nu / (1 - nu), 1e-3) << vertical;  // linear interpolation in ln OCR
  }
}

TEST(K0, UnloadingIsElasticAsLongAsTheStressStaysInside) {
  // Elastic with constant ν: σ_h falls by ν/(1 − ν) of what σ_v falls by, so K0 = OCR K0_nc − (OCR − 1) ν/(1 − ν).
  const auto model = *make_model("subloading", cam_clay()).model;
  const K0Curve curve(model, 50, 3);
  for (const double OCR : {1.5, 2.0, 3.0}) {
    EXPECT_NEAR(curve(OCR), OCR * curve(1) - (OCR - 1) * nu / (1 - nu), 2e-3 * OCR) << OCR;
  }
}

TEST(K0, RisesWithOcrAndFallsWithFriction) {
  auto values = cam_clay();
  const K0Curve soft(*make_model("subloading", values).model, 50, 4);
  EXPECT_LT(soft(1), soft(2));
  EXPECT_LT(soft(2), soft(4));
  values["M"] = values["M_c"] = 1.6;
  EXPECT_LT(K0Curve(*make_model("subloading", values).model, 50, 1)(1), soft(1));
}

}  // namespace
}  // namespace scarp::lab
