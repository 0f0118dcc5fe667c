// Overrides of single values: --set key=value.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <optional>

#include "scarp/input/document.hpp"

namespace scarp::input {
namespace {

std::vector<std::string> split(const std::string& path) {
  std::vector<std::string> parts(1);
  for (const char c : path) {
    if (c == '.') {
      parts.emplace_back();
    } else {
      parts.back() += c;
    }
  }
  return parts;
}

bool is_index(const std::string& text) {
  return !text.empty() && text.size() < 6 &&
         std::all_of(text.begin(), text.end(), [](unsigned char c) { return std::isdigit(c); });
}

std::string name_of(const Node& item) {
  if (!item.is_table()) return {};
  const auto& keys = std::get<Keys>(item.value);
  const auto found = keys.find("name");
  if (found == keys.end()) return {};
  const auto* text = std::get_if<std::string>(&found->second.value);
  return text ? *text : std::string{};
}

void set_positions(Node& node, const Position& at) {
  node.position = at;
  if (auto* list = std::get_if<List>(&node.value)) {
    for (auto& item : *list) set_positions(item, at);
  }
  if (auto* keys = std::get_if<Keys>(&node.value)) {
    for (auto& [key, item] : *keys) set_positions(item, at);
  }
}

/// A number as people write it and TOML does not: .5, 5., +.5e3, 007.
std::optional<double> loose_number(const std::string& text) {
  if (text.find_first_not_of("0123456789+-.eE") != text.npos) return {};
  char* end = nullptr;
  const double number = std::strtod(text.c_str(), &end);
  return end != text.c_str() && *end == '\0' ? std::optional<double>(number) : std::nullopt;
}

/// The value of an override: as TOML, or else a number, or a bare word as text.
Node parsed_value(const std::string& value, const Position& at) {
  if (value.find('\n') != std::string::npos)
    throw InputError("an override sets one value", "more than one line", "give --set once for each value", at);
  Node node;
  try {
    node = std::get<Keys>(parse_text("value = " + value, "").value).at("value");
  } catch (const InputError&) {
    if (const auto number = loose_number(value)) {
      node.value = *number;
      node.whole = value.find_first_of(".eE") == value.npos;
      set_positions(node, at);
      return node;
    }
    const bool word = !value.empty() && std::all_of(value.begin(), value.end(), [](unsigned char c) {
      return std::isalnum(c) || c == '_' || c == '-' || c == '.' || c == '/' || c == ' ';
    });
    if (!word)
      throw InputError("the value of this override is not TOML", value,
                       "write a number, true, a text in quotes or a list", at);
    node.value = value;
  }
  set_positions(node, at);
  return node;
}

/// The item of an array of tables with this name or number.
Node& item_of(List& list, const std::string& part, const Position& at) {
  std::vector<std::string> names;
  for (auto& item : list) {
    if (name_of(item) == part && !part.empty()) return item;
    names.push_back(name_of(item));
  }
  if (is_index(part) && std::stoul(part) < list.size()) return list[std::stoul(part)];
  throw InputError(fmt::format("there is no item \"{}\" to override", part),
                   fmt::format("{} items: {}", list.size(), fmt::join(names, ", ")), "use a name or a number from 0",
                   at);
}

}  // namespace

void apply_override(Node& document, const std::string& text) {
  const Position at{"--set " + text, 0, 0};
  const auto equals = text.find('=');
  if (equals == std::string::npos || equals == 0) {
    throw InputError("an override has the form key=value", '"' + text + '"', "for instance --set stage.cut.duration=4",
                     at);
  }
  const auto parts = split(text.substr(0, equals));
  Node value = parsed_value(text.substr(equals + 1), at);
  Node* node = &document;
  for (std::size_t k = 0; k < parts.size(); ++k) {
    const bool last = k + 1 == parts.size();
    if (auto* list = std::get_if<List>(&node->value)) {
      node = &item_of(*list, parts[k], at);
      if (last) *node = std::move(value);
      continue;
    }
    auto* keys = std::get_if<Keys>(&node->value);
    if (!keys || parts[k].empty()) {
      throw InputError(fmt::format("the override leads nowhere: \"{}\" has no keys", k == 0 ? text : parts[k - 1]),
                       describe(*node), "name a key of the case file", at);
    }
    if (last) {
      (*keys)[parts[k]] = std::move(value);
    } else {
      const auto next = keys->find(parts[k]);
      if (next == keys->end()) {
        // An optional table that the file leaves out, such as [method].
        node = &keys->emplace(parts[k], Node{at, Keys{}}).first->second;
      } else {
        node = &next->second;
      }
    }
  }
}

std::string count_of_items(std::size_t count) {
  return fmt::format("{} item{}", count, count == 1 ? "" : "s");
}

std::string describe(const Node& node) {
  if (const auto* truth = std::get_if<bool>(&node.value)) return *truth ? "true" : "false";
  if (const auto* number = std::get_if<double>(&node.value)) return fmt::format("the number {}", *number);
  if (const auto* text = std::get_if<std::string>(&node.value)) return fmt::format("the text \"{}\"", *text);
  const auto* list = std::get_if<List>(&node.value);
  return !list ? "a table" : list->empty() ? "an empty list" : "a list of " + count_of_items(list->size());
}

}  // namespace scarp::input
