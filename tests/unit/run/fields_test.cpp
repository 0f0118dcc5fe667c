// What frames show of the points.
#include "scarp/run/fields.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <sstream>

#include "scarp/mesh/grid.hpp"

namespace scarp::run {
namespace {

Body<2> one_point() {
  Body<2> body(std::make_unique<const Mesh<2>>(make_grid({0, 0}, {1, 1}, {2, 2})), {0, -9.81});
  Block<2> block("soil", LinearElastic({1e4, 0.3}));
  resize(block, 1);
  auto& points = block.points;
  points.x[0][0] = points.x[1][0] = 0.25;
  points.volume[0] = points.initial_volume[0] = 0.25;
  points.mass[0] = 0.5;
  body.fields[0].blocks.push_back(std::move(block));
  locate_points(body);
  return body;
}

TEST(Frames, ShowWhatIsDeclaredSo) {
  const auto body = one_point();
  const Frame frame = frame_of(body);
  std::ifstream file(std::string(SCARP_SOURCE_DIR) + "/docs/output.md");
  std::stringstream page;
  page << file.rdbuf();
  Points<2>::each(body.blocks()[0].points, [&](const PointArray& info, const auto&) {
    const bool is_shown = std::any_of(frame.fields.begin(), frame.fields.end(),
                                      [&](const io::Field& field) { return field.name == info.key; });
    EXPECT_EQ(is_shown, info.shown) << info.key;
    const bool is_in_page = page.str().find(std::string("| `") + info.key + "` |") != std::string::npos;
    EXPECT_TRUE(is_in_page || !info.shown) << info.key;
  });
}

}  // namespace
}  // namespace scarp::run
