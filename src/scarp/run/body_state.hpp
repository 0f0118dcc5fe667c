// What the next step depends on of a body: its points with the state of their laws, and what a step leaves at elements
// and nodes for the next one. The order of points in their arrays is not of it, nor are threads.
#pragma once

#include "scarp/run/archive.hpp"
#include "scarp/step/body.hpp"

namespace scarp::run {

/// About how many bytes save_body() writes.
template <int Dim>
std::size_t size_of_state(const Body<Dim>& body);

template <int Dim>
void save_body(const Saver& save, const Body<Dim>& body);

/// What is to be thought of the elements that a file names for its points.
enum class Elements {
  as_kept,  ///< they are state: a point may linger in one that it has just left
  by_place  ///< positions may have been changed since: found anew
};

/// Puts the points of a file into a body that has its mesh, conditions and regions, but no points yet. Throws
/// InputError where they do not fit: names the first difference.
template <int Dim>
void load_points(const Loader& load, Elements elements, Body<Dim>& body);

/// The same with what steps have left at elements and nodes: the next step is that of the body that was saved, to the
/// last bit.
template <int Dim>
void load_body(const Loader& load, Elements elements, Body<Dim>& body);

/// A fingerprint of a mesh: of its nodes and elements, or what its grid is.
template <int Dim>
std::string mesh_hash(const Mesh<Dim>& mesh);

}  // namespace scarp::run
