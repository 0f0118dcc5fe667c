// Messages to the user while the program runs: to standard error, so that standard output stays clean.
#pragma once

#include <string>
#include <vector>

namespace scarp::logging {

void info(const std::string& text);
void warn(const std::string& text);

/// The warnings since the start, or since they were last forgotten: for summary.json.
std::vector<std::string> warnings();
void forget_warnings();

}  // namespace scarp::logging
