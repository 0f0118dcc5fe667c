// Meshes of space for tests, made without the code under test where that matters.
#pragma once

#include <algorithm>
#include <random>
#include <vector>

#include "listed.hpp"
#include "scarp/mesh/build.hpp"
#include "scarp/mesh/grid.hpp"
#include "scarp/mesh/mesh.hpp"

namespace scarp::test {

enum class Solid { hexahedra, tetrahedra, mixed };

inline void add_element(Mesh<3>& mesh, ElementType type, const std::vector<int>& nodes) {
  mesh.lists.types.push_back(type);
  mesh.lists.connectivity.insert(mesh.lists.connectivity.end(), nodes.begin(), nodes.end());
  mesh.lists.offsets.push_back(static_cast<int>(mesh.lists.connectivity.size()));
}

/// An n x n x n mesh of the unit cube with nodes moved at random by up to `shake` spacings (not off the sides), graded
/// towards the left if `graded`. Tetrahedra come six to a cube, around its diagonal, so that those of neighbours fit.
/// In a mixed mesh the left half is of hexahedra, and the nodes of the plane between stay in it.
inline Mesh<3> irregular(int n, double shake, Solid kind, bool graded = true) {
  const Mesh<3> regular = make_grid<3>({0, 0, 0}, {1, 1, 1}, {n, n, n});
  std::mt19937 random(7);
  std::uniform_real_distribution<double> move(-shake / n, shake / n);
  const double middle = regular.node(n / 2)[0];
  Mesh<3> mesh;
  for (int node = 0; node < regular.node_count(); ++node) {
    Vec<3> x = regular.node(node);
    const bool between = kind == Solid::mixed && x[0] == middle;
    for (int k = 0; k < 3; ++k)
      if (x[k] > 0 && x[k] < 1 && !(between && k == 0)) x[k] += move(random);
    mesh.lists.nodes.push_back({graded ? 0.5 * x[0] * (1 + x[0]) : x[0], x[1], x[2]});
  }
  mesh.lists.offsets.push_back(0);
  for (int e = 0; e < regular.element_count(); ++e) {
    const auto c = regular.element_nodes(e);
    if (kind == Solid::hexahedra || (kind == Solid::mixed && e % n < n / 2)) {
      add_element(mesh, ElementType::H8, {c.begin(), c.end()});
    } else {
      constexpr int cut[6][4] = {{0, 1, 2, 6}, {0, 3, 7, 6}, {0, 4, 5, 6}, {0, 5, 1, 6}, {0, 2, 3, 6}, {0, 7, 4, 6}};
      for (const auto& t : cut) add_element(mesh, ElementType::T4, {c[t[0]], c[t[1]], c[t[2]], c[t[3]]});
    }
  }
  complete(mesh);
  return mesh;
}

/// The same elements in another order, with the nodes in another order too.
inline Mesh<3> shuffled(const Mesh<3>& mesh) {
  std::mt19937 random(3);
  std::vector<int> elements(mesh.element_count()), nodes(mesh.node_count());
  for (std::size_t i = 0; i < elements.size(); ++i) elements[i] = static_cast<int>(i);
  for (std::size_t i = 0; i < nodes.size(); ++i) nodes[i] = static_cast<int>(i);
  std::shuffle(elements.begin(), elements.end(), random);
  std::shuffle(nodes.begin(), nodes.end(), random);
  Mesh<3> other;
  other.lists.nodes.resize(nodes.size());
  for (int i = 0; i < mesh.node_count(); ++i) other.lists.nodes[nodes[i]] = mesh.node(i);
  other.lists.offsets.push_back(0);
  for (int e : elements) {
    std::vector<int> renumbered;
    for (int node : mesh.element_nodes(e)) renumbered.push_back(nodes[node]);
    add_element(other, mesh.type_of(e), renumbered);
  }
  return other;
}

/// A local point of the inside of an element, not nearer to its boundary than `margin`.
template <class Shape>
Vec<3> point_inside(std::mt19937& random, double margin = 0) {
  if constexpr (Shape::nodes == 8) {
    std::uniform_real_distribution<double> u(-1 + margin, 1 - margin);
    return {u(random), u(random), u(random)};
  } else {
    std::uniform_real_distribution<double> u(margin, 1);
    while (true) {
      const Vec<3> xi = {u(random), u(random), u(random)};
      if (xi[0] + xi[1] + xi[2] < 1 - margin) return xi;
    }
  }
}

}  // namespace scarp::test
