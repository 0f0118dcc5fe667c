// Spoilt texts: whatever a file holds, reading it gives a case or an InputError; nothing else leaves read_case, and the
// program goes on.
#include <gtest/gtest.h>

#include <algorithm>
#include <exception>
#include <random>

#include "minimal.hpp"
#include "scarp/input/document.hpp"

namespace scarp::input::test {
namespace {

/// Picks numbers without the library's distributions, whose results differ from library to library.
class Chance {
 public:
  std::size_t below(std::size_t count) { return count > 0 ? engine_() % count : 0; }

 private:
  std::mt19937 engine_{20240229};
};

/// One small damage to the text.
std::string spoilt(std::string text, Chance& chance) {
  static const std::string telling = "[]{}=.,\"'#\\\n\r\t 0-+_eExinfa\x7f\x01\xc3\xa9\xff";
  const std::size_t at = chance.below(text.size()), length = 1 + chance.below(12);
  switch (chance.below(6)) {
    case 0:
      return text.erase(at, length);
    case 1:
      return text.insert(at, text.substr(at, length));
    case 2:
      if (!text.empty()) std::swap(text[at], text[chance.below(text.size())]);
      return text;
    case 3:
      // Rarely, or most of what is read would be short.
      return chance.below(4) == 0 ? text.substr(0, at) : text.erase(at, 1);
    case 4:
      return text.insert(at, 1, telling[chance.below(telling.size())]);
    default: {
      const std::size_t from = chance.below(text.size());
      return text.insert(at, text.substr(from, length));
    }
  }
}

enum class Ending { good, refused };

Ending ending(const CaseFile& file) {
  try {
    read_case(file.path());
    return Ending::good;
  } catch (const InputError& error) {
    EXPECT_FALSE(error.problem().empty());
    EXPECT_FALSE(error.remedy().empty()) << error.what();
    EXPECT_EQ(error.position().file, file.path()) << error.what();
    return Ending::refused;
  }
}

TEST(Fuzz, ThreeThousandSpoiltCases) {
  Chance chance;
  const CaseFile file(minimal);
  int good = 0, refused = 0;
  for (int i = 0; i < 3000; ++i) {
    std::string text = minimal;
    for (std::size_t k = 1 + chance.below(3); k > 0; --k) text = spoilt(text, chance);
    file.write(text);
    try {
      (ending(file) == Ending::good ? good : refused)++;
    } catch (const std::exception& error) {
      ADD_FAILURE() << "mutation " << i << ": " << error.what() << "\n" << text;
    }
  }
  // Damage to a name or a digit can leave a good case. Were either outcome missing, the mutations would test little.
  EXPECT_GT(good, 10);
  EXPECT_GT(refused, 1500);
}

// What TOML itself knows and a case hardly uses, cut short after every byte: the parser's own corners.
TEST(Fuzz, EveryBeginningOfAVariedDocument) {
  const std::string varied =
      "\"quoted key\" = 'literal'\na.b.'c' = 0x1F\n[t.\"u v\"]\nx = [1, 2.5e-3, inf, -nan, 0o17, 0b11, 1_000]\n"
      "y = { p = true, q = [ { r = \"\\u00e9\\U0001F600\\t\" } ] }\n[[list.of]]\nz = \"\"\"\nmany \\\n   lines\"\"\"\n"
      "[[list.of]]\nd = 1979-05-27T07:32:00.5-07:00\ne = 07:32:00\nf = '''a'b'''\n";
  int read = 0;
  for (std::size_t length = 0; length <= varied.size(); ++length) {
    try {
      parse_text(varied.substr(0, length), "varied.toml");
      ++read;
    } catch (const InputError& error) {
      EXPECT_GT(error.position().line, 0) << error.what();
    } catch (const std::exception& error) {
      ADD_FAILURE() << length << ": " << error.what();
    }
  }
  EXPECT_GT(read, 10);
}

/// `part` a hundred thousand times between `before` and `after`.
void expect_refused(std::string before, const std::string& part, const std::string& after) {
  SCOPED_TRACE(before + part + after);
  for (int i = 0; i < 100000; ++i) before += part;
  EXPECT_THROW(parse_text(before + after, "deep.toml"), InputError);
}

// Nesting deeper than any case: refused, long before it could use up the stack.
TEST(Fuzz, DeepNestingOfValues) {
  expect_refused("a = ", "[", "");
  expect_refused("a = ", "{ a = ", "");
}

TEST(Fuzz, DeepNestingOfKeys) {
  expect_refused("", "a.", "a = 1\n");
}

TEST(Fuzz, DeepNestingOfHeaders) {
  expect_refused("[", "a.", "a]\n");
}

}  // namespace
}  // namespace scarp::input::test
