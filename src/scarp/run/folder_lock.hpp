// One run writes into a folder at a time.
#pragma once

#include <string>

namespace scarp::run {

/// Holds a folder for as long as it lives, by a lock of the system on the file `.lock` in it: a process that dies lets
/// it go. Throws InputError where another process (or another of these) holds it. Where the system has no locks, as on
/// some network file systems, there is none.
class FolderLock {
 public:
  explicit FolderLock(const std::string& folder);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  std::string path_;
  int file_ = -1;
};

}  // namespace scarp::run
