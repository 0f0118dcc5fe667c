// A TOML file as a light tree that knows where everything stands. The only header that the readers of input/ share; the
// TOML parser itself stays in document.cpp.
#pragma once

#include <map>
#include <string>
#include <variant>
#include <vector>

#include "scarp/base/error.hpp"

namespace scarp::input {

struct Node;
using List = std::vector<Node>;
using Keys = std::map<std::string, Node>;

/// A value with its place. Whole numbers and others are both double; `whole` tells them apart.
struct Node {
  Position position;
  std::variant<bool, double, std::string, List, Keys> value;
  bool whole = false;

  bool is_table() const { return std::holds_alternative<Keys>(value); }
  bool is_list() const { return std::holds_alternative<List>(value); }
};

/// What a node holds, for messages: "the number 0.7", "the text \"clay\"", "a list of 3 items", "a table", "true".
std::string describe(const Node& node);
/// "1 item", "3 items".
std::string count_of_items(std::size_t count);

/// Parses a file. Throws InputError for a file that cannot be read, and with line and column for one that is not TOML.
Node parse_file(const std::string& path);

/// The text of a file, without a byte order mark. Throws InputError for one that cannot be read or is not UTF-8.
std::string read_text(const std::string& path);

/// Parses text; `name` stands for the file in messages.
Node parse_text(const std::string& text, const std::string& name);

/// The tree as TOML, to the last digit: keys in alphabetical order, without the comments of the file.
std::string to_toml(const Node& document);

/// Changes the tree by "key=value" (see read_case). Throws InputError that names the override.
void apply_override(Node& document, const std::string& text);

}  // namespace scarp::input
