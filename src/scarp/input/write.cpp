// A tree back into TOML: the case as it was run.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "scarp/input/document.hpp"

namespace scarp::input {
namespace {

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      out += {'\\', c};
    } else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F) {
      out += fmt::format("\\u{:04X}", static_cast<unsigned char>(c));
    } else {
      out += c;
    }
  }
  return out + '"';
}

std::string key_text(const std::string& key) {
  const bool bare = !key.empty() && std::all_of(key.begin(), key.end(), [](unsigned char c) {
    return c < 128 && (std::isalnum(c) || c == '_' || c == '-');
  });
  return bare ? key : quoted(key);
}

std::string number_text(double value, bool whole) {
  if (whole) return fmt::format("{:.0f}", value);
  const std::string digits = fmt::format("{}", value);  // as many as it takes
  return digits.find_first_of(".e") == std::string::npos ? digits + ".0" : digits;
}

/// A value on one line.
std::string value_text(const Node& node) {
  if (const auto* truth = std::get_if<bool>(&node.value)) return *truth ? "true" : "false";
  if (const auto* number = std::get_if<double>(&node.value)) return number_text(*number, node.whole);
  if (const auto* text = std::get_if<std::string>(&node.value)) return quoted(*text);
  std::string out, between;
  if (const auto* list = std::get_if<List>(&node.value)) {
    for (const auto& item : *list) {
      out += between + value_text(item);
      between = ", ";
    }
    return '[' + out + ']';
  }
  for (const auto& [key, value] : std::get<Keys>(node.value)) {
    out += between + key_text(key) + " = " + value_text(value);
    between = ", ";
  }
  return "{ " + out + " }";
}

bool is_tables(const Node& node) {
  const auto* list = std::get_if<List>(&node.value);
  return list && !list->empty() && std::all_of(list->begin(), list->end(), [](const Node& n) { return n.is_table(); });
}

std::string lines(const Keys& keys) {
  std::string out;
  for (const auto& [key, value] : keys) out += fmt::format("{} = {}\n", key_text(key), value_text(value));
  return out;
}

}  // namespace

std::string to_toml(const Node& document) {
  const auto& keys = std::get<Keys>(document.value);
  std::string out, tables;
  for (const auto& [key, value] : keys) {
    if (value.is_table()) {
      tables += fmt::format("\n[{}]\n{}", key_text(key), lines(std::get<Keys>(value.value)));
    } else if (is_tables(value)) {
      for (const auto& item : std::get<List>(value.value))
        tables += fmt::format("\n[[{}]]\n{}", key_text(key), lines(std::get<Keys>(item.value)));
    } else {
      out += fmt::format("{} = {}\n", key_text(key), value_text(value));
    }
  }
  return out + tables;
}

}  // namespace scarp::input
