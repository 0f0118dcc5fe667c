// Errors: what is wrong, the value found, the remedy, and the place where the file has one.
#pragma once

#include <stdexcept>
#include <string>
#include <utility>

namespace scarp {

/// Where in a user's file something stands. Lines and columns count from 1; 0 means "not known".
struct Position {
  std::string file;
  int line = 0;
  int column = 0;
};

/// An error that the user can mend: says what is wrong, the value found and what to do about it.
class Error : public std::runtime_error {
 public:
  Error(std::string what, std::string value, std::string remedy, Position position = {});

  const std::string& problem() const { return problem_; }
  const std::string& value() const { return value_; }
  const std::string& remedy() const { return remedy_; }
  const Position& position() const { return position_; }

 private:
  std::string problem_, value_, remedy_;
  Position position_;
};

/// Bad input, found before a computation starts (exit status 2).
class InputError : public Error {
 public:
  using Error::Error;
};

/// A computation that cannot go on (exit status 3).
class RunError : public Error {
 public:
  using Error::Error;
};

}  // namespace scarp
