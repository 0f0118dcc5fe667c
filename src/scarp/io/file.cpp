#include "scarp/io/file.hpp"

#include <fmt/format.h>
#include <cerrno>
#include <cstring>

#include "scarp/base/error.hpp"

namespace scarp::io {

WholeFile::WholeFile(const std::string& path)
    : path_(path), temporary_(path + ".part"), file_(std::fopen(temporary_.c_str(), "wb")) {
  if (!file_) fail(errno);
}

WholeFile::~WholeFile() {
  if (!file_) return;
  std::fclose(file_);
  std::remove(temporary_.c_str());
}

void WholeFile::write(const void* data, std::size_t bytes) {
  if (std::fwrite(data, 1, bytes, file_) != bytes) fail(errno);
}

void WholeFile::finish() {
  std::FILE* file = file_;
  file_ = nullptr;
  if (std::fclose(file) != 0 || std::rename(temporary_.c_str(), path_.c_str()) != 0) {
    const int reason = errno;
    std::remove(temporary_.c_str());
    fail(reason);
  }
}

void WholeFile::fail(int reason) {
  throw RunError(fmt::format("the file {} cannot be written", path_), std::strerror(reason),
                 "check that the folder exists, that you may write there and that the disk has room");
}

void write_whole(const std::string& path, std::string_view content) {
  WholeFile file(path);
  file.write(content);
  file.finish();
}

}  // namespace scarp::io
