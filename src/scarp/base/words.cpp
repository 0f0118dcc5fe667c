#include "scarp/base/words.hpp"

#include <algorithm>
#include <cctype>
#include <numeric>
#include <vector>

namespace scarp {
namespace {

char small(char c) {
  return static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
}

/// Changes of one letter that turn one word into the other.
std::size_t distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    std::size_t corner = row[0];
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t above = row[j];
      row[j] = std::min({above + 1, row[j - 1] + 1, corner + (small(a[i - 1]) == small(b[j - 1]) ? 0 : 1)});
      corner = above;
    }
  }
  return row[b.size()];
}

/// The letters and digits of a word, small.
std::string bare(const std::string& word) {
  std::string letters;
  for (const char c : word) {
    if (std::isalnum(static_cast<unsigned char>(c))) letters += small(c);
  }
  return letters;
}

}  // namespace

std::optional<std::string> nearest(const std::string& word, const std::set<std::string>& known) {
  for (const auto& candidate : known) {
    if (bare(candidate) == bare(word)) return candidate;  // "su" is s_u, not nu
  }
  std::optional<std::string> best;
  std::size_t least = std::max<std::size_t>(1, word.size() / 2) + 1;
  for (const auto& candidate : known) {
    if (const auto d = distance(word, candidate); d < least) {
      least = d;
      best = candidate;
    }
  }
  return best;
}

}  // namespace scarp
