// Structured grids of equal rectangles or boxes.
#pragma once

#include <array>
#include <type_traits>

#include "scarp/mesh/mesh.hpp"

namespace scarp {

/// Elements and nodes are numbered by 32 bits with a sign, which leaves some room for numbers beyond the last.
inline constexpr int most_grid_numbers = 2'000'000'000;

/// Functions along an axis of n elements, and those of them that an element touches.
int functions_along(GridFunctions functions, int n);
int local_functions_along(GridFunctions functions);

/// A grid of elements[0] x elements[1] (x elements[2]) four-node rectangles (eight-node boxes) over the box of corner
/// `origin` and lengths `size` [m]; nodes and elements numbered x fastest, then y, then z, with the node sets of the
/// sides (add_side_sets) and the grid descriptor.
///
/// `functions` chooses what the nodes are (mesh/grid_bases.hpp): corners of elements for linear functions and GIMP,
/// whose elements have 16 (64) local nodes; control points at the Greville points (0, ½, 1½, ..., n − ½, n) times the
/// spacing for quadratic B-splines, 9 (27) of an element. Types stay those of the elements' geometry, and sizes but at
/// the sides (Mesh::size_of). It takes memory for its lines and the nodes of its sides alone. Throws InputError when a
/// length is not positive and finite, a count is below 1, or there are more elements or nodes than most_grid_numbers;
/// that before it takes any.
///
/// The dimension is never deduced, so braces may stand for the arguments: make_grid<3>({0, 0, 0}, ...).
template <int Dim = 2>
Mesh<Dim> make_grid(const std::type_identity_t<Vec<Dim>>& origin, const std::type_identity_t<Vec<Dim>>& size,
                    const std::type_identity_t<std::array<int, Dim>>& elements,
                    GridFunctions functions = GridFunctions::linear);

}  // namespace scarp
