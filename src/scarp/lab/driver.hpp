// Runs a laboratory test: one stress point through its stages.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "scarp/lab/test.hpp"

namespace scarp::lab {

/// Names of the columns of a curve: stage (from 1), time, eps_* and sig_* (tensor components), p, q, theta (Lode angle
/// [rad], 0 in triaxial compression), eps_v, eps_q, u (excess pore pressure of undrained named tests), the model's
/// derived and state fields (scalars, then tensors) and substeps.
std::vector<std::string> curve_columns(const AnyModel& model);

/// Problems of the initial state; none when the test can start.
std::vector<Problem> initial_problems(const Test& test);

/// Calls `row` with the values of curve_columns() at the end of every increment. Throws RunError where the soil or the
/// constraints allow no next increment, with the stage, the increment and the state; all rows before it have been
/// given. The initial state must be free of problems.
void run_test(const Test& test, const std::function<void(const std::vector<double>&)>& row);

}  // namespace scarp::lab
