// What the command line asks for, apart from parsing it.
#pragma once

#include <string>
#include <vector>

namespace scarp::app {

/// Prints all models, or one with its constants, state and initial values. Throws InputError for a name that is not in
/// the list.
void print_models(const std::string& name);

/// Draws the results in a folder with the Python script that comes with the program; returns its exit status.
int plot(const std::vector<std::string>& arguments);

}  // namespace scarp::app
