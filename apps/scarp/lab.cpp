#include <unistd.h>

#include <exception>
#include <filesystem>
#include <string>

#include "commands.hpp"
#include "scarp/base/error.hpp"
#include "scarp/run/laboratory.hpp"

namespace scarp::app {

int run_lab(const input::LabTest& input, const std::string& curve, const std::string& picture) {
  namespace fs = std::filesystem;
  if (picture.empty()) {
    run::run_lab_test(input, curve);
    return 0;
  }
  run::refuse_own_files(input, picture, "--plot");
  const bool temporary = curve.empty();
  const auto path =
      temporary ? (fs::temp_directory_path() / ("scarp-curve-" + std::to_string(getpid()) + ".csv")).string() : curve;
  std::exception_ptr stopped;
  try {
    run::run_lab_test(input, path);
  } catch (const RunError&) {
    stopped = std::current_exception();  // what there is of the curve is drawn all the same
  }
  const int status = run_script("lab_plot.py", {path, picture});
  if (temporary) fs::remove(path);
  if (stopped) std::rethrow_exception(stopped);
  return status;
}

}  // namespace scarp::app
