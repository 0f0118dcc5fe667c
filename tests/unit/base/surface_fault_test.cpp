// What keeps triangles from being the surface of a solid: each fault is named, with its triangle.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "scarp/base/surface.hpp"
#include "surfaces.hpp"

namespace scarp::test {
namespace {

void expect_fault(const Triangles& triangles, const std::string& problem, const std::string& value,
                  std::size_t triangle) {
  SCOPED_TRACE(problem);
  const auto fault = surface_fault(triangles);
  ASSERT_TRUE(fault);
  EXPECT_NE(fault->problem.find(problem), std::string::npos) << fault->problem;
  EXPECT_NE(fault->value.find(value), std::string::npos) << fault->value;
  EXPECT_FALSE(fault->remedy.empty());
  EXPECT_EQ(fault->triangle, triangle);
}

TEST(SurfaceFault, GoodSurfacesHaveNone) {
  for (const auto& triangles :
       {box({0, 0, 0}, {1, 2, 3}), turned(box({0, 0, 0}, {1, 2, 3})), tetrahedron({}, 1), sphere(4, 2, {1, 2, 3}),
        tilted(box({0, 0, 0}, {1, 2, 3})), together(box({0, 0, 0}, {3, 3, 3}), turned(box({1, 1, 1}, {2, 2, 2}))),
        together(turned(box({0, 0, 0}, {3, 3, 3})), box({1, 1, 1}, {2, 2, 2})),
        together(box({0, 0, 0}, {1, 1, 1}), box({2, 0, 0}, {3, 1, 1})),
        together(box({0, 0, 0}, {1, 1, 1}), box({0.2, 0.2, 2}, {1.2, 1.3, 3}))}) {
    const auto fault = surface_fault(triangles);
    EXPECT_FALSE(fault) << fault->problem << "; " << fault->value;
  }
}

TEST(SurfaceFault, Nothing) {
  expect_fault({}, "has triangles", "none", 0);
}

TEST(SurfaceFault, NoArea) {
  auto triangles = box({0, 0, 0}, {1, 1, 1});
  triangles[5][2] = triangles[5][1];
  expect_fault(triangles, "no area", "corners (", 5);
  triangles = box({0, 0, 0}, {1, 1, 1});
  triangles[7] = {{{0, 0, 0}, {1, 1, 1}, {2, 2, 2}}};
  expect_fault(triangles, "no area", "(2, 2, 2)", 7);
}

TEST(SurfaceFault, Hole) {
  auto triangles = sphere(2, 1, {});
  const auto gone = triangles.back();
  triangles.pop_back();
  const auto fault = surface_fault(triangles);
  ASSERT_TRUE(fault);
  EXPECT_NE(fault->problem.find("not closed"), std::string::npos);
  EXPECT_NE(fault->value.find("one triangle at the edge"), std::string::npos);
  // It is a neighbour of the one that is missing.
  std::ptrdiff_t shared = 0;
  for (const auto& corner : triangles[fault->triangle]) shared += std::count(gone.begin(), gone.end(), corner);
  EXPECT_EQ(shared, 2);
}

TEST(SurfaceFault, CornerThatMissesByTheLastDigit) {
  auto triangles = tetrahedron({}, 1);
  triangles[3][0][0] = std::nextafter(1.0, 2.0);
  const auto fault = surface_fault(triangles);
  ASSERT_TRUE(fault);
  EXPECT_NE(fault->problem.find("not closed"), std::string::npos);
  EXPECT_NE(fault->remedy.find("last digit"), std::string::npos);
}

TEST(SurfaceFault, OneTriangleTurned) {
  auto triangles = tetrahedron({}, 1);
  std::swap(triangles[2][0], triangles[2][1]);
  const auto fault = surface_fault(triangles);
  ASSERT_TRUE(fault);
  EXPECT_NE(fault->problem.find("turned against each other"), std::string::npos);
  EXPECT_NE(fault->value.find("2 triangles at the edge"), std::string::npos);
}

TEST(SurfaceFault, TriangleTwice) {
  auto triangles = tetrahedron({}, 1);
  triangles.push_back(triangles[1]);
  expect_fault(triangles, "more than two triangles", "3 triangles at the edge", 4);
}

TEST(SurfaceFault, PartsThatPassThroughEachOther) {
  const auto a = box({0, 0, 0}, {1, 1, 1});
  const auto fault = surface_fault(together(a, box({0.5, 0.3, 0.2}, {1.5, 0.7, 0.9})));
  ASSERT_TRUE(fault);
  EXPECT_NE(fault->problem.find("pass through each other"), std::string::npos);
  EXPECT_GE(fault->triangle, a.size());
}

TEST(SurfaceFault, PartsTurnedAgainstEachOther) {
  const auto a = box({0, 0, 0}, {2, 2, 2});
  const auto fault = surface_fault(together(a, turned(box({3, 0, 0}, {4, 1, 1}))));
  ASSERT_TRUE(fault);
  EXPECT_NE(fault->problem.find("a part of the surface is turned"), std::string::npos);
  EXPECT_NE(fault->value.find("in and out"), std::string::npos);
  EXPECT_GE(fault->triangle, a.size());  // the smaller part
  EXPECT_TRUE(surface_fault(together(a, box({0.5, 0.5, 0.5}, {1, 1, 1})))) << "a cavity that faces outwards";
}

}  // namespace
}  // namespace scarp::test
