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

/// Calls f with each relative name of a file in the tree.
template <class F>
void for_each_file_name(Node& node, F&& f) {
  if (auto* list = std::get_if<List>(&node.value)) {
    for (auto& item : *list) for_each_file_name(item, f);
  }
  auto* keys = std::get_if<Keys>(&node.value);
  if (!keys) return;
  for (auto& [key, item] : *keys) {
    const bool names_file = std::find(keys_of_files.begin(), keys_of_files.end(), key) != keys_of_files.end();
    const auto* name = std::get_if<std::string>(&item.value);
    if (names_file && name && fs::path(*name).is_relative()) f(item);
    for_each_file_name(item, f);
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
  for_each_file_name(document, [&](Node& node) {
    auto& name = std::get<std::string>(node.value);
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

}  // namespace scarp::input
