// Running a laboratory test and writing its curve.
#pragma once

#include <string>

#include "scarp/input/lab_test.hpp"

namespace scarp::run {

/// Runs the test and writes its curve as CSV to the file `out`, or to standard output where `out` is empty. A test that
/// stops early leaves the rows before that (RunError is thrown on). Throws InputError where `out` is a file that the
/// test was read from.
void run_lab_test(const input::LabTest& input, const std::string& out);

/// The same for pictures: throws InputError where `path` is a file that the test was read from.
void refuse_own_files(const input::LabTest& input, const std::string& path, const std::string& option);

}  // namespace scarp::run
