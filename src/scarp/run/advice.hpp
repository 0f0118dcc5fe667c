// Warnings about a case that can be run but will hardly be what its author wants.
#pragma once

#include <string>

#include "scarp/input/case.hpp"
#include "scarp/run/ledger.hpp"
#include "scarp/step/body.hpp"

namespace scarp::run {

/// How many points there are, in how many elements, and how many each of these holds, as text.
template <int Dim>
std::string points_per_element(const Body<Dim>& body);

/// Warns of regions with fewer than two points along an edge of the elements that hold them, names the spacing that
/// would do, and says how many elements inside the region hold none.
template <int Dim>
void warn_of_sparse_points(const input::CaseOf<Dim>& input, const Body<Dim>& body);

/// Warns of removals that hold none of the points as they are before the first step.
template <int Dim>
void warn_of_idle_removals(const input::CaseOf<Dim>& input, const Body<Dim>& body);

/// Warns of more than ten thousand frames.
template <int Dim>
void warn_of_many_frames(const input::CaseOf<Dim>& input, const Body<Dim>& body);

/// Warns where the disk of `folder`, which exists, has less room than all frames and checkpoints may take.
template <int Dim>
void warn_of_small_disk(const input::CaseOf<Dim>& input, const Body<Dim>& body, const std::string& folder);

/// Warns, at the end of a run, of stresses that failed, of those of its `points` that are on the floor of p_c, and of
/// points that left the mesh.
template <int Dim>
void warn_of_losses(const Ledger<Dim>& ledger, int points);

/// Warns of a share of FLIP per step in a case whose scheme has no use for one: it is ignored, in [method] and in
/// stages.
template <int Dim>
void warn_of_ignored_flip(const input::CaseOf<Dim>& input);

}  // namespace scarp::run
