// Laboratory tests for tests: named ones, and the curve of one by columns.
#pragma once

#include <gtest/gtest.h>
#include <algorithm>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include "scarp/base/error.hpp"
#include "scarp/lab/driver.hpp"
#include "scarp/lab/named_tests.hpp"

namespace scarp::test {

/// A curve by columns.
struct Curve {
  std::map<std::string, std::vector<double>> column;
  std::string problem;
  std::size_t rows = 0;

  double last(const std::string& name) const { return column.at(name).back(); }
  const std::vector<double>& operator[](const std::string& name) const { return column.at(name); }
};

inline Curve run(const lab::Test& test) {
  Curve curve;
  EXPECT_TRUE(lab::initial_problems(test).empty());
  const auto names = lab::curve_columns(test.model);
  for (const auto& name : names) curve.column[name] = {};
  try {
    lab::run_test(test, [&](const std::vector<double>& row) {
      ASSERT_EQ(row.size(), names.size());
      for (std::size_t i = 0; i < names.size(); ++i) curve.column[names[i]].push_back(row[i]);
      ++curve.rows;
    });
  } catch (const RunError& error) {
    curve.problem = error.what();
  }
  return curve;
}

/// A named test driven by one of its keys.
inline lab::Stage named(const std::string& type, const std::string& key, const std::vector<double>& targets,
                        int increments) {
  for (const auto& test : lab::named_tests()) {
    if (test.type != type) continue;
    lab::Constraints constraints;
    constraints.cell = test.cell;
    std::copy(test.held.begin(), test.held.end(), constraints.forms.begin());
    for (const auto& drive : test.drives) {
      if (drive.key != key) continue;
      constraints.forms[5] = drive.form;
      constraints.from_start = drive.strain;
      constraints.targets = targets;
      return {type, constraints, increments, 0, {}};
    }
  }
  throw std::invalid_argument(type + " driven by " + key);
}

}  // namespace scarp::test
