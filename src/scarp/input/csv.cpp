#include "scarp/input/csv.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <charconv>
#include <cmath>
#include <fstream>
#include <iterator>
#include <optional>
#include <sstream>
#include <string_view>

#include "scarp/base/error.hpp"
#include "scarp/base/text.hpp"

namespace scarp::input {
namespace {

struct Cell {
  std::string_view text;
  int column;  ///< of the line, from 1
};

std::vector<Cell> cells_of(std::string_view line) {
  std::vector<Cell> cells;
  std::size_t start = 0;
  for (;;) {
    const std::size_t comma = std::min(line.find(',', start), line.size());
    std::size_t first = start, last = comma;
    while (first < last && std::isspace(static_cast<unsigned char>(line[first]))) ++first;
    while (last > first && std::isspace(static_cast<unsigned char>(line[last - 1]))) --last;
    cells.push_back({line.substr(first, last - first), static_cast<int>(first) + 1});
    if (comma == line.size()) return cells;
    start = comma + 1;
  }
}

std::optional<double> number(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  double value;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return {};
  return value;
}

/// Places of the wanted columns in a header.
std::vector<std::size_t> places(const std::vector<Cell>& header, const std::vector<std::string>& names,
                                const Position& at) {
  std::vector<std::size_t> found;
  for (const auto& name : names) {
    std::size_t i = 0;
    while (i < header.size() && header[i].text != name) ++i;
    if (i == header.size())
      throw InputError(fmt::format("the file has no column {}", name), std::string(header.front().text),
                       fmt::format("its first line is {}", fmt::join(names, ",")), at);
    found.push_back(i);
  }
  return found;
}

}  // namespace

std::vector<std::vector<double>> read_columns(const std::string& path, const std::vector<std::string>& names) {
  std::ifstream stream(path, std::ios::binary);
  if (!stream) throw InputError("the file cannot be read", path, "check the name and that you may read it");
  return parse_columns(path, std::string(std::istreambuf_iterator<char>(stream), {}), names);
}

std::vector<std::vector<double>> parse_columns(const std::string& path, std::string text,
                                               const std::vector<std::string>& names) {
  drop_byte_order_mark(text, path);
  std::istringstream file(std::move(text));
  std::vector<std::vector<double>> rows;
  std::vector<std::size_t> columns;
  std::string line;
  for (int at = 1; std::getline(file, line); ++at) {
    const auto cells = cells_of(line);
    if ((cells.size() == 1 && cells[0].text.empty()) || line[0] == '#') continue;
    if (columns.empty()) {
      if (!number(cells[0].text)) {
        columns = places(cells, names, {path, at, 1});
        continue;
      }
      for (std::size_t i = 0; i < names.size(); ++i) columns.push_back(i);
    }
    std::vector<double> row;
    for (const auto column : columns) {
      if (column >= cells.size())
        throw InputError("a row has as many values as the file has columns", fmt::format("{}", cells.size()),
                         "complete or remove the row", {path, at, 0});
      const auto value = number(cells[column].text);
      if (!value || !std::isfinite(*value))
        throw InputError("each value is a finite number", fmt::format("\"{}\"", cells[column].text),
                         "write a number, with a point and not a comma", {path, at, cells[column].column});
      row.push_back(*value);
    }
    rows.push_back(std::move(row));
  }
  if (rows.empty())
    throw InputError("the file has no rows", "", fmt::format("give {}", fmt::join(names, ",")), {path, 0, 0});
  return rows;
}

}  // namespace scarp::input
