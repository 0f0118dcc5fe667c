// Locking: the pressure of nearly incompressible soil at rest.
#include "roughness.hpp"

#include <gtest/gtest.h>

namespace scarp::verification {
namespace {

class Locking : public testing::TestWithParam<Cells> {};

TEST_P(Locking, LeavesThePressureOfASlopeWithMeanDilatation) {
  // With ν = 0.49 an element that strains each point by itself resists its bending with K, and its pressure swings
  // about that of its middle: 10 to 16 % of the mean. Of the mean dilatation the pressure of an element is one plus
  // what it started with, and the rest is the curvature of the pressure over three elements (0.3 % at ν = 0.3, h = 0.25
  // m, with any scheme). Out of step (2.5 points along an element of 0.5 m) the number of points in elements differs,
  // and with it their quadrature.
  struct {
    double h, spacing, largest;
  } constexpr cases[] = {{0.25, 0.125, 0.005}, {0.5, 0.2, 0.015}};
  for (const auto& its : cases) {
    const double with = roughness_at_rest(two_term_scheme(), GetParam(), its.h, its.spacing);
    EXPECT_LT(with, its.largest) << "h = " << its.h;
    std::printf("%s, h = %g, points %g apart: roughness of p %.2e", name_of(GetParam()).c_str(), its.h, its.spacing,
                with);
    if (its.h == 0.5) {  // the control
      const double without = roughness_at_rest(report_scheme(), GetParam(), its.h, its.spacing);
      EXPECT_GT(without, 5 * with);
      std::printf(", report's %.2e", without);
    }
    std::printf("\n");
  }
}
INSTANTIATE_TEST_SUITE_P(Meshes, Locking, testing::Values(Cells::grid, Cells::quads),
                         [](const auto& its) { return name_of(its.param); });

/// With `scheme`, and with the same but the means.
struct With {
  double means, none;
  With(Scheme scheme, Cells cells, double h, double spacing, GridFunctions shape) {
    means = roughness_at_rest(scheme, cells, h, spacing, 0.49, shape);
    scheme.mean_dilatation = false;
    none = roughness_at_rest(scheme, cells, h, spacing, 0.49, shape);
    std::printf("%s, %s, h = %g, points %g apart: roughness of p %.2e, without means %.2e\n", name_of(cells).c_str(),
                name_of(shape).c_str(), h, spacing, means, none);
  }
};

TEST(Locking, OfTrianglesIsThatOfTheirPatches) {
  // A patch is a square here, and squares have 0.89 %: that and as much again for a cut two ways by turns. Three points
  // along its side: of two the one on the diagonal leaves a triangle half empty.
  const With found(two_term_scheme(), Cells::triangles, 0.5, 0.5 / 3, GridFunctions::linear);
  EXPECT_LT(found.means, 0.0125);
  EXPECT_GT(found.none, 10 * found.means);
}
TEST(Locking, OfGimpIsThatOfLinearFunctionsWherePointsKeepStep) {
  // These have 0.83 %.
  const With found(two_term_scheme(), Cells::grid, 0.5, 0.25, GridFunctions::gimp);
  EXPECT_LT(found.means, 0.009);
  EXPECT_GT(found.none, 10 * found.means);
}
TEST(Locking, OfGimpIsHalvedWhereTheyDoNot) {
  // Points whose domains lie across a line take part in the mean with a share only.
  const With found(two_term_scheme(), Cells::grid, 0.5, 0.2, GridFunctions::gimp);
  EXPECT_LT(found.means, 0.6 * found.none);
}

}  // namespace
}  // namespace scarp::verification
