#include "scarp/io/history.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <unistd.h>
#include <cerrno>

#include "scarp/io/file.hpp"

namespace scarp::io {

HistoryWriter::HistoryWriter(const std::string& path, std::span<const std::string> columns)
    : path_(path), columns_(columns.size()), file_(std::fopen(path.c_str(), "w"), &std::fclose) {
  write_at_once();
  write(fmt::format("{}\n", fmt::join(columns, ",")));
}

HistoryWriter::HistoryWriter(const std::string& path, std::span<const std::string> columns, std::int64_t bytes)
    : path_(path), columns_(columns.size()), bytes_(bytes), file_(std::fopen(path.c_str(), "r+"), &std::fclose) {
  const std::string header = fmt::format("{}\n", fmt::join(columns, ","));
  std::string there(header.size(), '\0');
  const bool same = file_ && std::fread(there.data(), 1, there.size(), file_.get()) == there.size() && there == header;
  if (!same || std::fseek(file_.get(), 0, SEEK_END) != 0 || std::ftell(file_.get()) < bytes) {
    throw InputError("the table of a run that is to go on is not what it was", path,
                     "bring back the history.csv that belongs to the checkpoint");
  }
  if (ftruncate(fileno(file_.get()), bytes) != 0 || std::fseek(file_.get(), static_cast<long>(bytes), SEEK_SET) != 0)
    throw WriteError(path_, errno);
  write_at_once();
}

void HistoryWriter::write_at_once() {
  if (file_) std::setvbuf(file_.get(), nullptr, _IONBF, 0);
}

void HistoryWriter::row(std::span<const double> values) {
  if (values.size() != columns_) {
    throw RunError(fmt::format("a row of {} does not fit its header", path_),
                   fmt::format("{} values for {} columns", values.size(), columns_), "this is an error of the program");
  }
  write(fmt::format("{}\n", fmt::join(values, ",")));
}

void HistoryWriter::sync() const {
  fsync(fileno(file_.get()));
}

void HistoryWriter::write(const std::string& line) {
  errno = 0;
  if (!file_ || std::fwrite(line.data(), 1, line.size(), file_.get()) != line.size()) {
    const int reason = errno;
    // Whole rows only, also on a full disk.
    if (file_ && ftruncate(fileno(file_.get()), bytes_) == 0)
      std::fseek(file_.get(), static_cast<long>(bytes_), SEEK_SET);
    throw WriteError(path_, reason);
  }
  bytes_ += static_cast<std::int64_t>(line.size());
}

}  // namespace scarp::io
