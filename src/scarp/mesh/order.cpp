#include "scarp/mesh/order.hpp"

#include <algorithm>
#include <cstdint>
#include <utility>

namespace scarp {
namespace {

/// Place of the cell (x, y), of 2^levels cells a side, on the Hilbert curve (Hilbert 1891): at each level the
/// quadrants follow as (0,0), (0,1), (1,1), (1,0), the first and last of them turned.
std::uint64_t hilbert_place(std::uint32_t x, std::uint32_t y, int levels) {
  std::uint64_t place = 0;
  for (int level = levels - 1; level >= 0; --level) {
    const std::uint32_t right = (x >> level) & 1u, up = (y >> level) & 1u;
    place = 4 * place + (3 * right ^ up);
    if (up == 0) {
      if (right == 1) {
        x = ~x;
        y = ~y;
      }
      std::swap(x, y);
    }
  }
  return place;
}

std::vector<Vec<2>> centres(const Mesh<2>& mesh) {
  std::vector<Vec<2>> all(mesh.types.size());
  for (int e = 0; e < mesh.element_count(); ++e) {
    const auto nodes = mesh.element_nodes(e);
    for (int node : nodes)
      for (int k = 0; k < 2; ++k) all[e][k] += mesh.nodes[node][k] / static_cast<double>(nodes.size());
  }
  return all;
}

std::vector<int> elements_along_curve(const Mesh<2>& mesh) {
  constexpr int levels = 20;
  const std::vector<Vec<2>> centre = centres(mesh);
  Vec<2> low = centre[0], high = low;
  for (const Vec<2>& x : centre)
    for (int k = 0; k < 2; ++k) {
      low[k] = std::min(low[k], x[k]);
      high[k] = std::max(high[k], x[k]);
    }
  const double extent = std::max(high[0] - low[0], high[1] - low[1]);
  // An odd margin keeps the centres of regular meshes off the cells' lines, where the last bit of a coordinate would
  // decide.
  const double margin = 0.0137 * extent, cells = (1u << levels) / (extent > 0 ? 1.03 * extent : 1.0);
  std::vector<std::pair<std::uint64_t, int>> places;
  for (int e = 0; e < mesh.element_count(); ++e) {
    std::array<std::uint32_t, 2> cell;
    for (int k = 0; k < 2; ++k) cell[k] = static_cast<std::uint32_t>((centre[e][k] - low[k] + margin) * cells);
    places.emplace_back(hilbert_place(cell[0], cell[1], levels), e);
  }
  std::sort(places.begin(), places.end());
  std::vector<int> order;
  for (const auto& [place, e] : places) order.push_back(e);
  return order;
}

}  // namespace

void order_along_curve(Mesh<2>& mesh) {
  if (mesh.types.empty()) return;
  Mesh<2> sorted;
  std::vector<int> number(mesh.nodes.size(), -1);
  sorted.offsets.push_back(0);
  for (int e : elements_along_curve(mesh)) {
    for (int node : mesh.element_nodes(e)) {
      if (number[node] < 0) {
        number[node] = sorted.node_count();
        sorted.nodes.push_back(mesh.nodes[node]);
      }
      sorted.connectivity.push_back(number[node]);
    }
    sorted.types.push_back(mesh.types[e]);
    sorted.offsets.push_back(static_cast<int>(sorted.connectivity.size()));
  }
  for (const auto& [name, set] : mesh.node_sets) {
    std::vector<int>& renumbered = sorted.node_sets[name];
    for (int node : set)
      if (number[node] >= 0) renumbered.push_back(number[node]);
    std::sort(renumbered.begin(), renumbered.end());
  }
  mesh = std::move(sorted);
}

}  // namespace scarp
