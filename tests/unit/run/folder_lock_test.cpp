// One run writes into a folder at a time, and a process that dies lets it go.
#include "scarp/run/folder_lock.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>

#include "scarp/base/error.hpp"

namespace scarp::run {
namespace {

class Folder : public testing::Test {
 protected:
  void SetUp() override { std::filesystem::create_directories(path); }
  void TearDown() override { std::filesystem::remove_all(path); }

  const std::string path = testing::TempDir() + "scarp_lock_" + std::to_string(getpid());
};

TEST_F(Folder, IsHeldByOne) {
  {
    const FolderLock first(path);
    try {
      const FolderLock second(path);
      ADD_FAILURE() << "no error";
    } catch (const InputError& error) {
      EXPECT_NE(error.problem().find("another run is writing"), std::string::npos) << error.what();
      EXPECT_NE(error.value().find("process " + std::to_string(getpid())), std::string::npos) << error.what();
    }
    EXPECT_THROW(const FolderLock third(path), InputError);
  }
  EXPECT_TRUE(std::filesystem::is_empty(path));
  const FolderLock later(path);
}

TEST_F(Folder, IsLetGoByADeadProcess) {
  int ready[2];
  ASSERT_EQ(pipe(ready), 0);
  const pid_t child = fork();
  if (child == 0) {
    const FolderLock held(path);
    [[maybe_unused]] const auto told = write(ready[1], "x", 1);
    for (;;) pause();
  }
  char letter;
  ASSERT_EQ(::read(ready[0], &letter, 1), 1);
  EXPECT_THROW(const FolderLock refused(path), InputError);
  kill(child, SIGKILL);
  waitpid(child, nullptr, 0);
  EXPECT_FALSE(std::filesystem::is_empty(path));  // its file is still there
  EXPECT_NO_THROW(const FolderLock taken(path));
}

}  // namespace
}  // namespace scarp::run
