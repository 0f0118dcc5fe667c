// Reading a table of the case file: each key once, with its type and bounds; keys that nobody asked for are errors.
#pragma once

#include <array>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "scarp/input/document.hpp"

namespace scarp::input {

/// Bounds of a number, for checks and messages.
struct Range {
  double low, high;
  bool low_open = false, high_open = false;
};
inline constexpr double unbounded = 1e300;
inline constexpr Range any_number{-unbounded, unbounded};
inline constexpr Range positive{0, unbounded, true, false};
inline constexpr Range not_negative{0, unbounded};

/// A number within bounds, or InputError with its place. `name` is how the message calls it.
double number_in(const Node& node, const std::string& name, const Range& range);
/// A list of `count` numbers; any count when 0.
std::vector<double> numbers_in(const Node& node, const std::string& name, std::size_t count);
std::string text_in(const Node& node, const std::string& name);

class Table {
 public:
  /// `title` is how messages call the table, such as "[mesh]" or "[[region]]".
  Table(const Node& node, std::string title);

  const Position& position() const { return node_.position; }
  /// The node of a key, or nullptr; the key counts as read.
  const Node* find(const std::string& key);
  /// The same, without counting it as read.
  const Node* look(const std::string& key) const;
  /// The node of a key that must be there.
  const Node& need(const std::string& key, const std::string& remedy);

  double number(const std::string& key, const Range& range, const std::string& remedy);
  double number_or(const std::string& key, const Range& range, double standard);
  int whole_or(const std::string& key, int low, int high, int standard);
  bool truth_or(const std::string& key, bool standard);
  std::string text(const std::string& key, const std::string& remedy);
  std::string text_or(const std::string& key, const std::string& standard);

  /// All keys that have not been read, with their nodes; they count as read from then on.
  std::vector<std::pair<std::string, const Node*>> rest();
  /// Throws InputError for a key that nobody read.
  void finish() const;

 private:
  const Node& node_;
  const Keys& keys_;
  std::string title_;
  std::set<std::string> asked_;
};

}  // namespace scarp::input
