#include "scarp/io/file.hpp"

#include <fmt/format.h>
#include <cerrno>
#include <cstdio>
#include <cstring>

#include "scarp/base/error.hpp"

namespace scarp::io {

void write_whole(const std::string& path, std::string_view content) {
  const std::string temporary = path + ".part";
  std::FILE* file = std::fopen(temporary.c_str(), "wb");
  bool good = file != nullptr;
  int reason = errno;
  if (file) {
    good = std::fwrite(content.data(), 1, content.size(), file) == content.size();
    if (!good) reason = errno;
    if (std::fclose(file) != 0 && good) {
      good = false;
      reason = errno;
    }
    if (good && std::rename(temporary.c_str(), path.c_str()) != 0) {
      good = false;
      reason = errno;
    }
    if (!good) std::remove(temporary.c_str());
  }
  if (good) return;
  throw RunError(fmt::format("the file {} cannot be written", path), std::strerror(reason),
                 "check that the folder exists, that you may write there and that the disk has room");
}

}  // namespace scarp::io
