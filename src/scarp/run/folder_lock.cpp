#include "scarp/run/folder_lock.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>

#include "scarp/base/error.hpp"

namespace scarp::run {
namespace {

/// Is the open file still the one that has this name? Its owner removes it when done.
bool is_there(int file, const std::string& path) {
  struct stat open_one {
  }, named{};
  return fstat(file, &open_one) == 0 && stat(path.c_str(), &named) == 0 && open_one.st_ino == named.st_ino &&
         open_one.st_dev == named.st_dev;
}

/// The number of the process that wrote itself into the file, as text.
std::string owner(int file) {
  std::array<char, 32> text{};
  const auto count = pread(file, text.data(), text.size() - 1, 0);
  return count > 0 ? fmt::format(" (process {})", std::string(text.data(), static_cast<std::size_t>(count))) : "";
}

}  // namespace

FolderLock::FolderLock(const std::string& folder) : path_(folder + "/.lock") {
  for (;;) {
    file_ = open(path_.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
    if (file_ < 0) return;  // what is to be written there later says why not
    if (flock(file_, LOCK_EX | LOCK_NB) != 0) {
      const bool held = errno == EWOULDBLOCK;
      const std::string who = owner(file_);
      close(file_);
      file_ = -1;
      if (!held) return;
      throw InputError("another run is writing into the folder of the results", folder + who,
                       "choose another --out, or wait for its end");
    }
    if (is_there(file_, path_)) break;
    close(file_);
  }
  const std::string own = std::to_string(getpid());
  [[maybe_unused]] const bool written =
      ftruncate(file_, 0) == 0 && pwrite(file_, own.data(), own.size(), 0) == static_cast<ssize_t>(own.size());
}

FolderLock::~FolderLock() {
  if (file_ < 0) return;
  unlink(path_.c_str());  // before it is let go: who opens it after this sees that it has no name
  close(file_);
}

}  // namespace scarp::run
