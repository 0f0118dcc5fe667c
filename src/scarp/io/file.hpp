// Writing whole files so that a reader never sees half of one.
#pragma once

#include <cstddef>
#include <cstdio>
#include <string>
#include <string_view>

namespace scarp::io {

/// A file that is there under its name once it is whole: written piece by piece to a temporary file beside `path`,
/// which finish() renames. Without finish(), and where it fails, an older file at `path` stays untouched. Throws
/// RunError with the reason.
class WholeFile {
 public:
  explicit WholeFile(const std::string& path);
  ~WholeFile();
  WholeFile(const WholeFile&) = delete;
  WholeFile& operator=(const WholeFile&) = delete;

  void write(const void* data, std::size_t bytes);
  void write(std::string_view text) { write(text.data(), text.size()); }
  void finish();

 private:
  [[noreturn]] void fail(int reason);

  std::string path_, temporary_;
  std::FILE* file_;
};

/// Writes `content` as a WholeFile.
void write_whole(const std::string& path, std::string_view content);

}  // namespace scarp::io
