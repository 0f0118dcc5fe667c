// The case as it was run: what is written reads as what it was made of.
#include <gtest/gtest.h>

#include "minimal.hpp"
#include "scarp/input/document.hpp"

namespace scarp::input::test {
namespace {

void expect_same(const Node& a, const Node& b) {
  ASSERT_EQ(a.value.index(), b.value.index());
  EXPECT_EQ(a.whole, b.whole);
  if (const auto* keys = std::get_if<Keys>(&a.value)) {
    const auto& others = std::get<Keys>(b.value);
    ASSERT_EQ(keys->size(), others.size());
    for (const auto& [key, value] : *keys) {
      SCOPED_TRACE(key);
      ASSERT_TRUE(others.contains(key));
      expect_same(value, others.at(key));
    }
  } else if (const auto* list = std::get_if<List>(&a.value)) {
    const auto& others = std::get<List>(b.value);
    ASSERT_EQ(list->size(), others.size());
    for (std::size_t i = 0; i < list->size(); ++i) expect_same((*list)[i], others[i]);
  } else if (const auto* number = std::get_if<double>(&a.value)) {
    EXPECT_EQ(*number, std::get<double>(b.value));
  } else if (const auto* text = std::get_if<std::string>(&a.value)) {
    EXPECT_EQ(*text, std::get<std::string>(b.value));
  } else {
    EXPECT_EQ(std::get<bool>(a.value), std::get<bool>(b.value));
  }
}

TEST(Write, EveryKindOfValue) {
  const std::string strange = R"(
title = "quotes \" and \\, a tab \t, a line\nend, \u0001, Böschung"
whole = -12
large = 1e300
third = 0.3333333333333333
small = 5e-324
round = 100000.0
yes = true
empty = []
nothing = {}
mixed = [1, 2.5, "a", [true, { b = 1, "c d" = "e" }]]
"key with spaces" = 1
[table]
x = 1.0
inner = { "ä" = [[0.0, 1], [2, 3.5]] }
[[array]]
name = "first"
[[array]]
[array.sub]
z = 3
)";
  for (const auto& text : {strange, minimal}) {
    const Node once = parse_text(text, "a");
    expect_same(once, parse_text(to_toml(once), "b"));
  }
}

TEST(Write, ACaseWithOverridesReadsAsItWasRun) {
  const CaseFile file(minimal);
  EXPECT_EQ(read_case(file.path()).text, minimal);
  const auto changed = read_case(file.path(), {"material.rock.E=123.5", "stage.cut.duration=0.25", "title=other"});
  EXPECT_NE(changed.text.find("--set material.rock.E=123.5\n"), std::string::npos) << changed.text;
  const CaseFile again(changed.text);
  const auto read_again = read_case(again.path());
  EXPECT_EQ(read_again.title, "other");
  EXPECT_EQ(read_again.stages[1].duration, 0.25);
  EXPECT_EQ(std::get<LinearElastic>(read_again.materials[0].model).parameters().E, 123.5);
  EXPECT_EQ(read_again.regions.size(), changed.regions.size());
}

}  // namespace
}  // namespace scarp::input::test
