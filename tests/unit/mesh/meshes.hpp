// Meshes for tests, made without the code under test where that matters.
#pragma once

#include <cmath>
#include <functional>
#include <random>
#include <vector>

#include "listed.hpp"
#include "scarp/mesh/build.hpp"
#include "scarp/mesh/grid.hpp"
#include "scarp/mesh/mesh.hpp"

namespace scarp::test {

enum class Kind { quads, triangles, mixed };

/// An n x n mesh of the unit square with nodes moved at random by up to `shake` spacings (not on the sides), graded
/// towards the left, without the elements whose centre in the regular grid `removed` tells.
inline Mesh<2> irregular(int n, double shake, Kind kind, const std::function<bool(double, double)>& removed = {}) {
  const Mesh<2> regular = make_grid({0, 0}, {1, 1}, {n, n});
  std::mt19937 random(7);
  std::uniform_real_distribution<double> move(-shake / n, shake / n);
  Mesh<2> mesh;
  for (int i = 0; i < regular.node_count(); ++i) {
    Vec<2> x = regular.node(i);
    for (double& coordinate : x)
      if (coordinate > 0 && coordinate < 1) coordinate += move(random);
    mesh.lists.nodes.push_back({0.5 * x[0] * (1 + x[0]), x[1]});
  }
  mesh.lists.offsets.push_back(0);
  const auto add = [&](std::vector<int> nodes) {
    mesh.lists.types.push_back(nodes.size() == 3 ? ElementType::T3 : ElementType::Q4);
    mesh.lists.connectivity.insert(mesh.lists.connectivity.end(), nodes.begin(), nodes.end());
    mesh.lists.offsets.push_back(static_cast<int>(mesh.lists.connectivity.size()));
  };
  for (int e = 0; e < regular.element_count(); ++e) {
    if (removed && removed((e % n + 0.5) / n, (e / n + 0.5) / n)) continue;
    const auto c = regular.element_nodes(e);
    if (kind == Kind::quads || (kind == Kind::mixed && random() % 2 == 0)) {
      add({c[0], c[1], c[2], c[3]});
    } else if (random() % 2 == 0) {
      add({c[0], c[1], c[2]});
      add({c[0], c[2], c[3]});
    } else {
      add({c[0], c[1], c[3]});
      add({c[1], c[2], c[3]});
    }
  }
  complete(mesh);
  return mesh;
}

/// Is x inside element e, by the signs of the triangles that x makes with the edges? Independent of local coordinates.
inline bool contains(const Mesh<2>& mesh, int e, const Vec<2>& x, double margin = 0) {
  const auto nodes = mesh.element_nodes(e);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const Vec<2>&a = mesh.node(nodes[i]), &b = mesh.node(nodes[(i + 1) % nodes.size()]);
    if ((b[0] - a[0]) * (x[1] - a[1]) - (b[1] - a[1]) * (x[0] - a[0]) < -margin) return false;
  }
  return true;
}

/// The first element that contains x, by looking at all; -1 when none does.
inline int first_that_contains(const Mesh<2>& mesh, const Vec<2>& x, double margin = 0) {
  for (int e = 0; e < mesh.element_count(); ++e)
    if (contains(mesh, e, x, margin)) return e;
  return -1;
}

}  // namespace scarp::test
