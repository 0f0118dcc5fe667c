// A column under its own weight: at rest with damping, and when the weight comes on at once.
#include <gtest/gtest.h>

#include <cstdio>

#include "column.hpp"

namespace scarp::verification {
namespace {

struct Errors {
  std::vector<double> displacement, stress, centre_stress;
  ColumnErrors finest;
};

/// With n, 2n and 4n elements over the height.
template <class F>
Errors refine(const char* what, int n, const Method& method, F&& run) {
  Errors errors;
  for (const int factor : {1, 2, 4}) {
    errors.finest = run(WeightColumn(factor * n, 2, method));
    errors.displacement.push_back(errors.finest.displacement);
    errors.stress.push_back(errors.finest.stress);
    errors.centre_stress.push_back(errors.finest.centre_stress);
  }
  std::printf("column %s, %s, n = %d, %d, %d: displacement %s; stress %s\n", what, method.name().c_str(), n, 2 * n,
              4 * n, text_of(errors.displacement).c_str(), text_of(errors.stress).c_str());
  return errors;
}

Errors rest(int n, const Method& method) {
  return refine("at rest", n, method, [](WeightColumn column) { return column.rest(); });
}

TEST(SelfWeight, LinearFunctionsAtRest) {
  // Relative L2 errors over the points. With linear functions the nodes are exact in one dimension, the displacement
  // between them errs by O(h²), and the stress is constant in each element: its points, a quarter of an element above
  // and below the middle, err by ρ g h/4, which is √3/4 h/H of the L2 size of ρ g (H − y), exactly. The mean of an
  // element is exact: what is left of it is the unbalanced force.
  for (const auto quadrature : {Quadrature::corrected, Quadrature::points}) {
    const auto errors = rest(8, {GridFunctions::linear, quadrature});
    EXPECT_LT(errors.finest.unbalanced, 1e-5);
    for (const double order : orders(errors.stress)) EXPECT_GT(order, 0.98);
    for (const double order : orders(errors.displacement)) EXPECT_GT(order, 1.9);
    EXPECT_NEAR(errors.stress.back(), std::sqrt(3.0) / 4 / 32, 1e-4);
    EXPECT_LT(errors.centre_stress.back(), 3e-5);
  }
}

}  // namespace
}  // namespace scarp::verification
