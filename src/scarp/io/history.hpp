// A table that grows with the run (CSV).
#pragma once

#include <cstdio>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace scarp::io {

/// Writes a header and one row after the other, each at once on disk, numbers with all their digits. Throws RunError
/// where that fails.
class HistoryWriter {
 public:
  HistoryWriter(const std::string& path, std::span<const std::string> columns);
  void row(std::span<const double> values);

 private:
  void write(const std::string& line);

  std::string path_;
  std::size_t columns_;
  std::unique_ptr<std::FILE, int (*)(std::FILE*)> file_;
};

}  // namespace scarp::io
