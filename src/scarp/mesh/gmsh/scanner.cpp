#include "scarp/mesh/gmsh/scanner.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <cstring>

#include "scarp/base/error.hpp"

namespace scarp::gmsh {
namespace {

constexpr const char* damaged = "the file is damaged or was changed by hand; write it again with Gmsh";

bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\r';
}

}  // namespace

std::string shown(std::string_view text) {
  constexpr std::size_t most = 40;
  std::string out = "\"";
  for (char c : text.substr(0, most)) out += c >= ' ' && c <= '~' ? c : '?';
  return out + (text.size() > most ? "...\"" : "\"");
}

void Scanner::fail(const std::string& problem, const std::string& value, const std::string& remedy,
                   std::size_t where) const {
  if (binary_) throw InputError(fmt::format("{} (at byte {})", problem, where), value, remedy, {file_, 0, 0});
  throw InputError(problem, value, remedy, {file_, static_cast<int>(where), 0});
}

void Scanner::cut_short(const char* what) const {
  fail(fmt::format("the file ends where {} should be", what), fmt::format("{} bytes in all", bytes_.size()),
       "the file is cut short; write it again with Gmsh", here());
}

void Scanner::skip_blanks() {
  while (at_ < bytes_.size() && is_blank(bytes_[at_])) ++at_;
}

bool Scanner::skip_space() {
  while (true) {
    skip_blanks();
    if (at_ == bytes_.size()) return false;
    if (bytes_[at_] != '\n') return true;
    ++at_;
    ++line_;
  }
}

std::string_view Scanner::line(const char* what) {
  if (at_ == bytes_.size()) cut_short(what);
  const std::size_t end = std::min(bytes_.find('\n', at_), bytes_.size());
  std::string_view text = std::string_view(bytes_).substr(at_, end - at_);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  at_ = end;
  if (at_ < bytes_.size()) {
    ++at_;
    ++line_;
  }
  return text;
}

std::string_view Scanner::word(const char* what) {
  skip_blanks();
  if (at_ == bytes_.size()) cut_short(what);
  last_ = at_;
  while (at_ < bytes_.size() && !is_blank(bytes_[at_]) && bytes_[at_] != '\n') ++at_;
  if (at_ == last_) fail(fmt::format("this line ends where {} should be", what), "", damaged, here());
  return std::string_view(bytes_).substr(last_, at_ - last_);
}

template <class T>
T Scanner::parse(std::string_view text, const char* what, const char* kind) {
  T value{};
  const std::string_view digits = text.starts_with('+') ? text.substr(1) : text;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error != std::errc() || end != digits.data() + digits.size())
    fail(fmt::format("{} must be {}", what, kind), shown(text), damaged, last());
  return value;
}

template <class T>
T Scanner::raw(const char* what) {
  if (bytes_.size() - at_ < sizeof(T)) cut_short(what);
  T value;
  std::memcpy(&value, bytes_.data() + at_, sizeof(T));
  last_ = at_;
  at_ += sizeof(T);
  return value;
}

std::int64_t Scanner::text_integer(const char* what) {
  return parse<std::int64_t>(word(what), what, "a whole number");
}

std::int64_t Scanner::integer(const char* what) {
  return binary_ ? raw<std::int32_t>(what) : text_integer(what);
}

std::uint64_t Scanner::size(const char* what) {
  return binary_ ? raw<std::uint64_t>(what) : parse<std::uint64_t>(word(what), what, "a whole number from 0");
}

double Scanner::number(const char* what) {
  const double value = binary_ ? raw<double>(what) : parse<double>(word(what), what, "a number");
  if (!std::isfinite(value))
    fail(fmt::format("{} must be a finite number", what), fmt::format("{}", value), damaged, last());
  return value;
}

void Scanner::begin_record() {
  if (!binary_) skip_space();
}

void Scanner::end_record() {
  if (binary_) return;
  skip_blanks();
  if (at_ == bytes_.size()) return;
  if (bytes_[at_] != '\n') fail("this line holds more than it should", shown(word("")), damaged, here());
  ++at_;
  ++line_;
}

std::size_t Scanner::checked_count(std::uint64_t count, std::size_t bytes_in_ascii, std::size_t bytes_in_binary,
                                   const char* what) {
  const std::size_t left = bytes_.size() - at_, each = binary_ ? bytes_in_binary : bytes_in_ascii;
  // One more byte than is left: the last line of a text may lack its end.
  if (count > (left + 1) / each)
    fail(fmt::format("the file cannot hold that many {}", what),
         fmt::format("{} with {} bytes left in the file", count, left),
         "the count is wrong or the file is cut short; write it again with Gmsh", last());
  return count;
}

void Scanner::end_section(const std::string& name) {
  const std::string end = "$End" + name;
  if (!skip_space()) cut_short(end.c_str());
  const std::size_t where = here(), start = at_;
  const std::string_view text = word(end.c_str());
  if (text == end) return;
  last_ = start;
  fail(fmt::format("the section ${} should end here with {}", name, end), shown(text),
       "its count is wrong or the file is damaged; write it again with Gmsh", where);
}

void Scanner::skip_section(const std::string& name) {
  const std::string end = "\n$End" + name;
  const std::size_t where = here(), found = bytes_.find(end, at_);
  if (found == std::string::npos)
    fail(fmt::format("the section {} has no end", shown("$" + name)), "",
         "the file is cut short; write it again with Gmsh", where);
  for (std::size_t i = at_; i <= found; ++i) line_ += bytes_[i] == '\n' ? 1 : 0;
  at_ = found + end.size();
}

}  // namespace scarp::gmsh
