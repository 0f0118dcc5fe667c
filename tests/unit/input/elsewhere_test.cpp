// What elsewhere() knows of the keys of tables is what their readers ask for.
#include "scarp/input/elsewhere.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <string>

#include "minimal.hpp"
#include "scarp/base/error.hpp"

namespace scarp::input::test {
namespace {

using Keys = std::set<std::string>;

const std::string absorbing = "fix = [\"x\"]\nabsorbing = true\nfrom = \"cut\"\n@";

/// The minimal case with an absorbing side, where a `stranger` stands at the mark.
std::string marked(const std::string& at, const std::string& with_mark) {
  auto text =
      replaced(minimal, "[[boundary]]\nline", "[[boundary]]\nnodes = \"left\"\n" + absorbing + "\n[[boundary]]\nline");
  if (at != absorbing) text = replaced(text, "@", "");
  return at == absorbing ? text : replaced(text, at, with_mark);
}

/// The keys that the reader of a table names when it meets one that no table has.
Keys asked_for(std::string text, const std::string& stranger) {
  text = replaced(text, "@", stranger);
  std::string remedy;
  try {
    read(text);
  } catch (const InputError& error) {
    remedy = error.remedy();
    EXPECT_NE(error.problem().find("has no key zzzzzzzzzz"), std::string::npos) << error.what();
  }
  const std::string head = "its keys are ";
  EXPECT_EQ(remedy.rfind(head, 0), 0u) << remedy;
  Keys keys;
  for (std::size_t from = head.size(); from < remedy.size();) {
    const auto end = std::min(remedy.find(", ", from), remedy.size());
    keys.insert(remedy.substr(from, end - from));
    from = end + 2;
  }
  return keys;
}

/// The keys of each table of the case, from its reader.
std::map<std::string, Keys> readers() {
  const std::string line = "zzzzzzzzzz = 1\n", inner = ", zzzzzzzzzz = 1";
  std::map<std::string, Keys> all;
  all["the case"] = asked_for(marked("title =", "@title ="), line);
  all["[mesh]"] = asked_for(marked("[mesh]\n", "[mesh]\n@"), line);
  all["grid"] = asked_for(marked("element = 0.5", "element = 0.5@"), inner);
  all["[method]"] = asked_for(marked("[method]\n", "[method]\n@"), line);
  all["[output]"] = asked_for(marked("[output]\n", "[output]\n@"), line);
  all["checkpoint"] = asked_for(marked("[output]\n", "[output]\ncheckpoint = { @ }\n"), "zzzzzzzzzz = 1");
  all["[start]"] = asked_for(marked("[output]\n", "[start]\nfrom = \"other.out\"\n@\n[output]\n"), line);
  all["[[region]]"] = asked_for(marked("spacing = 0.5\n", "spacing = 0.5\n@"), line);
  all["[[boundary]]"] = asked_for(marked("friction = 0.3\n", "friction = 0.3\n@"), line);
  all["absorbing"] = asked_for(marked(absorbing, ""), line);
  all["[[stage]]"] = asked_for(marked("duration = 2.0\n", "duration = 2.0\n@"), line);
  all["remove"] = asked_for(marked("remove = { ", "remove = { @"), "zzzzzzzzzz = 1, ");
  all["rest"] = asked_for(marked("hold = 0.1", "hold = 0.1@"), inner);
  return all;
}

/// Not of interest to elsewhere(): a name, which most tables have, and the tables of the case itself.
const Keys left_out{"name", "mesh", "method", "output", "region", "boundary", "stage", "start"};

TEST(Elsewhere, KnowsTheKeysThatTheReadersAskFor) {
  const auto all = readers();
  ASSERT_EQ(all.size(), 13u);
  for (const auto& [table, keys] : all) {
    EXPECT_FALSE(keys.empty()) << table;
    for (const auto& key : keys) EXPECT_EQ(elsewhere(key).empty(), left_out.contains(key)) << key << " of " << table;
  }
}

TEST(Elsewhere, KnowsNoKeyThatNoReaderAsksFor) {
  Keys asked{"density", "length", "model",
             "stl"};  // [[material]] names its law's constants instead; solids have an STL
  for (const auto& [table, keys] : readers()) asked.insert(keys.begin(), keys.end());
  Keys known;
  for (const auto& [table, keys] : keys_of_tables()) {
    for (const auto& key : keys) {
      EXPECT_TRUE(asked.contains(key)) << key << " of " << table;
      EXPECT_TRUE(known.insert(key).second) << key << " is declared twice";
    }
  }
}

}  // namespace
}  // namespace scarp::input::test
