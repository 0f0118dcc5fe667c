// A minimal good case as text, and reading text through a file, as the program does.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "scarp/input/case.hpp"

namespace scarp::input::test {

/// Every kind of table once, with no more than it needs. Whole of it must be read without complaint.
inline const std::string minimal = R"(title = "two columns"
gravity = [0.0, -9.81]

[mesh]
grid = { origin = [-1.0, 0.0], size = [4.0, 2.0], element = 0.5 }

[method]
flip = 0.95

[[material]]
name = "rock"
model = "linear-elastic"
density = 2.2
E = 1e4
nu = 0.25

[[material]]
name = "clay"
model = "subloading"
density = 1.8
kappa = 0.02
lambda = 0.12
nu = 0.3
p_e = 5.0
M = 1.0
M_c = 1.3
k = 0.78
alpha = 1.0
xi = 0.01
c_R = 60.0
c_beta = 5.0
c_b = 20.0
R_bf = 1.0
c_a = 3.0
p_atm = 101.325

[[region]]
name = "left"
material = "clay"
polygon = [[0.0, 0.0], [1.0, 0.0], [1.0, 2.0], [0.0, 2.0]]
spacing = 0.25
K0 = 0.6
initial = { R_b = 3.0, OCR = 1.6, beta = "isotropic" }

[[region]]
name = "right"
material = "rock"
polygon = [[1.0, 0.0], [2.0, 0.0], [2.0, 1.0]]
spacing = 0.5
stress = [1.0, 2.0, 3.0, 0.5]

[[boundary]]
nodes = "bottom"
fix = ["x", "y"]

[[boundary]]
line = [[-1.0, 0.0], [-1.0, 2.0]]
fix = ["x"]
friction = 0.3

[[stage]]
name = "rest"
duration = 2.0
damping = 0.7
rest = { unbalanced = 1e-2, hold = 0.1 }

[[stage]]
name = "cut"
duration = 1.5
remove = { polygon = [[0.5, 0.5], [1.0, 0.5], [1.0, 2.0]] }

[output]
every = 0.25
)";

/// `text` with its only occurrence of `from` replaced.
inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << "not in the case: " << from;
  EXPECT_EQ(text.find(from, at + 1), std::string::npos) << "more than once in the case: " << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

/// A file in the folder for temporary files; removed at the end. Tests run at the same time: each process has its own.
class CaseFile {
 public:
  explicit CaseFile(const std::string& text)
      : path_(testing::TempDir() + "scarp_input_" + std::to_string(getpid()) + ".toml") {
    write(text);
  }
  ~CaseFile() { std::filesystem::remove(path_); }
  CaseFile(const CaseFile&) = delete;
  CaseFile& operator=(const CaseFile&) = delete;

  void write(const std::string& text) const {
    std::ofstream file(path_, std::ios::binary | std::ios::trunc);
    file << text;
    file.close();
    ASSERT_TRUE(file) << path_;
  }
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

inline Case read(const std::string& text, const std::vector<std::string>& overrides = {}) {
  const CaseFile file(text);
  return read_case(file.path(), overrides);
}

}  // namespace scarp::input::test
