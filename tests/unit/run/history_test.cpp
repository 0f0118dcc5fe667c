// What is declared once is in the documents, too.
#include "scarp/run/history.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

namespace scarp::run {
namespace {

std::string page(const std::string& name) {
  std::ifstream file(std::string(SCARP_SOURCE_DIR) + "/docs/" + name);
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

/// A case with use for every column.
input::CaseOf<3> with_everything() {
  input::CaseOf<3> input;
  input.stages.emplace_back();
  input.stages.back().release = 1;
  input.boundaries.emplace_back();
  input.boundaries.back().absorbing.emplace();
  return input;
}

TEST(History, EachColumnIsInTheDocuments) {
  const std::string text = page("output.md");
  for (const auto& column : history_columns<3>(with_everything())) {
    const auto line = fmt::format("| `{}` | {}{}| {}{}|\n", column.key, column.unit, column.unit.empty() ? "" : " ",
                                  column.meaning, column.meaning.empty() ? "" : " ");
    EXPECT_NE(text.find(line), std::string::npos) << "docs/output.md, history.csv, lacks the line\n" << line;
  }
}

TEST(History, ColumnsWithoutUseAreLeftOut) {
  const auto all = history_columns<3>(with_everything());
  const auto few = history_columns<2>({});
  EXPECT_EQ(all.size(),
            few.size() + 5);  // momentum_z, work_release, work_boundary, dissipation_absorbing, stored_sides
  for (const auto& column : few) EXPECT_NE(column.key, "work_release");
}

TEST(History, TheBalanceIsOfAllTerms) {
  Ledger<2> ledger;
  double balanced = 0;
  int n = 0;
  for (const auto& term : energy_terms) {
    ledger.*term.sum = ++n;
    balanced += term.sign * n;
  }
  EXPECT_DOUBLE_EQ(ledger.energy_error(), -balanced);
  StepTotals<2> totals;
  for (const auto& term : energy_terms) totals.*term.sum = 100;
  ledger.add(0.1, 1, totals);
  n = 0;
  for (const auto& term : energy_terms) EXPECT_EQ(ledger.*term.sum, 100 + ++n) << term.key;
}

}  // namespace
}  // namespace scarp::run
