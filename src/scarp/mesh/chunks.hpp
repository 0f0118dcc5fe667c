// Chunks of a mesh: sets of at most 64 elements near each other, known from the mesh alone, whatever soil it holds and
// however many threads or processes share it. Sums go chunk by chunk, in the order of their numbers.
#pragma once

#include <cstdint>

#include "scarp/mesh/mesh.hpp"

namespace scarp {

/// Number of the chunk of element e. Of a grid: a tile of 8 × 8 or 4 × 4 × 4 cells, by its place on a Hilbert curve
/// through all tiles; along the axes where the grid is too long for one (2^31 tiles, or 2^21 in space). Of another
/// mesh: 64 elements one after the other, which order_along_curve() has put along such a curve.
template <int Dim>
std::uint64_t chunk_of(const Mesh<Dim>& mesh, int e);

}  // namespace scarp
