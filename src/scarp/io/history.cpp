#include "scarp/io/history.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <cerrno>
#include <cstring>

#include "scarp/base/error.hpp"

namespace scarp::io {

HistoryWriter::HistoryWriter(const std::string& path, std::span<const std::string> columns)
    : path_(path), columns_(columns.size()), file_(std::fopen(path.c_str(), "w"), &std::fclose) {
  write(fmt::format("{}\n", fmt::join(columns, ",")));
}

void HistoryWriter::row(std::span<const double> values) {
  if (values.size() != columns_) {
    throw RunError(fmt::format("a row of {} does not fit its header", path_),
                   fmt::format("{} values for {} columns", values.size(), columns_), "this is an error of the program");
  }
  write(fmt::format("{}\n", fmt::join(values, ",")));
}

void HistoryWriter::write(const std::string& line) {
  if (file_ && std::fwrite(line.data(), 1, line.size(), file_.get()) == line.size() && std::fflush(file_.get()) == 0)
    return;
  throw RunError(fmt::format("the file {} cannot be written", path_), std::strerror(errno),
                 "check that the folder exists, that you may write there and that the disk has room");
}

}  // namespace scarp::io
