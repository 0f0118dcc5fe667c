// Background mesh: nodes, elements of several types, and what the step asks of them.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "scarp/base/vec.hpp"
#include "scarp/mesh/lattice.hpp"

namespace scarp {

/// What a mesh that is no grid keeps of each node and element. Local nodes run anticlockwise in the plane; in space as
/// Gmsh and VTK have them, so that det dx/dxi is positive.
template <int Dim>
struct MeshLists {
  std::vector<Vec<Dim>> nodes;
  std::vector<ElementType> types;  ///< one per element
  std::vector<int> offsets;        ///< elements + 1; local nodes of e are connectivity[offsets[e] ... offsets[e+1])
  std::vector<int> connectivity;
  std::vector<double> size;         ///< one per element, for the critical time step: least height (element_size) [m]
  std::vector<int> around_offsets;  ///< elements + 1; elements that share a node with e (e itself not) ...
  std::vector<int> around;          ///< ... ascending
};

/// A finite element mesh: lists, or a grid, of which nothing is kept for each node or element. Both answer alike.
template <int Dim>
struct Mesh {
  MeshLists<Dim> lists;                               ///< empty in a grid
  std::optional<Grid<Dim>> grid;                      ///< set when the mesh is a structured grid
  std::map<std::string, std::vector<int>> node_sets;  ///< ascending; the sides (add_side_sets) and named groups
  bool axisymmetric = false;  ///< the plane is the meridian plane of a body of revolution: x is the distance from its
                              ///< vertical axis, and volumes, masses and forces are those of one radian

  int element_count() const { return grid ? grid->element_count : static_cast<int>(lists.types.size()); }
  int node_count() const { return grid ? grid->node_count : static_cast<int>(lists.nodes.size()); }

  /// Where node n is: a corner of elements, or a control point.
  Vec<Dim> node(int n) const { return grid ? grid->node(n) : lists.nodes[n]; }
  ElementType type_of(int e) const {
    constexpr auto of_cells = Dim == 2 ? ElementType::Q4 : ElementType::H8;
    return grid ? of_cells : lists.types[e];
  }
  /// The size of element e for the critical time step: its least height, or less where functions are narrower
  /// (B-splines at the sides of a grid) [m].
  double size_of(int e) const { return grid ? grid->size_of(e) : lists.size[e]; }
  /// Those that carry the shape functions of element e; of a grid with other functions than linear ones see
  /// grid_bases.hpp.
  ElementNodes<Dim> element_nodes(int e) const {
    if (grid) return grid->element_nodes(e);
    return ElementNodes<Dim>(part(lists.connectivity, lists.offsets, e));
  }
  /// f(where it is) for each of them.
  template <class F>
  void for_local_positions(int e, F&& f) const {
    if (grid) return grid->for_local_nodes(e, [&](const std::array<int, Dim>& line) { f(grid->crossing(line)); });
    for (const int n : part(lists.connectivity, lists.offsets, e)) f(lists.nodes[n]);
  }
  /// The elements that share a corner with e, ascending, e itself not.
  ElementsAround<Dim> elements_around(int e) const {
    if (grid) return grid->around(e);
    return ElementsAround<Dim>(part(lists.around, lists.around_offsets, e));
  }

 private:
  static std::span<const int> part(const std::vector<int>& all, const std::vector<int>& offsets, int e) {
    return {all.data() + offsets[e], static_cast<std::size_t>(offsets[e + 1] - offsets[e])};
  }
};

}  // namespace scarp
