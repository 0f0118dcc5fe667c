// The initial state of sloping, layered ground: stress from the soil above and K0, internal variables from a region's
// rule.
#pragma once

#include "scarp/input/case.hpp"
#include "scarp/points/overburden.hpp"
#include "scarp/points/points.hpp"

namespace scarp::run {

/// Sets stress and state of all points of a region: the vertical effective stress from the soil above each point, the
/// horizontal ones K0 times that (K0 given, or that of the model's own oedometric loading and unloading to the point's
/// OCR), or a uniform stress. Throws InputError with the region's place and the point for a state that the model cannot
/// take.
template <int Dim>
void set_initial_state(Block<Dim>& block, const input::RegionInputOf<Dim>& region, const OverburdenOf<Dim>& overburden);

}  // namespace scarp::run
