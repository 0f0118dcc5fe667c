// Where a key of a case belongs that stands in the wrong table.
#pragma once

#include <string>
#include <vector>

namespace scarp::input {

/// The table that has this key, such as "[[region]]" or "[[material]] (of subloading)", as messages call it; "" for a
/// key that no table of a case has.
std::string elsewhere(const std::string& key);

/// A table of a case, as messages call it, with its keys.
struct TableKeys {
  std::string table;
  std::vector<std::string> keys;
};

/// The keys that a slip puts into another table: those of the readers but for names, tables and places in space. A test
/// asks the readers for theirs and compares (tests/unit/input/elsewhere_test.cpp).
std::vector<TableKeys> keys_of_tables();

}  // namespace scarp::input
