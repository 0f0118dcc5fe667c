// Writing whole files so that a reader never sees half of one, not even after power has failed.
#pragma once

#include <cstddef>
#include <cstdio>
#include <string>
#include <string_view>

#include "scarp/base/error.hpp"

namespace scarp::io {

/// A file that is there under its name once it is whole: written piece by piece to a temporary file beside `path`,
/// which finish() renames when all of it is on the disk; the new name is there too after the next sync_folder().
/// Without finish(), and where it fails, an older file at `path` stays untouched. Throws RunError with the reason.
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

/// The whole content of a file. Throws InputError where it cannot be read.
std::string read_whole(const std::string& path);

/// Where a file could not be written, with the reason and what to do.
class WriteError : public RunError {
 public:
  WriteError(const std::string& path, int reason);
};

/// The names in a folder are on the disk after this, as well as the system can tell.
void sync_folder(const std::string& folder);

}  // namespace scarp::io
