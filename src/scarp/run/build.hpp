// From a checked case to soil on its background mesh.
#pragma once

#include "scarp/input/case.hpp"
#include "scarp/step/step.hpp"

namespace scarp::run {

/// Reads or makes the mesh, fills the regions, finds the points' elements, sets the boundary conditions and the initial
/// state. Throws InputError for what only shows with mesh and points together: a mesh that does not hold the soil,
/// regions that overlap, a node set that the mesh does not have, an initial state that a model cannot take.
template <int Dim>
Body<Dim> build_body(const input::CaseOf<Dim>& input);

/// The same without points: the mesh, its conditions, and a block for each region.
template <int Dim>
Body<Dim> build_ground(const input::CaseOf<Dim>& input);

/// Throws InputError for what only shows when the soil is there: internal lengths below what its elements can carry,
/// and sides that cannot absorb.
template <int Dim>
void check_soil(const input::CaseOf<Dim>& input, const Body<Dim>& body);

/// Lets the sides go that absorb from stage number `stage` on. Throws InputError as build_body() does for them.
template <int Dim>
void open_sides(Body<Dim>& body, const input::CaseOf<Dim>& input, const StepSettings& settings, int stage);

}  // namespace scarp::run
