// A column under its own weight: at rest with damping, and when the weight comes on at once.
#include <gtest/gtest.h>

#include <cstdio>

#include "column.hpp"

namespace scarp::verification {
namespace {

struct Errors {
  std::vector<double> displacement, stress;
  ColumnErrors finest;
};

/// With 8, 16 and 32 elements over the height.
template <class F>
Errors refine(const char* what, const Method& method, F&& run) {
  Errors errors;
  for (const int n : {8, 16, 32}) {
    WeightColumn column(n, 2, method);
    errors.finest = run(column);
    errors.displacement.push_back(errors.finest.displacement);
    errors.stress.push_back(errors.finest.stress);
  }
  std::printf("column %s, %s, n = 8, 16, 32: displacement %s; stress %s\n", what, method.name().c_str(),
              text_of(errors.displacement).c_str(), text_of(errors.stress).c_str());
  return errors;
}

Errors rest(const Method& method) {
  const auto errors = refine("at rest", method, [](WeightColumn& column) { return column.rest(); });
  EXPECT_LT(errors.finest.unbalanced, 2e-8);
  return errors;
}

// Relative L2 errors over the points; two points per element along each axis. All errors of the discretization below
// are larger than what is left of the motion (1e-8 of the weight), of the geometry (strains of 1e-7) and of round-off
// in positions (1e-16 of H in each of 10⁴ steps, 1e-6 of the settlement).

TEST(SelfWeight, LinearFunctionsAtRest) {
  // In one dimension nodes are exact; the displacement between them errs by O(h²), and the stress is constant in each
  // element: its points, a quarter of an element above and below the middle, err by ρ g h/4, which is √3/4 h/H of the
  // L2 size of ρ g (H − y), exactly.
  for (const auto quadrature : {QuadratureRule::corrected, QuadratureRule::points}) {
    const auto errors = rest({GridFunctions::linear, quadrature});
    for (const double order : orders(errors.displacement)) EXPECT_GT(order, 1.9);
    for (const double order : orders(errors.stress)) EXPECT_GT(order, 0.95);
    EXPECT_NEAR(errors.stress.back(), std::sqrt(3.0) / 4 / 32, 1e-4);
  }
}

TEST(SelfWeight, SplinesAtRest) {
  // The solution is in their space: u is quadratic. What errs is the quadrature with the points, two midpoints for
  // products σ dN/dy that are quadratic in an element. The errors of the elements of an inner function cancel (dN/dy
  // changes by 1, −2, 1); those of the functions at the base and at the top do not. So the displacement is of order 2,
  // and the stress errs by O(ρ g h) in the elements at both ends and by a third of that in each further one: order 1½
  // in the L2 norm, a quarter of the error with twice the points, and nothing in the middle half, eight elements from
  // the ends and more.
  for (const auto quadrature : {QuadratureRule::corrected, QuadratureRule::points}) {
    const auto errors = rest({GridFunctions::b_spline, quadrature});
    for (const double order : orders(errors.displacement)) EXPECT_GT(order, 1.9);
    for (const double order : orders(errors.stress)) EXPECT_NEAR(order, 1.5, 0.1);
    EXPECT_LT(errors.finest.inner_stress, 1.0 / 32 / 6561);  // h/H 3⁻⁸
    ColumnErrors twice = WeightColumn(16, 4, {GridFunctions::b_spline, quadrature}).rest();
    EXPECT_NEAR(twice.stress, errors.stress[1] / 4, 0.03 * errors.stress[1]);
    std::printf("column at rest, splines: largest error of the inner stress %.1e of ρgH\n", errors.finest.inner_stress);
  }
}

TEST(SelfWeight, GimpAtRest) {
  // Averages of the linear gradients over the domains of points that tile each element: with domains that end on the
  // element's sides they are the linear gradients themselves, and so are the errors.
  const auto errors = rest({GridFunctions::gimp});
  for (const double order : orders(errors.displacement)) EXPECT_GT(order, 1.9);
  for (const double order : orders(errors.stress)) EXPECT_GT(order, 0.95);
  EXPECT_NEAR(errors.stress.back(), std::sqrt(3.0) / 4 / 32, 1e-4);
}

TEST(SelfWeight, SuddenWeightDoublesDisplacementAndStress) {
  // Oracle: at t = 2H/c twice the static displacement and stress, and at rest. The front has run up and is just back at
  // the base, a kink of the stress that dispersion spreads over (h² H)^⅓: the stress errs by O(h^⅔) there, the
  // displacement by O(h^(4/3)), of orders 1 and 5/3 in the L2 norm. Bands: the top, far from it, by half a per cent;
  // the lowest points by h^⅔ = 1/10, halved as a kink's two sides share it.
  for (const auto shape : all_shapes) {
    const auto errors = refine("with sudden weight", {shape}, [](WeightColumn& column) { return column.fall(); });
    EXPECT_NEAR(errors.finest.top, 2, 0.01);
    EXPECT_NEAR(errors.finest.base, 2, 0.1);
    EXPECT_LT(errors.displacement.back(), 2e-3);
    EXPECT_LT(errors.stress.back(), 0.02);
    EXPECT_NEAR(orders(errors.displacement).back(), 5.0 / 3, 0.2);
    EXPECT_NEAR(orders(errors.stress).back(), 1.0, 0.2);
    std::printf("  top %.4f, base %.4f of their static values\n", errors.finest.top, errors.finest.base);
  }
}

}  // namespace
}  // namespace scarp::verification
