// Soil that begins in the state in which another run left it ([start] from).
#pragma once

#include "scarp/input/case.hpp"
#include "scarp/step/body.hpp"

namespace scarp::run {

/// The body of a case with [start]: its points, with velocity, stress and the state of their laws, are those of a
/// checkpoint of another run; mesh, boundaries and constants are the case's own. Throws InputError, with the place of
/// [start] or of what is different, where mesh, regions, densities, models or state variables do not fit, and where a
/// law cannot take the state with the constants that it has now.
template <int Dim>
Body<Dim> start_body(const input::CaseOf<Dim>& input);

}  // namespace scarp::run
