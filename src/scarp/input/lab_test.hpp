// Reading a laboratory test (`scarp lab`) from TOML.
#pragma once

#include <string>
#include <vector>

#include "scarp/lab/test.hpp"

namespace scarp::input {

struct LabTest {
  std::string title;
  lab::Test test;
  std::vector<std::string> files;  ///< all that has been read: no output may overwrite them
};

/// Reads and checks a test; its initial state is admissible. `overrides` as in read_case(). Throws InputError with
/// file, line and column for the first thing wrong.
LabTest read_lab_test(const std::string& path, const std::vector<std::string>& overrides = {});

/// The same from the text of a test; `path` stands for its file in errors, and strains are sought from its folder.
LabTest parse_lab_test(const std::string& path, const std::string& text,
                       const std::vector<std::string>& overrides = {});

}  // namespace scarp::input
