// What check and run say about regions: too few points for their elements, and shapes that overlap.
#include "scarp/run/advice.hpp"

#include <gtest/gtest.h>

#include "scarp/base/error.hpp"
#include "scarp/base/log.hpp"
#include "scarp/mesh/build.hpp"
#include "scarp/mesh/locate.hpp"
#include "scarp/run/build.hpp"
#include "unit/input/minimal.hpp"

namespace scarp::run {
namespace {

using input::test::minimal;
using input::test::read;
using input::test::replaced;

std::string warnings_of(const std::string& text) {
  const auto input = read(text);
  const auto body = build_body(input);
  logging::forget_warnings();
  warn_of_sparse_points(input, body);
  std::string all;
  for (const auto& warning : logging::warnings()) all += warning + '\n';
  return all;
}

// Elements of 0.5 m: the left region, 1 m by 2 m, has 8 of them inside and points 1/4 m, 1/2 m or 1 m apart.
TEST(Advice, CountsElementsWithoutPoints) {
  const auto spaced = [](const char* spacing) {
    return warnings_of(replaced(replaced(minimal, "spacing = 0.25", spacing), "spacing = 0.5", "spacing = 0.125"));
  };
  EXPECT_EQ(spaced("spacing = 0.25"), "");
  const auto half = spaced("spacing = 0.45");
  EXPECT_NE(half.find("fewer than two points"), std::string::npos) << half;
  EXPECT_EQ(half.find("hold no point"), std::string::npos) << half;
  const auto whole = spaced("spacing = 1.0");
  EXPECT_NE(whole.find("of the 8 elements inside it hold no point"), std::string::npos) << whole;
  EXPECT_NE(whole.find("spacing = 0.25 or less"), std::string::npos) << whole;
}

// A mesh of squares of 0.5 m, of which one is cut into 100: few points are in small elements, and many of these empty.
TEST(Advice, SeesElementsThatAreSmallInOnePlaceOnly) {
  auto input = read(replaced(minimal, "spacing = 0.5", "spacing = 0.25"));
  Body<2> body = build_body(input);
  Mesh<2> mesh;
  mesh.lists.offsets = {0};
  const auto square = [&](double x, double y, double h) {
    const int first = mesh.node_count();
    for (const auto& [i, j] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}})
      mesh.lists.nodes.push_back({x + i * h, y + j * h});
    for (int i = 0; i < 4; ++i) mesh.lists.connectivity.push_back(first + i);
    mesh.lists.types.push_back(ElementType::Q4);
    mesh.lists.offsets.push_back(static_cast<int>(mesh.lists.connectivity.size()));
  };
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j)
      if (i != 1 || j != 1) square(0.5 * i, 0.5 * j, 0.5);
  for (int i = 0; i < 100; ++i) square(0.5 + 0.05 * (i % 10), 0.5 + 0.05 * (i / 10), 0.05);
  complete(mesh);
  Body<2> graded(std::make_unique<const Mesh<2>>(mesh), input.gravity);
  graded.fields[0].blocks = body.fields[0].blocks;
  const Locator<2> locator(mesh);
  for (auto& block : graded.blocks()) {
    for (int i = 0; i < block.size(); ++i)
      block.points.element[i] = locator.find_anywhere({block.points.x[0][i], block.points.x[1][i]}).element;
  }
  logging::forget_warnings();
  warn_of_sparse_points(input, graded);
  const auto warnings = logging::warnings();
  ASSERT_EQ(warnings.size(), 1u);
  EXPECT_NE(warnings[0].find("96 of the 107 elements inside it hold no point"), std::string::npos) << warnings[0];
  EXPECT_NE(warnings[0].find("spacing = 0.025 or less"), std::string::npos) << warnings[0];
}

TEST(Advice, CountsPointsOfElements) {
  const auto body = build_body(read(minimal));
  // 32 points in the 8 elements of the left region; 1 and 3 parts of the triangle's lattice of 2 by 2 in 3 more.
  EXPECT_EQ(points_per_element(body).find(std::to_string(body.point_count()) + " in "), 0u);
  int most = 0, least = 1000;
  for (int e = 0; e < body.mesh->element_count(); ++e) {
    int count = 0;
    for (const auto& block : body.blocks())
      count += static_cast<int>(std::count(block.points.element.begin(), block.points.element.end(), e));
    most = std::max(most, count);
    if (count > 0) least = std::min(least, count);
  }
  EXPECT_NE(points_per_element(body).find(std::to_string(least) + " at least"), std::string::npos);
}

void expect_overlap(const std::string& polygon, const std::string& value) {
  try {
    build_body(read(replaced(minimal, "[[1.0, 0.0], [2.0, 0.0], [2.0, 1.0]]", polygon)));
    ADD_FAILURE() << "no error for " << polygon;
  } catch (const InputError& error) {
    EXPECT_NE(error.problem().find("\"right\" and \"left\" overlap"), std::string::npos) << error.what();
    EXPECT_NE(error.value().find(value), std::string::npos) << error.what();
    EXPECT_GT(error.position().line, 0);
  }
}

TEST(Advice, RegionsThatShareLessThanTheirSpacing) {
  expect_overlap("[[0.95, 0.0], [2.0, 0.0], [2.0, 1.0], [0.95, 1.0]]", "(0.975, 0.5) in both, an area of 0.05 in all");
  expect_overlap("[[0.0, 1.98], [1.0, 1.98], [1.0, 2.0], [0.0, 2.0]]", "in both");
  // Drawn by hand: a quarter of a millimetre in 25 cm.
  build_body(read(replaced(minimal, "[[1.0, 0.0], [2.0, 0.0], [2.0, 1.0]]",
                           "[[0.99975, 0.0], [2.0, 0.0], [2.0, 1.0], [0.99975, 1.0]]")));
}

}  // namespace
}  // namespace scarp::run
