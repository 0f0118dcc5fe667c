// STL files: both kinds give the same solid; each fault has its line or byte, value and remedy.
#include "scarp/input/stl.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstring>

#include "scarp/base/error.hpp"

namespace scarp::input::test {
namespace {

const std::vector<Triangle> tetrahedron{{{{0, 0, 0}, {0, 2, 0}, {2, 0, 0}}},
                                        {{{0, 0, 0}, {2, 0, 0}, {0, 0, 2}}},
                                        {{{0, 0, 0}, {0, 0, 2}, {0, 2, 0}}},
                                        {{{2, 0, 0}, {0, 2, 0}, {0, 0, 2}}}};

std::string ascii() {
  std::string text = "solid hill\n";
  for (const auto& triangle : tetrahedron) {
    text += " facet normal 0 0 0\n  outer loop\n";
    for (const auto& v : triangle)
      text += "   vertex " + std::to_string(v[0]) + ' ' + std::to_string(v[1]) + ' ' + std::to_string(v[2]) + '\n';
    text += "  endloop\n endfacet\n";
  }
  return text + "endsolid hill\n";
}

std::string binary() {
  std::string bytes(80, ' ');
  const auto add = [&](auto value) { bytes.append(reinterpret_cast<const char*>(&value), sizeof value); };
  add(static_cast<std::uint32_t>(tetrahedron.size()));
  for (const auto& triangle : tetrahedron) {
    for (int k = 0; k < 3; ++k) add(0.0F);
    for (const auto& v : triangle) {
      for (const double c : v) add(static_cast<float>(c));
    }
    add(std::uint16_t{0});
  }
  return bytes;
}

void expect_refused(const std::string& bytes, int line, const std::string& problem, const std::string& value) {
  SCOPED_TRACE(problem);
  try {
    parse_stl("hill.stl", bytes);
    ADD_FAILURE() << "no error";
  } catch (const InputError& error) {
    EXPECT_EQ(error.position().file, "hill.stl");
    EXPECT_EQ(error.position().line, line);
    EXPECT_NE(error.problem().find(problem), std::string::npos) << error.what();
    EXPECT_NE(error.value().find(value), std::string::npos) << error.what();
    EXPECT_FALSE(error.remedy().empty());
  }
}

TEST(Stl, BothKinds) {
  for (const auto& bytes : {ascii(), binary()}) EXPECT_NEAR(parse_stl("a", bytes).moments().volume, 8.0 / 6, 1e-14);
}

TEST(Stl, Faults) {
  auto text = ascii();
  const auto half = text.substr(0, text.size() / 2);
  expect_refused(half, 1 + static_cast<int>(std::count(half.begin(), half.end(), '\n')), "", "");
  expect_refused(binary().substr(0, 200), 0, "at byte 80", "4 triangles, which need 284 bytes, in 200 bytes");
  expect_refused("", 1, "here must be \"solid\"", "the end of the file");
  text.replace(text.find("2.000000"), 8, "two     ");
  expect_refused(text, 5, "a coordinate is a finite number", "\"two\"");
  auto bytes = binary();
  const float wrong = 3;
  std::memcpy(bytes.data() + 84 + 50 * 3 + 12, &wrong, 4);  // the first corner of the last triangle
  expect_refused(bytes, 0, "not closed", "one triangle at the edge");
}

}  // namespace
}  // namespace scarp::input::test
