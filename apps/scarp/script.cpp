#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "commands.hpp"
#include "scarp/base/error.hpp"

namespace scarp::app {
namespace {

namespace fs = std::filesystem;

/// The script next to the program: in the build folder and where it is installed alike.
fs::path script_path(const std::string& name) {
  const fs::path program = fs::read_symlink("/proc/self/exe");
  const fs::path path = program.parent_path().parent_path() / "share/scarp/python/scarp" / name;
  if (!fs::exists(path))
    throw InputError("the script that draws results is missing", path.string(), "build or install scarp again");
  return path;
}

}  // namespace

int run_script(const std::string& script, const std::vector<std::string>& arguments) {
  // Debian's matplotlib belongs to this interpreter; another python3 may be first on PATH.
  std::vector<std::string> words{"/usr/bin/python3", script_path(script).string()};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> argv;
  for (auto& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  const pid_t child = fork();
  if (child == 0) {
    execv(argv[0], argv.data());
    _exit(127);
  }
  int status = 0;
  if (child < 0 || waitpid(child, &status, 0) < 0) {
    throw RunError("the script that draws results cannot be started", std::strerror(errno), "try again");
  }
  if (WIFEXITED(status) && WEXITSTATUS(status) == 127) {
    throw InputError("the script that draws results cannot be started", argv[0],
                     "install python3, python3-numpy and python3-matplotlib");
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : 3;
}

}  // namespace scarp::app
