// A grid as what it was when its nodes and elements were kept one by one.
#pragma once

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "scarp/mesh/build.hpp"
#include "scarp/mesh/grid.hpp"
#include "scarp/mesh/mesh.hpp"

namespace scarp::test {

/// Nodes and local nodes of a grid, written down one after the other as the numbering has them: x fastest, then y, then
/// z. Independent of the code under test, which finds them from numbers. Without neighbours, sizes and sides.
template <int Dim>
MeshLists<Dim> written_down(const Vec<Dim>& origin, const Vec<Dim>& size, std::array<int, Dim> elements,
                            GridFunctions functions) {
  const bool spline = functions == GridFunctions::b_spline, gimp = functions == GridFunctions::gimp;
  // In the plane: one layer.
  std::array<int, 3> n{1, 1, 1}, lines{1, 1, 1}, each{1, 1, 1};
  for (int k = 0; k < Dim; ++k) {
    n[k] = elements[k];
    lines[k] = elements[k] + (spline ? 2 : 1);
    each[k] = gimp ? 4 : spline ? 3 : 2;
  }
  MeshLists<Dim> lists;
  const auto place = [&](int k, int i) {  // in elements from the origin
    return spline ? std::min(std::max(i - 0.5, 0.0), static_cast<double>(n[k])) : i;
  };
  for (int z = 0; z < lines[2]; ++z)
    for (int y = 0; y < lines[1]; ++y)
      for (int x = 0; x < lines[0]; ++x) {
        const std::array<int, 3> i{x, y, z};
        Vec<Dim> at;
        for (int k = 0; k < Dim; ++k) at[k] = origin[k] + place(k, i[k]) * size[k] / n[k];
        lists.nodes.push_back(at);
      }
  lists.offsets.push_back(0);
  for (int z = 0; z < n[2]; ++z)
    for (int y = 0; y < n[1]; ++y)
      for (int x = 0; x < n[0]; ++x) {
        const std::array<int, 3> at{x, y, z};
        std::array<int, 3> node;
        for (int c = 0; c < each[2]; ++c)
          for (int b = 0; b < each[1]; ++b)
            for (int a = 0; a < each[0]; ++a) {
              const std::array<int, 3> i{a, b, c};
              for (int k = 0; k < 3; ++k) {
                node[k] = at[k] + i[k] - (gimp && k < Dim ? 1 : 0);
                node[k] = std::min(std::max(node[k], 0), lines[k] - 1);
              }
              lists.connectivity.push_back(node[0] + lines[0] * (node[1] + lines[1] * node[2]));
            }
        // The corners of a face run round it.
        auto first = lists.connectivity.begin() + lists.offsets.back();
        for (; !spline && !gimp && first != lists.connectivity.end(); first += 4) std::swap(first[2], first[3]);
        lists.types.push_back(Dim == 2 ? ElementType::Q4 : ElementType::H8);
        lists.offsets.push_back(static_cast<int>(lists.connectivity.size()));
      }
  return lists;
}

/// The elements of a grid of linear functions as a mesh of lists.
template <int Dim>
Mesh<Dim> as_lists(const Mesh<Dim>& mesh) {
  const auto& grid = *mesh.grid;
  Vec<Dim> size;
  for (int k = 0; k < Dim; ++k) size[k] = grid.lines[k].back() - grid.lines[k].front();
  Mesh<Dim> plain;
  plain.lists = written_down<Dim>(grid.origin, size, grid.elements, grid.functions);
  complete(plain);
  return plain;
}

}  // namespace scarp::test
