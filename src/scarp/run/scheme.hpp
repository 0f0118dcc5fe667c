// The scheme of the step that a case asks for.
#pragma once

#include "scarp/input/case.hpp"
#include "scarp/step/scheme.hpp"

namespace scarp::run {

/// `flip` is a stage's own, for the report's scheme.
Scheme scheme_of(const input::MethodInput& method, std::optional<double> flip = {});

}  // namespace scarp::run
