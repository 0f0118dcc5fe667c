// Writing whole files so that a reader never sees half of one.
#pragma once

#include <string>
#include <string_view>

namespace scarp::io {

/// Writes `content` to a temporary file beside `path` and renames it. Throws RunError with the reason where that fails;
/// an older file at `path` is then untouched.
void write_whole(const std::string& path, std::string_view content);

}  // namespace scarp::io
