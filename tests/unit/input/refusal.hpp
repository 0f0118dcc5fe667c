// Bad files: each gives one InputError with its place, what is wrong, the value found and a remedy.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "minimal.hpp"

namespace scarp::input::test {

/// `from` in a good file is replaced by `to`. The place that the error must name is the oracle for line and
/// column: an @ in `to`, which is taken out before reading, or else where the text `at` starts. Without either the
/// error names the file alone.
struct Bad {
  std::string from, to;
  std::string problem;  ///< a part of what is wrong
  std::string value;    ///< a part of the value found
  std::string remedy;   ///< a part of the remedy
  std::string at = {};
};

inline Position place_of(const std::string& text, std::size_t at) {
  const auto line = std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n') + 1;
  const auto start = at == 0 ? std::string::npos : text.rfind('\n', at - 1);
  return {"", static_cast<int>(line), static_cast<int>(start == std::string::npos ? at + 1 : at - start)};
}

/// Demands that `read_file(path)` refuses the good text with the change of `bad`.
template <class Read>
void expect_refused(const std::string& good, const Bad& bad, Read&& read_file) {
  SCOPED_TRACE(bad.from + "  ->  " + bad.to);
  std::string text = replaced(good, bad.from, bad.to);
  Position place;
  if (const auto mark = text.find('@'); mark != std::string::npos) {
    place = place_of(text, mark);
    text.erase(mark, 1);
  } else if (!bad.at.empty()) {
    place = place_of(text, text.find(bad.at));
  }
  const CaseFile file(text);
  try {
    read_file(file.path());
    ADD_FAILURE() << "no error";
  } catch (const InputError& error) {
    EXPECT_EQ(error.position().file, file.path());
    EXPECT_EQ(error.position().line, place.line) << error.what();
    EXPECT_EQ(error.position().column, place.column) << error.what();
    EXPECT_NE(error.problem().find(bad.problem), std::string::npos) << error.what();
    EXPECT_NE(error.value().find(bad.value), std::string::npos) << error.what();
    EXPECT_NE(error.remedy().find(bad.remedy), std::string::npos) << error.what();
    EXPECT_FALSE(error.remedy().empty());
  }
}

/// Demands that the minimal case is refused with each change of a table.
inline void expect_all_refused(const std::vector<Bad>& table) {
  for (const auto& bad : table) expect_refused(minimal, bad, [](const std::string& path) { read_case(path); });
}

}  // namespace scarp::input::test
