// The reference curves of reference/ (see its README) as plain data: Mandel components, kPa, compression positive.
#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include "scarp/material/subloading.hpp"

namespace scarp::test {

using SubloadingState = Subloading::State<double, 6>;

struct ReferencePoint {
  Sym<double, 6> eps;
  SubloadingState state;
  double R;
};

/// Six linear constraints over a stage: ΣE_i dε_i + ΣS_i dσ_i = b on tensor components, each once.
struct ReferenceStage {
  std::string label;
  int outputs;
  std::array<std::array<double, 13>, 6> constraints;  ///< E (6), S (6), b
};

struct Reference {
  std::string name;
  std::map<std::string, double> constants;  ///< p_c_floor is 0: the reference has none
  SubloadingState initial;
  double R;  ///< of the initial state
  std::vector<ReferenceStage> program;
  std::vector<std::array<double, 12>> curve;  ///< tensor components ε (6), σ (6) under the program
  std::vector<ReferencePoint> replay;         ///< under straight strain segments
};

/// Names of the curves, without ".json".
std::vector<std::string> reference_names();

Reference read_reference(const std::string& name);

}  // namespace scarp::test
