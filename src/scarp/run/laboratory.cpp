#include "scarp/run/laboratory.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <cstdio>
#include <filesystem>

#include "scarp/base/error.hpp"
#include "scarp/io/file.hpp"
#include "scarp/lab/driver.hpp"

namespace scarp::run {
namespace {

void write_curve(const std::string& curve, const std::string& out) {
  if (out.empty()) {
    fmt::print("{}", curve);
  } else {
    io::write_whole(out, curve);
  }
}

}  // namespace

void refuse_own_files(const input::LabTest& input, const std::string& path, const std::string& option) {
  for (const auto& file : input.files) {
    std::error_code none;
    if (std::filesystem::equivalent(file, path, none))
      throw InputError("the result would overwrite a file that the test is made of", fmt::format("{} {}", option, path),
                       "choose another name");
  }
}

void run_lab_test(const input::LabTest& input, const std::string& out) {
  refuse_own_files(input, out, "--out");
  std::string curve = fmt::format("{}\n", fmt::join(lab::curve_columns(input.test.model), ","));
  try {
    lab::run_test(input.test,
                  [&](const std::vector<double>& row) { curve += fmt::format("{}\n", fmt::join(row, ",")); });
  } catch (const RunError&) {
    write_curve(curve, out);
    throw;
  }
  write_curve(curve, out);
}

}  // namespace scarp::run
