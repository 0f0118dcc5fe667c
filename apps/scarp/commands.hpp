// What the command line asks for, apart from parsing it.
#pragma once

#include <string>
#include <vector>

#include "scarp/input/lab_test.hpp"

namespace scarp::app {

/// Prints all models, or one with its constants, state and initial values. Throws InputError for a name that is not in
/// the list.
void print_models(const std::string& name);

/// Runs one of the Python scripts that come with the program; returns its exit status.
int run_script(const std::string& script, const std::vector<std::string>& arguments);

/// Runs a laboratory test; writes its curve to a file (standard output where `curve` and `picture` are empty) and draws
/// it where `picture` names a file. A test that stops early is written and drawn as far as it came, and RunError thrown
/// on.
int run_lab(const input::LabTest& input, const std::string& curve, const std::string& picture);

}  // namespace scarp::app
