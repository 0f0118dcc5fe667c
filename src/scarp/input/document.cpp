#include "scarp/input/document.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string_view>

#include "scarp/base/text.hpp"

// toml++ 3.3.0 asserts on some malformed input: make that an exception like its others.
#define TOML_ASSERT(expression) \
  if (!(expression)) throw std::logic_error("toml++: " #expression)
#define TOML_EXCEPTIONS 1
#define TOML_HEADER_ONLY 1
#if defined(__GNUC__) && !defined(__clang__)
// Some assertions stand in noexcept functions, on what the parser itself has made: there throwing would end the
// program.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wterminate"
#endif
#include <toml++/toml.h>
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic pop
#endif

namespace scarp::input {
namespace {

/// Refuses what toml++ 3.3.0 does not survive: non-ASCII letters outside strings and comments, which it misreads, and
/// keys of thousands of dotted parts, which it follows one call deeper each until the stack ends.
class TextCheck {
 public:
  TextCheck(const std::string& text, const std::string& name) : text_(text), name_(name) {}

  void run() {
    while (at_ < text_.size()) {
      const char c = text_[at_];
      if (c == '#') {
        skip_comment();
      } else if (c == '"' || c == '\'') {
        skip_string(c);
      } else {
        if (static_cast<unsigned char>(c) > 127) {
          refuse("letters outside ASCII stand in quotes or comments only", letter_here(),
                 "put the key or value in quotes, or use plain letters");
        }
        if (c == '.' && ++dots_ > most_dots) {
          refuse("a key has few dotted parts", fmt::format("more than {}", most_dots), "shorten it");
        }
        if (c == '\n' || c == '=' || c == ',' || c == '[' || c == '{') dots_ = 0;
        step();
      }
    }
  }

 private:
  /// What stands here, as it may be shown; what cannot be seen by its name.
  std::string letter_here() const {
    const std::string_view rest = std::string_view(text_).substr(at_);
    if (rest.starts_with("\xEF\xBB\xBF")) return "a byte order mark, which editors do not show";
    if (rest.starts_with("\xC2\xA0")) return "a no-break space";
    const auto first = static_cast<unsigned char>(rest[0]);
    const std::size_t length = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : first >= 0xC2 ? 2 : 1;
    bool whole = length > 1 && first < 0xF5 && rest.size() >= length;
    for (std::size_t k = 1; whole && k < length; ++k) whole = (rest[k] & 0xC0) == 0x80;
    return whole ? std::string(rest.substr(0, length)) : fmt::format("the byte {:02X}", first);
  }

  void step() {
    if (text_[at_] == '\n') {
      ++line_;
      start_ = at_ + 1;
    }
    ++at_;
  }

  void skip_comment() {
    while (at_ < text_.size() && text_[at_] != '\n') ++at_;
  }

  void skip_string(char quote) {
    const std::string triple(3, quote);
    const bool many_lines = text_.compare(at_, 3, triple) == 0;
    for (int k = many_lines ? 3 : 1; k > 0; --k) step();
    while (at_ < text_.size()) {
      if (many_lines && text_.compare(at_, 3, triple) == 0) {
        at_ += 3;
        return;
      }
      const char c = text_[at_];
      if (!many_lines && (c == quote || c == '\n')) {
        step();
        return;
      }
      if (c == '\\' && quote == '"' && at_ + 1 < text_.size()) step();
      step();
    }
  }

  [[noreturn]] void refuse(const std::string& what, const std::string& value, const std::string& remedy) const {
    throw InputError(what, value, remedy, {name_, line_, static_cast<int>(at_ - start_) + 1});
  }

  static constexpr int most_dots = 50;

  const std::string& text_;
  const std::string& name_;
  std::size_t at_ = 0, start_ = 0;
  int line_ = 1, dots_ = 0;  ///< dots of the key under way
};

Position position_of(const toml::source_region& source, const std::string& name) {
  return {name, static_cast<int>(source.begin.line), static_cast<int>(source.begin.column)};
}

Node converted(const toml::node& node, const std::string& name);

Node converted_table(const toml::table& table, const std::string& name) {
  Keys keys;
  for (const auto& [key, value] : table) {
    Node child = converted(value, name);
    // A message about a key points at the key; tables point at their own header.
    if (!child.is_table()) child.position = position_of(key.source(), name);
    keys.emplace(std::string(key.str()), std::move(child));
  }
  return {position_of(table.source(), name), std::move(keys)};
}

Node converted(const toml::node& node, const std::string& name) {
  const Position at = position_of(node.source(), name);
  if (const auto* table = node.as_table()) return converted_table(*table, name);
  if (const auto* list = node.as_array()) {
    List items;
    for (const auto& item : *list) items.push_back(converted(item, name));
    return {at, std::move(items)};
  }
  if (const auto* text = node.as_string()) return {at, text->get()};
  if (const auto* truth = node.as_boolean()) return {at, truth->get()};
  if (const auto* whole = node.as_integer()) return {at, static_cast<double>(whole->get()), true};
  if (const auto* number = node.as_floating_point()) return {at, number->get()};
  throw InputError("dates and times have no place in a case", "one here", "write a number or a text in quotes", at);
}

}  // namespace

Node parse_text(const std::string& text, const std::string& name) {
  TextCheck(text, name).run();
  try {
    const toml::table table = toml::parse(text, name);
    return converted_table(table, name);
  } catch (const toml::parse_error& error) {
    throw InputError(fmt::format("this is not TOML: {}", error.description()), "", "see toml.io for the form",
                     position_of(error.source(), name));
  } catch (const std::logic_error& error) {
    throw InputError("this is not TOML", error.what(), "see toml.io for the form", {name});
  }
}

std::string read_text(const std::string& path) {
  std::error_code none;
  if (std::filesystem::is_directory(path, none))
    throw InputError("the case file cannot be read", path, "that is a folder; name the file in it");
  std::ifstream file(path, std::ios::binary);
  if (!file) {
    throw InputError("the case file cannot be read", path, "check the name and that you may read it");
  }
  std::string text(std::istreambuf_iterator<char>(file), {});
  drop_byte_order_mark(text, path);
  return text;
}

Node parse_file(const std::string& path) {
  return parse_text(read_text(path), path);
}

}  // namespace scarp::input
