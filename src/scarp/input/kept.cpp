// The case that a folder of results keeps: the one that was run, with names of files that lead there from that folder.
#include "scarp/input/kept.hpp"

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <optional>
#include <string_view>
#include <vector>

#include "scarp/input/document.hpp"
#include "scarp/input/readers.hpp"

namespace scarp::input {
namespace {

namespace fs = std::filesystem;

/// Calls f(node, whether it is one of results) with each name of a file or folder in the tree. `table` is the key under
/// which a node stands.
template <class F>
void for_each_file_name(Node& node, const std::string& table, F&& f) {
  if (auto* list = std::get_if<List>(&node.value)) {
    for (auto& item : *list) for_each_file_name(item, "", f);
  }
  auto* keys = std::get_if<Keys>(&node.value);
  if (!keys) return;
  for (auto& [key, item] : *keys) {
    const bool is_start = table == "start" && key == "from";
    const bool names_file = std::find(keys_of_files.begin(), keys_of_files.end(), key) != keys_of_files.end();
    if ((names_file || is_start) && std::holds_alternative<std::string>(item.value)) f(item, is_start);
    for_each_file_name(item, key, f);
  }
}

/// A folder with its links followed: ".." leads out of that.
fs::path folder_at(const fs::path& path) {
  return fs::weakly_canonical(fs::absolute(path.empty() ? "." : path));
}

bool is_within(const fs::path& inner, const fs::path& outer) {
  return std::mismatch(outer.begin(), outer.end(), inner.begin(), inner.end()).first == outer.end();
}

/// Where in `text` the quoted value of a key stands that begins at a position; nothing where it is not simply that.
struct Quoted {
  std::size_t begin, size;
};
std::optional<Quoted> quoted_value(std::string_view text, const Node& node) {
  std::size_t at = 0;
  for (int line = 1; line < node.position.line; ++line) {
    at = text.find('\n', at);
    if (at == text.npos) return {};
    ++at;
  }
  at = text.find('=', at + static_cast<std::size_t>(std::max(0, node.position.column - 1)));
  if (at == text.npos) return {};
  at = text.find_first_not_of(" \t", at + 1);
  if (at == text.npos || (text[at] != '"' && text[at] != '\'')) return {};
  const auto end = text.find(text[at], at + 1);
  if (end == text.npos || text.substr(at + 1, end - at - 1) != std::get<std::string>(node.value)) return {};
  return Quoted{at, end + 1 - at};
}

}  // namespace

std::string kept_text(const std::string& text, const std::string& case_path, const std::string& folder) {
  const fs::path from = folder_at(fs::path(case_path).parent_path()), to = folder_at(folder);
  if (from == to) return text;
  Node document = parse_text(text, case_path);
  struct Change {
    Quoted place;
    std::string name;
  };
  std::vector<Change> changes;
  bool in_place = true, any = false;
  for_each_file_name(document, "", [&](Node& node, bool) {
    auto& name = std::get<std::string>(node.value);
    if (fs::path(name).is_absolute()) return;
    const fs::path file = (from / name).lexically_normal();
    const auto place = quoted_value(text, node);
    name = (is_within(to, from) ? file.lexically_relative(to) : file).string();
    any = true;
    in_place = in_place && place && name.find_first_of("\"\\") == name.npos;
    if (in_place) changes.push_back({*place, name});
  });
  if (!any) return text;
  if (!in_place) return to_toml(document);
  std::sort(changes.begin(), changes.end(), [](const auto& a, const auto& b) { return a.place.begin > b.place.begin; });
  std::string kept = text;
  for (const auto& [place, name] : changes) kept.replace(place.begin, place.size, '"' + name + '"');
  return kept;
}

std::vector<std::string> files_of_case(const std::string& text, const std::string& path) {
  Node document = parse_text(text, path);
  std::vector<std::string> files;
  for_each_file_name(document, "", [&](Node& node, bool is_start) {
    if (!is_start) files.push_back(resolved(std::get<std::string>(node.value), path));
  });
  std::sort(files.begin(), files.end());
  files.erase(std::unique(files.begin(), files.end()), files.end());
  return files;
}

}  // namespace scarp::input
