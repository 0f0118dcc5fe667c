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
/// In place of those: the ones of a run that is gone on with.
void set_warnings(std::vector<std::string> warnings);

/// A line of text for the user on standard error as it is, and into a Copy.
void line(const std::string& text);

/// A line into a Copy alone.
void note(const std::string& text);

/// While it lives, all messages and lines are also added to a file, each with its date and time. Where the file cannot
/// be written there is none.
class Copy {
 public:
  explicit Copy(const std::string& path);
  ~Copy();
  Copy(const Copy&) = delete;
  Copy& operator=(const Copy&) = delete;
};

}  // namespace scarp::logging
