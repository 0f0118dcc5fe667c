#include "scarp/io/file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <memory>

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
  // What is renamed before it is on the disk may be empty after a loss of power.
  if (std::fflush(file_) != 0 || (fsync(fileno(file_)) != 0 && errno != EINVAL && errno != ENOSYS)) fail(errno);
  std::FILE* file = file_;
  file_ = nullptr;
  if (std::fclose(file) != 0 || std::rename(temporary_.c_str(), path_.c_str()) != 0) {
    const int reason = errno;
    std::remove(temporary_.c_str());
    fail(reason);
  }
}

void WholeFile::fail(int reason) {
  throw WriteError(path_, reason);
}

WriteError::WriteError(const std::string& path, int reason)
    : RunError(fmt::format("the file {} cannot be written", path), std::strerror(reason),
               reason == ENOSPC || reason == EDQUOT
                   ? "make room on that disk, then go on with `scarp resume` and the folder of the results"
                   : "check that the folder exists, that you may write there and that the disk has room") {}

void write_whole(const std::string& path, std::string_view content) {
  WholeFile file(path);
  file.write(content);
  file.finish();
}

std::string read_whole(const std::string& path) {
  const auto refuse = [&](int reason) {
    throw InputError("the file cannot be read", path + " (" + std::strerror(reason) + ")",
                     "check its name, and that you may read it");
  };
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"), &std::fclose);
  if (!file) refuse(errno);
  std::string content;
  struct stat status {};
  if (fstat(fileno(file.get()), &status) == 0 && S_ISREG(status.st_mode))
    content.reserve(static_cast<std::size_t>(status.st_size));
  std::array<char, 1 << 16> piece;
  std::size_t count = 0;
  while ((count = std::fread(piece.data(), 1, piece.size(), file.get())) > 0) content.append(piece.data(), count);
  if (std::ferror(file.get())) refuse(errno);
  return content;
}

void sync_folder(const std::string& folder) {
  const int open_one = open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  if (open_one < 0) return;  // as where one may write but not list
  fsync(open_one);
  close(open_one);
}

}  // namespace scarp::io
