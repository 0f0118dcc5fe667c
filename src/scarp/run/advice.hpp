// Warnings about a case that can be run but will hardly be what its author wants.
#pragma once

#include "scarp/input/case.hpp"
#include "scarp/step/body.hpp"

namespace scarp::run {

/// Warns of regions with fewer than two points along an edge of the elements that hold them, and names the spacing that
/// would do.
template <int Dim>
void warn_of_sparse_points(const input::CaseOf<Dim>& input, const Body<Dim>& body);

/// Warns of a share of FLIP per step in a case whose scheme has no use for one: it is ignored, in [method] and in
/// stages.
template <int Dim>
void warn_of_ignored_flip(const input::CaseOf<Dim>& input);

}  // namespace scarp::run
