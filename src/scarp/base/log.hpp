// Messages to the user while the program runs: to standard error, so that standard output stays clean.
#pragma once

#include <string>

namespace scarp::logging {

void info(const std::string& text);
void warn(const std::string& text);

}  // namespace scarp::logging
