// Files as editors and spreadsheets on Windows save them: the mark of UTF-8 is passed over, UTF-16 is named.
#include <gtest/gtest.h>

#include "minimal.hpp"
#include "scarp/base/error.hpp"
#include "scarp/base/text.hpp"
#include "scarp/input/csv.hpp"
#include "scarp/input/document.hpp"
#include "scarp/input/lab_test.hpp"
#include "scarp/input/stl.hpp"
#include "scarp/mesh/gmsh.hpp"

namespace scarp::input::test {
namespace {

const std::string mark = "\xEF\xBB\xBF";

/// ASCII letters as UTF-16, with or without its mark.
std::string utf16(const std::string& text, bool little_endian, bool marked) {
  std::string bytes = !marked ? "" : little_endian ? "\xFF\xFE" : "\xFE\xFF";
  for (const char c : text) bytes += little_endian ? std::string{c, '\0'} : std::string{'\0', c};
  return bytes;
}

template <class Read>
void expect_utf16_named(const std::string& text, Read&& read_file) {
  for (const bool little : {true, false}) {
    for (const bool marked : {true, false}) {
      const CaseFile file(utf16(text, little, marked));
      try {
        read_file(file.path());
        ADD_FAILURE() << "no error";
      } catch (const InputError& error) {
        EXPECT_EQ(error.position().file, file.path());
        EXPECT_NE(error.value().find("UTF-16"), std::string::npos) << error.what();
        EXPECT_NE(error.remedy().find("save it as UTF-8"), std::string::npos) << error.what();
      }
    }
  }
}

const std::string lab = R"([material]
model = "linear-elastic"
E = 1e4
nu = 0.3
[initial]
stress = [100, 100, 100, 0, 0, 0]
[[stage]]
type = "isotropic"
p = 200
)";

const std::string msh =
    "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n3\n1 0 0 0\n2 1 0 0\n3 0 1 0\n$EndNodes\n"
    "$Elements\n1\n1 2 2 0 1 1 2 3\n$EndElements\n";

const std::string facets[] = {"0 0 0 vertex 0 1 0 vertex 1 0 0", "0 0 0 vertex 1 0 0 vertex 0 0 1",
                              "0 0 0 vertex 0 0 1 vertex 0 1 0", "1 0 0 vertex 0 1 0 vertex 0 0 1"};

std::string stl() {
  std::string text = "solid hill\n";
  for (const auto& corners : facets) text += "facet normal 0 0 0 outer loop vertex " + corners + " endloop endfacet\n";
  return text + "endsolid hill\n";
}

TEST(Encoding, Cases) {
  EXPECT_EQ(read(mark + minimal).title, "two columns");
  expect_utf16_named(minimal, [](const auto& path) { read_case(path); });
}

TEST(Encoding, LaboratoryTests) {
  const CaseFile file(mark + lab);
  EXPECT_EQ(read_lab_test(file.path(), {}).test.stages.size(), 1u);
  expect_utf16_named(lab, [](const auto& path) { read_lab_test(path, {}); });
}

TEST(Encoding, Columns) {
  const std::vector<std::vector<double>> rows{{1, 2}};
  for (const std::string text : {"a,b\r\n1,2\r\n", "1,2\n", "# of a spreadsheet\na,b\n1,2\n"}) {
    EXPECT_EQ(read_columns(CaseFile(mark + text).path(), {"a", "b"}), rows) << text;
  }
  expect_utf16_named("a,b\n1,2\n", [](const auto& path) { read_columns(path, {"a", "b"}); });
}

TEST(Encoding, Meshes) {
  const CaseFile file(mark + msh);
  EXPECT_EQ(read_gmsh<2>(file.path()).element_count(), 1);
  expect_utf16_named(msh, [](const auto& path) { read_gmsh<2>(path); });
}

TEST(Encoding, Surfaces) {
  const CaseFile file(mark + stl());
  EXPECT_NEAR(read_stl(file.path()).moments().volume, 1.0 / 6, 1e-15);
  expect_utf16_named(stl(), [](const auto& path) { read_stl(path); });
}

TEST(Encoding, OfFourBytesALetterIsNamed) {
  for (const std::string& bytes : {std::string("\xFF\xFE\0\0a\0\0\0", 8), std::string("a\0\0\0", 4)}) {
    std::string text = bytes;
    try {
      drop_byte_order_mark(text, "file");
      ADD_FAILURE() << "no error";
    } catch (const InputError& error) {
      EXPECT_NE(error.value().find("UTF-32"), std::string::npos) << error.what();
    }
  }
}

/// Letters that do not stand in quotes are shown; those that an editor does not show, named.
TEST(Encoding, TheLetterIsShown) {
  const std::vector<std::pair<std::string, std::string>> letters = {
      {"\xC3\xA4", "\xC3\xA4"}, {mark, "a byte order mark"}, {"\xC2\xA0", "a no-break space"}, {"\xE4", "byte E4"}};
  for (const auto& [letter, shown] : letters) {
    try {
      parse_text("a = 1\n" + letter + "b = 2\n", "case");
      ADD_FAILURE() << "no error";
    } catch (const InputError& error) {
      EXPECT_EQ(error.position().line, 2);
      EXPECT_NE(error.value().find(shown), std::string::npos) << error.what();
    }
  }
}

// toml++ asks of the letter after the end of such a line whether it is blank, and holds it for impossible.
TEST(Encoding, AccentedLettersAfterAJoinedLine) {
  const auto node = parse_text("a = \"\"\"one \\\n  \u00E9t\u00E9\"\"\"\n", "case.toml");
  EXPECT_EQ(std::get<std::string>(std::get<Keys>(node.value).at("a").value), "one \u00E9t\u00E9");
  EXPECT_THROW(parse_text("a = \"\"\"\\\u036C\"\"\"\n", "case.toml"), InputError);
}

TEST(Encoding, TextsThatEndInQuotes) {
  const auto node = parse_text("a = \"\"\"one\"\"\"\"\"\nb = '''two''''\n", "case.toml");
  EXPECT_EQ(std::get<std::string>(std::get<Keys>(node.value).at("a").value), "one\"\"");
  EXPECT_EQ(std::get<std::string>(std::get<Keys>(node.value).at("b").value), "two'");
}

}  // namespace
}  // namespace scarp::input::test
