// A table that grows with the run (CSV).
#pragma once

#include <cstdint>
#include <cstdio>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace scarp::io {

/// Writes a header and one row after the other, each at once handed to the system, numbers with all their digits.
/// Throws RunError where that fails.
class HistoryWriter {
 public:
  HistoryWriter(const std::string& path, std::span<const std::string> columns);
  /// Goes on with a file after its first `bytes`, and drops what it has beyond them. Throws InputError where it has
  /// fewer, or other columns.
  HistoryWriter(const std::string& path, std::span<const std::string> columns, std::int64_t bytes);
  void row(std::span<const double> values);
  std::int64_t bytes() const { return bytes_; }  ///< written up to now
  /// All rows are on the disk after this.
  void sync() const;

 private:
  void write_at_once();
  void write(const std::string& line);

  std::string path_;
  std::size_t columns_;
  std::int64_t bytes_ = 0;
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file_;
};

}  // namespace scarp::io
