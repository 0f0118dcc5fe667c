// From elements to nodes without races: every active element writes its own row, every node gathers from the elements
// around it in a fixed order. The result is the same to the last bit on any number of threads.
#pragma once

#include <array>
#include <vector>

#include "scarp/exec/parallel.hpp"
#include "scarp/mesh/shapes.hpp"
#include "scarp/points/points.hpp"

namespace scarp::exec {

/// Most local nodes of an element in 2D.
inline constexpr int row_nodes = 4;

/// One row of `row_nodes` sums for each active element.
template <class Sums>
using ElementRows = std::vector<std::array<Sums, row_nodes>>;

/// For each node of the mesh, the elements that have it and its local number there, elements ascending.
struct Incidence {
  struct Place {
    int element, local;
  };
  std::vector<int> offsets;
  std::vector<Place> places;
};

template <int Dim>
Incidence incidence(const Mesh<Dim>& mesh) {
  Incidence result;
  result.offsets.assign(mesh.node_count() + 1, 0);
  for (const int n : mesh.connectivity) ++result.offsets[n + 1];
  for (int n = 0; n < mesh.node_count(); ++n) result.offsets[n + 1] += result.offsets[n];
  result.places.resize(mesh.connectivity.size());
  std::vector<int> next(result.offsets.begin(), result.offsets.end() - 1);
  for (int e = 0; e < mesh.element_count(); ++e) {
    const auto nodes = mesh.element_nodes(e);
    for (int i = 0; i < static_cast<int>(nodes.size()); ++i) result.places[next[nodes[i]]++] = {e, i};
  }
  return result;
}

/// Nodes of the active elements, ascending.
template <int Dim>
std::vector<int> active_nodes(const Mesh<Dim>& mesh, const ActiveElements& active) {
  std::vector<char> touched(mesh.node_count(), 0);
  for (const int e : active.element) {
    for (const int n : mesh.element_nodes(e)) touched[n] = 1;
  }
  std::vector<int> nodes;
  for (int n = 0; n < mesh.node_count(); ++n) {
    if (touched[n]) nodes.push_back(n);
  }
  return nodes;
}

/// f(Shape{}, slot, element) for every active element, where the work of a chunk of elements is summed up in order.
template <class Sum, int Dim, class F>
Sum sweep_elements(const Mesh<Dim>& mesh, const ActiveElements& active, F&& f) {
  constexpr int chunk = 128;
  return sum_over_chunks<Sum>(active.size(), chunk, [&](int first, int last) {
    Sum sum{};
    for (int slot = first; slot < last; ++slot) {
      const int e = active.element[slot];
      with_shape<Dim>(mesh.types[e], [&](auto shape) { sum += f(shape, slot, e); });
    }
    return sum;
  });
}

/// f(place) for each active element at a node: step 2 of the report, in a fixed order.
template <class F>
void gather(const Incidence& incidence, const ActiveElements& active, int node, F&& f) {
  for (int k = incidence.offsets[node]; k < incidence.offsets[node + 1]; ++k) {
    const auto place = incidence.places[k];
    const int slot = active.slot[place.element];
    if (slot >= 0) f(slot, place.local);
  }
}

}  // namespace scarp::exec
