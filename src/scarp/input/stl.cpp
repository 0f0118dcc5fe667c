#include "scarp/input/stl.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <string_view>

#include "scarp/base/error.hpp"
#include "scarp/base/text.hpp"

namespace scarp::input {
namespace {

constexpr const char* damaged = "the file is damaged; write it again";
constexpr std::size_t header = 84, record = 50;  ///< bytes of a binary file: the head, one triangle

/// Triangles, and the line or byte at which each begins.
struct Triangles {
  std::vector<Triangle> triangle;
  std::vector<std::size_t> place;
};

bool is_blank(char c) {
  return c == ' ' || c == '\t' || c == '\r' || c == '\n' || c == '\f' || c == '\v';
}

/// A word as it may be shown: short, and without bytes that a terminal cannot show.
std::string shown(std::string_view text) {
  constexpr std::size_t most = 40;
  std::string out = "\"";
  for (const char c : text.substr(0, most)) out += c >= ' ' && c <= '~' ? c : '?';
  return out + (text.size() > most ? "...\"" : "\"");
}

/// The words of an ASCII file, one after the other. Case does not matter.
class Words {
 public:
  Words(const std::string& file, std::string_view bytes) : file_(file), bytes_(bytes) {}

  std::size_t line() const { return line_; }

  /// The next word, or an empty one at the end of the file.
  std::string_view next() {
    while (at_ < bytes_.size() && is_blank(bytes_[at_])) pass();
    line_ = present_;
    const std::size_t first = at_;
    while (at_ < bytes_.size() && !is_blank(bytes_[at_])) ++at_;
    return bytes_.substr(first, at_ - first);
  }

  void skip_line() {
    while (at_ < bytes_.size() && bytes_[at_] != '\n') ++at_;
  }

  static bool is(std::string_view word, std::string_view wanted) {
    return std::equal(word.begin(), word.end(), wanted.begin(), wanted.end(),
                      [](char a, char b) { return (a >= 'A' && a <= 'Z' ? a - 'A' + 'a' : a) == b; });
  }

  void expect(std::string_view wanted) {
    const auto word = next();
    if (!is(word, wanted)) fail(fmt::format("here must be \"{}\"", wanted), word);
  }

  double number() {
    const auto word = next();
    const auto digits = word.starts_with('+') ? word.substr(1) : word;
    double value = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (word.empty() || error != std::errc() || end != digits.data() + digits.size() || !std::isfinite(value))
      fail("a coordinate is a finite number", word);
    return value;
  }

  [[noreturn]] void fail(const std::string& problem, std::string_view word) const {
    throw InputError(problem, word.empty() ? "the end of the file" : shown(word),
                     word.empty() ? "the file is cut short; write it again" : damaged,
                     {file_, static_cast<int>(line_), 0});
  }

 private:
  void pass() {
    if (bytes_[at_++] == '\n') ++present_;
  }

  const std::string& file_;
  std::string_view bytes_;
  std::size_t at_ = 0, line_ = 1, present_ = 1;
};

Triangles read_ascii(const std::string& name, std::string_view bytes) {
  Triangles found;
  Words words(name, bytes);
  words.expect("solid");
  words.skip_line();
  for (;;) {
    const auto word = words.next();
    if (Words::is(word, "endsolid")) {
      words.skip_line();
      const auto more = words.next();  // some programs write several solids into one file
      if (more.empty()) return found;
      if (!Words::is(more, "solid")) words.fail("after a solid comes the next one or the end of the file", more);
      words.skip_line();
      continue;
    }
    if (!Words::is(word, "facet")) words.fail("here must be \"facet\" or \"endsolid\"", word);
    found.place.push_back(words.line());
    words.expect("normal");
    for (int j = 0; j < 3; ++j) words.next();  // never needed, and not a number in some files
    words.expect("outer");
    words.expect("loop");
    Triangle triangle;
    for (auto& corner : triangle) {
      words.expect("vertex");
      for (double& coordinate : corner) coordinate = words.number();
    }
    words.expect("endloop");
    words.expect("endfacet");
    found.triangle.push_back(triangle);
  }
}

/// Little-endian, whatever the machine.
std::uint32_t word_at(std::string_view bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (int i = 3; i >= 0; --i) value = value << 8 | static_cast<unsigned char>(bytes[at + static_cast<std::size_t>(i)]);
  return value;
}

Triangles read_binary(const std::string& name, std::string_view bytes) {
  const std::size_t count = word_at(bytes, 80);
  if (bytes.size() != header + record * count) {
    throw InputError(
        "the length of the STL file does not fit its number of triangles (at byte 80)",
        fmt::format("{} triangles, which need {} bytes, in {} bytes", count, header + record * count, bytes.size()),
        "the file is cut short, or neither ASCII (which begins with solid) nor binary STL; write it again",
        {name, 0, 0});
  }
  Triangles found;
  found.triangle.reserve(count);
  for (std::size_t t = 0; t < count; ++t) {
    Triangle triangle;
    found.place.push_back(header + record * t);
    for (std::size_t k = 0; k < 9; ++k) {
      const std::size_t at = found.place.back() + 12 + 4 * k;  // after the normal
      const double value = std::bit_cast<float>(word_at(bytes, at));
      if (!std::isfinite(value))
        throw InputError(fmt::format("a coordinate is a finite number (at byte {})", at), fmt::format("{}", value),
                         damaged, {name, 0, 0});
      triangle[k / 3][k % 3] = value;
    }
    found.triangle.push_back(triangle);
  }
  return found;
}

/// Binary files may begin with "solid" or with what looks like a mark of text: their length gives them away.
bool has_binary_length(std::string_view bytes) {
  return bytes.size() >= header && bytes.size() == header + record * std::size_t{word_at(bytes, 80)};
}

bool is_ascii(std::string_view bytes) {
  if (has_binary_length(bytes)) return false;
  std::size_t first = 0;
  while (first < bytes.size() && is_blank(bytes[first])) ++first;
  return Words::is(bytes.substr(first, 5), "solid") || bytes.size() < header;
}

}  // namespace

Surface parse_stl(const std::string& name, std::string bytes) {
  if (!has_binary_length(bytes)) drop_byte_order_mark(bytes, name);
  const bool ascii = is_ascii(bytes);
  Triangles found = ascii ? read_ascii(name, bytes) : read_binary(name, bytes);
  if (const auto fault = surface_fault(found.triangle)) {
    const std::size_t place = found.place.empty() ? 0 : found.place[fault->triangle];
    if (ascii) throw InputError(fault->problem, fault->value, fault->remedy, {name, static_cast<int>(place), 0});
    throw InputError(fmt::format("{} (at byte {})", fault->problem, place), fault->value, fault->remedy, {name, 0, 0});
  }
  return Surface(std::move(found.triangle));
}

Surface read_stl(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
  if (!file.is_open() || file.bad())
    throw InputError("the STL file cannot be read", path, "give the name of a file that may be read", {path, 0, 0});
  return parse_stl(path, std::move(bytes));
}

}  // namespace scarp::input
