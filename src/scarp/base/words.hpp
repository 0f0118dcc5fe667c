// Words that somebody may have meant.
#pragma once

#include <optional>
#include <set>
#include <string>

namespace scarp {

/// The known word nearest to `word`, when near enough to be a slip of the pen; capitals count as small letters.
std::optional<std::string> nearest(const std::string& word, const std::set<std::string>& known);

}  // namespace scarp
