// The scheme of the step that a case asks for, and its other settings.
#pragma once

#include "scarp/input/case.hpp"
#include "scarp/step/scheme.hpp"
#include "scarp/step/step.hpp"

namespace scarp::run {

/// `flip` is a stage's own, for the report's scheme.
Scheme scheme_of(const input::MethodInput& method, std::optional<double> flip = {});

/// Those of a stage; `profile`: with the times of the phases.
template <int Dim>
StepSettings settings_of(const input::CaseOf<Dim>& input, const input::StageInputOf<Dim>& stage, bool profile = false);

}  // namespace scarp::run
