#include "scarp/input/table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "scarp/base/words.hpp"
#include "scarp/input/elsewhere.hpp"

namespace scarp::input {
namespace {

std::string bounds_text(const std::string& name, const Range& range) {
  std::string text;
  if (range.low > -unbounded) text += fmt::format("{} {} ", range.low, range.low_open ? "<" : "<=");
  text += name;
  if (range.high < unbounded) text += fmt::format(" {} {}", range.high_open ? "<" : "<=", range.high);
  return text;
}

}  // namespace

double number_in(const Node& node, const std::string& name, const Range& range) {
  const auto* value = std::get_if<double>(&node.value);
  if (!value)
    throw InputError(fmt::format("{} is a number", name), describe(node), "write a number, without quotes",
                     node.position);
  if (!std::isfinite(*value))
    throw InputError(fmt::format("{} is finite", name), fmt::format("{}", *value), "write a finite number",
                     node.position);
  const bool low = *value < range.low || (range.low_open && *value == range.low);
  const bool high = *value > range.high || (range.high_open && *value == range.high);
  if (low || high) {
    throw InputError(fmt::format("{} must satisfy {}", name, bounds_text(name, range)), fmt::format("{}", *value),
                     "choose a value within these bounds", node.position);
  }
  return *value;
}

std::vector<double> numbers_in(const Node& node, const std::string& name, std::size_t count) {
  const auto* list = std::get_if<List>(&node.value);
  if (!list || (count > 0 && list->size() != count)) {
    throw InputError(count > 0 ? fmt::format("{} is a list of {} numbers", name, count)
                               : fmt::format("{} is a list of numbers", name),
                     list ? count_of_items(list->size()) : describe(node), "write the numbers in brackets, with commas",
                     node.position);
  }
  std::vector<double> numbers;
  for (const auto& item : *list) numbers.push_back(number_in(item, name, any_number));
  return numbers;
}

std::string text_in(const Node& node, const std::string& name) {
  const auto* text = std::get_if<std::string>(&node.value);
  if (!text) throw InputError(fmt::format("{} is a text", name), describe(node), "write it in quotes", node.position);
  if (text->empty()) throw InputError(fmt::format("{} is not empty", name), "\"\"", "give it a name", node.position);
  return *text;
}

Table::Table(const Node& node, std::string title)
    : node_(node),
      keys_(node.is_table() ? std::get<Keys>(node.value)
                            : throw InputError(title + " is a table", describe(node), "write it with keys and values",
                                               node.position)),
      title_(std::move(title)) {}

const Node* Table::find(const std::string& key) {
  asked_.insert(key);
  return look(key);
}

const Node* Table::look(const std::string& key) const {
  const auto found = keys_.find(key);
  return found == keys_.end() ? nullptr : &found->second;
}

const Node& Table::need(const std::string& key, const std::string& remedy) {
  if (const Node* node = find(key)) return *node;
  throw InputError(fmt::format("{} lacks the key {}", title_, key), "", remedy, node_.position);
}

double Table::number(const std::string& key, const Range& range, const std::string& remedy) {
  return number_in(need(key, remedy), key, range);
}

double Table::number_or(const std::string& key, const Range& range, double standard) {
  const Node* node = find(key);
  return node ? number_in(*node, key, range) : standard;
}

int Table::whole_or(const std::string& key, int low, int high, int standard) {
  const Node* node = find(key);
  if (!node) return standard;
  const double value = number_in(*node, key, {static_cast<double>(low), static_cast<double>(high)});
  if (!node->whole)
    throw InputError(fmt::format("{} is a whole number", key), describe(*node), "write it without a decimal point",
                     node->position);
  return static_cast<int>(value);
}

bool Table::truth_or(const std::string& key, bool standard) {
  const Node* node = find(key);
  if (!node) return standard;
  const auto* value = std::get_if<bool>(&node->value);
  if (!value)
    throw InputError(fmt::format("{} is true or false", key), describe(*node), "write true or false, without quotes",
                     node->position);
  return *value;
}

std::string Table::text(const std::string& key, const std::string& remedy) {
  return text_in(need(key, remedy), key);
}

std::string Table::text_or(const std::string& key, const std::string& standard) {
  const Node* node = find(key);
  return node ? text_in(*node, key) : standard;
}

std::vector<std::pair<std::string, const Node*>> Table::rest() {
  std::vector<std::pair<std::string, const Node*>> left;
  for (const auto& [key, node] : keys_) {
    if (asked_.insert(key).second) left.emplace_back(key, &node);
  }
  return left;
}

void Table::finish() const {
  for (const auto& [key, node] : keys_) {
    if (asked_.contains(key)) continue;
    const auto like = nearest(key, asked_);
    const auto other = elsewhere(key);
    throw InputError(fmt::format("{} has no key {}", title_, key), describe(node),
                     !other.empty() ? fmt::format("{} is a key of {}", key, other)
                     : like         ? fmt::format("did you mean {}?", *like)
                                    : fmt::format("its keys are {}", fmt::join(asked_, ", ")),
                     node.position);
  }
}

}  // namespace scarp::input
