// Where a key of a case belongs that stands in the wrong table.
#pragma once

#include <string>

namespace scarp::input {

/// The table that has this key, such as "[[region]]" or "[[material]] (of subloading)", as messages call it; "" for a
/// key that no table of a case has.
std::string elsewhere(const std::string& key);

}  // namespace scarp::input
