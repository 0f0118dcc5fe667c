#include "scarp/base/error.hpp"

#include <fmt/format.h>

namespace scarp {
namespace {

std::string message(const std::string& what, const std::string& value, const std::string& remedy, const Position& at) {
  std::string text;
  if (!at.file.empty()) {
    text += at.file;
    if (at.line > 0) text += fmt::format(":{}", at.line);
    if (at.line > 0 && at.column > 0) text += fmt::format(":{}", at.column);
    text += ": ";
  }
  text += what;
  if (!value.empty()) text += fmt::format("; found {}", value);
  text += ".";
  if (!remedy.empty()) text += fmt::format("\n  remedy: {}", remedy);
  return text;
}

}  // namespace

Error::Error(std::string what, std::string value, std::string remedy, Position position)
    : std::runtime_error(message(what, value, remedy, position)),
      problem_(std::move(what)),
      value_(std::move(value)),
      remedy_(std::move(remedy)),
      position_(std::move(position)) {}

}  // namespace scarp
