// Internal lengths against the mesh: an error below two elements, a warning below three, the columns that they need.
#include <gtest/gtest.h>

#include "scarp/run/build.hpp"
#include "scarp/run/lengths.hpp"
#include "unit/input/minimal.hpp"

namespace scarp::run {
namespace {

using input::test::minimal;
using input::test::replaced;

/// The minimal case, with elements of 0.5 m, whose clay has this length.
std::string with_length(const std::string& length) {
  return replaced(minimal, "density = 1.8", "density = 1.8\nlength = " + length);
}

TEST(Length, SpansAtLeastTwoElementsOfItsRegion) {
  const auto text = with_length("0.99");
  try {
    build_body(input::test::read(text));
    FAIL() << "no error";
  } catch (const InputError& error) {
    EXPECT_NE(error.problem().find("\"clay\" softens is at least 2 elements long in region \"left\""),
              std::string::npos)
        << error.what();
    EXPECT_NE(error.value().find("0.99, with elements of 0.5 m"), std::string::npos) << error.what();
    EXPECT_NE(error.remedy().find("length = 1 or more (better 1.5)"), std::string::npos) << error.what();
    const auto before = text.substr(0, text.find("length = 0.99"));
    EXPECT_EQ(error.position().line, 1 + std::count(before.begin(), before.end(), '\n'));
  }
}

TEST(Length, OfLessThanThreeElementsIsWarnedOf) {
  for (const auto& [length, warnings] :
       std::vector<std::pair<std::string, std::size_t>>{{"1.0", 1}, {"1.49", 1}, {"1.5", 0}, {"0.0", 0}}) {
    const auto input = input::test::read(with_length(length));
    const auto body = build_body(input);
    const auto found = short_lengths(input, body);
    ASSERT_EQ(found.size(), warnings) << length;
    if (warnings > 0) {
      EXPECT_NE(found[0].find("\"left\""), std::string::npos) << found[0];
    }
  }
}

TEST(Length, IsThatOfTheRegionsOfItsMaterial) {
  const auto plain = build_body(input::test::read(minimal));
  const auto body = build_body(input::test::read(with_length("2.0")));
  EXPECT_EQ(body.blocks()[0].length, 2.0);
  EXPECT_EQ(body.blocks()[0].state.size(), plain.blocks()[0].state.size() + 3);
  EXPECT_EQ(body.blocks()[1].length, 0.0);
  EXPECT_EQ(body.blocks()[1].state.size(), plain.blocks()[1].state.size());
  for (std::size_t c = 0; c < plain.blocks()[0].state.size(); ++c)
    EXPECT_EQ(body.blocks()[0].state[c], plain.blocks()[0].state[c]);
}

TEST(Length, StartsFromTheKappaThatARegionStartsWith) {
  auto text = with_length("2.0");
  const auto from = text.find("model = \"subloading\""), to = text.find("[[region]]");
  text = text.substr(0, from) +
         "model = \"von-mises\"\ndensity = 1.8\nlength = 2.0\nE = 1e4\nnu = 0.3\ns_u = 50.0\ns_u_residual = 20.0\n"
         "epsp_residual = 0.2\n\n" +
         text.substr(to);
  text = replaced(text, "R_b = 3.0, OCR = 1.6, beta = \"isotropic\"", "epsp_acc = 0.05");
  const auto body = build_body(input::test::read(text));
  const auto& state = body.blocks()[0].state;
  EXPECT_EQ(state.end()[-3][0], 0.05);
  EXPECT_EQ(state.end()[-2][0], 0.05);
  EXPECT_EQ(state.end()[-1][0], 0.0);
}

}  // namespace
}  // namespace scarp::run
