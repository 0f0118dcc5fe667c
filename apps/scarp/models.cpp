#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdio>

#include "commands.hpp"
#include "scarp/base/error.hpp"
#include "scarp/base/words.hpp"
#include "scarp/material/models.hpp"

namespace scarp::app {
namespace {

/// Width on a terminal: letters, not bytes; combining marks take no place.
std::size_t width(const std::string& text) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto byte = static_cast<unsigned char>(text[i]);
    const bool combining =
        byte == 0xCC || (byte == 0xCD && i + 1 < text.size() && static_cast<unsigned char>(text[i + 1]) < 0xB0);
    if ((byte & 0xC0) != 0x80 && !combining) ++count;
  }
  return count;
}

/// Prints rows in aligned columns.
void print_table(const std::vector<std::vector<std::string>>& rows) {
  std::vector<std::size_t> widths;
  for (const auto& row : rows) {
    widths.resize(std::max(widths.size(), row.size()));
    for (std::size_t c = 0; c < row.size(); ++c) widths[c] = std::max(widths[c], width(row[c]));
  }
  for (const auto& row : rows) {
    std::string line = " ";
    for (std::size_t c = 0; c < row.size(); ++c) {
      line += " " + row[c];
      if (c + 1 < row.size()) line += std::string(widths[c] - width(row[c]) + 1, ' ');
    }
    fmt::print("{}\n", line);
  }
}

std::string bounds(const ParameterInfo& info) {
  std::string text;
  if (info.low) text += fmt::format("{} {} ", info.low->value, info.low->open ? "<" : "≤");
  if (info.low || info.high) text += info.symbol;
  if (info.high) text += fmt::format(" {} {}", info.high->open ? "<" : "≤", info.high->value);
  return text;
}

void print_fields(const char* title, const std::vector<FieldInfo>& fields) {
  if (fields.empty()) return;
  fmt::print("\n{}\n", title);
  std::vector<std::vector<std::string>> rows;
  for (const auto& info : fields) {
    rows.push_back(
        {info.key, info.symbol, info.unit, info.kind == FieldKind::tensor ? "tensor" : "scalar", info.meaning});
  }
  print_table(rows);
}

void print_model(const ModelDescription& model) {
  fmt::print("{}: {}\n\nconstants (key, symbol, unit, bounds, standard value, meaning)\n", model.name, model.summary);
  std::vector<std::vector<std::string>> rows;
  for (const auto& info : model.parameters) {
    rows.push_back({info.key, info.symbol, info.unit, bounds(info),
                    !info.standard_key.empty() ? info.standard_key
                    : info.standard            ? fmt::format("{}", *info.standard)
                                               : "required",
                    info.meaning});
  }
  print_table(rows);
  if (!model.settings.empty()) {
    fmt::print("\nother keys of the material (key, holds, needed, meaning)\n");
    rows.clear();
    for (const auto& info : model.settings)
      rows.push_back({info.key, info.takes, info.required ? "required" : "-", info.meaning});
    print_table(rows);
  }
  print_fields("state (key, symbol, unit, kind, meaning; compression positive)", model.state);
  print_fields("derived", model.derived);
  if (model.initial.empty()) return;
  fmt::print("\ninitial values of a region: initial = {{ key = value, ... }}\n");
  rows.clear();
  for (const auto& info : model.initial) rows.push_back({info.key, info.takes, info.meaning});
  print_table(rows);
}

}  // namespace

void print_models(const std::string& name) {
  const auto models = model_descriptions();
  if (name.empty()) {
    std::vector<std::vector<std::string>> rows;
    for (const auto& model : models) rows.push_back({model.name, model.summary});
    print_table(rows);
    return;
  }
  std::vector<std::string> names;
  for (const auto& model : models) {
    if (model.name == name) {
      print_model(model);
      return;
    }
    names.push_back(model.name);
  }
  const auto like = nearest(name, {names.begin(), names.end()});
  throw InputError(
      "there is no such model", '"' + name + '"',
      fmt::format("{}choose one of {}", like ? "did you mean " + *like + "? " : "", fmt::join(names, ", ")));
}

}  // namespace scarp::app
