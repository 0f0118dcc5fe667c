#include "scarp/mesh/order.hpp"

#include <algorithm>
#include <cstdint>
#include <utility>

#include "scarp/mesh/hilbert.hpp"

namespace scarp {
namespace {

constexpr int levels = 20;

template <int Dim>
std::vector<Vec<Dim>> centres(const Mesh<Dim>& mesh) {
  std::vector<Vec<Dim>> all(mesh.element_count());
  for (int e = 0; e < mesh.element_count(); ++e) {
    const auto nodes = mesh.element_nodes(e);
    for (int node : nodes)
      for (int k = 0; k < Dim; ++k) all[e][k] += mesh.node(node)[k] / static_cast<double>(nodes.size());
  }
  return all;
}

template <int Dim>
std::vector<int> elements_along_curve(const Mesh<Dim>& mesh) {
  const std::vector<Vec<Dim>> centre = centres(mesh);
  Vec<Dim> low = centre[0], high = low;
  for (const Vec<Dim>& x : centre)
    for (int k = 0; k < Dim; ++k) {
      low[k] = std::min(low[k], x[k]);
      high[k] = std::max(high[k], x[k]);
    }
  double extent = 0;
  for (int k = 0; k < Dim; ++k) extent = std::max(extent, high[k] - low[k]);
  // An odd margin keeps the centres of regular meshes off the cells' lines, where the last bit of a coordinate would
  // decide.
  const double margin = 0.0137 * extent, cells = (1u << levels) / (extent > 0 ? 1.03 * extent : 1.0);
  std::vector<std::pair<std::uint64_t, int>> places;
  places.reserve(mesh.element_count());
  for (int e = 0; e < mesh.element_count(); ++e) {
    std::array<std::uint32_t, Dim> cell;
    for (int k = 0; k < Dim; ++k) cell[k] = static_cast<std::uint32_t>((centre[e][k] - low[k] + margin) * cells);
    places.emplace_back(hilbert_place(cell, levels), e);
  }
  std::sort(places.begin(), places.end());
  std::vector<int> order;
  order.reserve(places.size());
  for (const auto& [place, e] : places) order.push_back(e);
  return order;
}

}  // namespace

template <int Dim>
void order_along_curve(Mesh<Dim>& mesh) {
  if (mesh.lists.types.empty()) return;
  Mesh<Dim> sorted;
  std::vector<int> number(mesh.node_count(), -1);
  sorted.lists.offsets.push_back(0);
  for (int e : elements_along_curve(mesh)) {
    for (int node : mesh.element_nodes(e)) {
      if (number[node] < 0) {
        number[node] = sorted.node_count();
        sorted.lists.nodes.push_back(mesh.node(node));
      }
      sorted.lists.connectivity.push_back(number[node]);
    }
    sorted.lists.types.push_back(mesh.type_of(e));
    sorted.lists.offsets.push_back(static_cast<int>(sorted.lists.connectivity.size()));
  }
  for (const auto& [name, set] : mesh.node_sets) {
    std::vector<int>& renumbered = sorted.node_sets[name];
    for (int node : set)
      if (number[node] >= 0) renumbered.push_back(number[node]);
    std::sort(renumbered.begin(), renumbered.end());
  }
  mesh = std::move(sorted);
}

template void order_along_curve(Mesh<2>&);
template void order_along_curve(Mesh<3>&);

}  // namespace scarp
