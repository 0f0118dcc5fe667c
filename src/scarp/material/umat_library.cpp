#include "scarp/material/umat_library.hpp"

#include <dlfcn.h>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <filesystem>

#include "scarp/material/umat_guard.hpp"

namespace scarp::umat {
namespace {

// A library that brings its own SPRIND, say, shall use that one, not the program's. The address sanitizer refuses such
// a library.
#if defined(__SANITIZE_ADDRESS__)
constexpr int own_names_first = 0;
#else
constexpr int own_names_first = RTLD_DEEPBIND;
#endif

/// The names to look for, in order.
std::vector<std::string> candidates(const std::string& symbol) {
  if (symbol.empty()) return {"umat_", "umat", "UMAT"};  // gfortran and ifort, C, ifort on other systems
  std::vector<std::string> names{symbol};
  if (symbol.back() != '_') names.push_back(symbol + '_');
  return names;
}

}  // namespace

std::shared_ptr<Library> Library::open(const std::string& path, const std::string& symbol,
                                       std::vector<Problem>& problems) {
  std::error_code none;
  if (!std::filesystem::is_regular_file(path, none)) {
    problems.push_back(
        {"library", "the shared library of the UMAT is not there", '"' + path + '"',
         "give its name from the folder of the case file; compile the UMAT with gfortran -shared -fPIC"});
    return {};
  }
  // With a slash in it the name is that of a file, not one to be looked up.
  const auto absolute = std::filesystem::absolute(path).string();
  void* handle = dlopen(absolute.c_str(), RTLD_NOW | RTLD_LOCAL | own_names_first);
  if (!handle) {
    const char* reason = dlerror();
    problems.push_back({"library", "the shared library of the UMAT cannot be loaded", reason ? reason : path,
                        fmt::format("build it with -shared -fPIC for this machine; of the utility routines of Abaqus "
                                    "scarp provides {}: bring others in the library",
                                    fmt::join(provided_utilities(), ", "))});
    return {};
  }
  std::shared_ptr<Library> library(new Library(path, handle));
  watch_for_ends();
  const auto names = candidates(symbol);
  for (const auto& name : names) {
    if (void* found = dlsym(handle, name.c_str())) {
      library->routine_ = reinterpret_cast<Routine>(found);
      return library;
    }
  }
  problems.push_back({"symbol", fmt::format("the library \"{}\" has no such routine", path),
                      fmt::format("none of {}", fmt::join(names, ", ")),
                      fmt::format("give symbol = \"...\", one of the names that `nm -D --defined-only {}` lists",
                                  std::filesystem::path(path).filename().string())});
  return {};
}

Library::~Library() {
  if (!ended()) dlclose(handle_);
}

}  // namespace scarp::umat
