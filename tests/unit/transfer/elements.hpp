// Single elements of every kind with a few points, for tests of the transfers.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "mesh/meshes.hpp"
#include "mesh/solids.hpp"
#include "scarp/mesh/with_basis.hpp"
#include "scarp/points/points.hpp"

namespace scarp::test {

/// A mesh, an element inside it, and its name.
template <int Dim>
struct Case {
  std::string name;
  Mesh<Dim> mesh;
  int element;
};

/// An element inside the mesh of the unit square or cube, of this type.
template <int Dim>
int inner_element(const Mesh<Dim>& mesh, ElementType type) {
  for (int e = 0; e < mesh.element_count(); ++e) {
    bool inside = mesh.type_of(e) == type;
    for (const int n : mesh.element_nodes(e)) {
      for (const double x : mesh.node(n)) inside = inside && x > 0.2 && x < 0.8;
    }
    if (inside) return e;
  }
  throw std::runtime_error("the mesh has no such element");
}

/// The cell in the middle of grids of 5 cells along each axis.
template <int Dim>
std::vector<Case<Dim>> every_grid() {
  std::vector<Case<Dim>> all;
  for (const auto& [name, functions] :
       {std::pair{"grid", GridFunctions::linear}, std::pair{"gimp", GridFunctions::gimp},
        std::pair{"b-spline", GridFunctions::b_spline}}) {
    if constexpr (Dim == 2) all.push_back({name, make_grid({0, 0}, {1, 1}, {5, 5}, functions), 12});
    if constexpr (Dim == 3) all.push_back({name, make_grid<3>({0, 0, 0}, {1, 1, 1}, {5, 5, 5}, functions), 62});
  }
  return all;
}

inline std::vector<Case<2>> plane_cases() {
  auto all = every_grid<2>();
  auto quads = irregular(6, 0.2, Kind::quads), triangles = irregular(6, 0.2, Kind::triangles);
  const int q = inner_element(quads, ElementType::Q4), t = inner_element(triangles, ElementType::T3);
  all.push_back({"quadrilateral", std::move(quads), q});
  all.push_back({"triangle", std::move(triangles), t});
  return all;
}
inline std::vector<Case<3>> solid_cases() {
  auto all = every_grid<3>();
  auto boxes = irregular(6, 0.1, Solid::hexahedra), tetrahedra = irregular(6, 0.1, Solid::tetrahedra);
  const int b = inner_element(boxes, ElementType::H8), t = inner_element(tetrahedra, ElementType::T4);
  all.push_back({"hexahedron", std::move(boxes), b});
  all.push_back({"tetrahedron", std::move(tetrahedra), t});
  return all;
}

/// Local coordinates of an element of the geometry: of a place inside, on a side, on an edge, at a corner.
template <int Dim>
std::vector<Vec<Dim>> places(ElementType type) {
  const bool simplex = type == ElementType::T3 || type == ElementType::T4;
  const double low = simplex ? 0 : -1;
  Vec<Dim> inside, side, edge, corner;
  for (int k = 0; k < Dim; ++k) {
    inside[k] = simplex ? 0.2 + 0.05 * k : 0.3 - 0.4 * k;
    side[k] = k == 0 ? low : inside[k];
    edge[k] = k < Dim - 1 ? low : inside[k];
    corner[k] = low;
  }
  return {inside, side, edge, corner};
}

/// Points at some of these places, each with numbers of its own.
template <int Dim>
Points<Dim> points_at(const Case<Dim>& of, const std::type_identity_t<std::vector<Vec<Dim>>>& at) {
  Block<Dim> block("soil", LinearElastic({1e3, 0.3}));
  auto& points = block.points;
  for (auto& column : points.xi) column.resize(1);
  resize(block, static_cast<int>(at.size()));
  const auto corner_of = [&](const Vec<Dim>& xi) {
    Vec<Dim> x{};
    if (of.mesh.grid) {
      const auto cell = of.mesh.grid->cell(of.element);
      for (int k = 0; k < Dim; ++k)
        x[k] = of.mesh.grid->origin[k] + (cell[k] + 0.5 * (1 + xi[k])) * of.mesh.grid->spacing[k];
      return x;
    }
    with_shape<Dim>(of.mesh.type_of(of.element), [&]<class Shape>(Shape) {
      const auto x_i = node_positions<Shape>(of.mesh, of.element);
      std::array<double, Shape::nodes> N;
      Shape::shape(xi, N);
      for (int i = 0; i < Shape::nodes; ++i) {
        for (int k = 0; k < Dim; ++k) x[k] += N[i] * x_i[i][k];
      }
    });
    return x;
  };
  for (int i = 0; i < static_cast<int>(at.size()); ++i) {
    points.mass[i] = 1 + 0.3 * i;
    points.volume[i] = points.initial_volume[i] = Dim == 2 ? 0.008 : 0.0008;
    for (int k = 0; k < Dim; ++k) {
      points.x[k][i] = corner_of(at[i])[k];
      points.xi[k][i] = at[i][k];
      points.v[k][i] = 0.7 - 0.4 * k + 0.9 * i;
    }
    for (int c = 0; c < sym_size<Dim>; ++c) points.sigma[c][i] = -3 + 0.5 * c - i;
  }
  return points;
}

/// These, cells in the corners of grids, where B-splines and the domains of GIMP end, and plane ones as meridian planes
/// of bodies of revolution.
template <int Dim>
std::vector<Case<Dim>> every_case() {
  std::vector<Case<Dim>> all;
  if constexpr (Dim == 2) {
    all = plane_cases();
    for (auto& of : plane_cases()) {
      if (of.mesh.grid && of.mesh.grid->functions == GridFunctions::gimp) continue;
      of.name += " of revolution";
      of.mesh.axisymmetric = true;
      all.push_back(std::move(of));
    }
  } else {
    all = solid_cases();
  }
  for (int corner = 0; corner < 2; ++corner) {
    for (auto& of : every_grid<Dim>()) {
      of.name += corner == 0 ? " in the first cell" : " in the last cell";
      of.element = corner == 0 ? 0 : of.mesh.element_count() - 1;
      all.push_back(std::move(of));
    }
  }
  return all;
}

/// So many points in random places of the element, with numbers of their own and a C_p.
template <int Dim>
Points<Dim> random_points(const Case<Dim>& of, int count, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0.02, 0.98), any(-1, 1);
  const bool simplex = of.mesh.type_of(of.element) == ElementType::T3 || of.mesh.type_of(of.element) == ElementType::T4;
  std::vector<Vec<Dim>> at;
  for (int i = 0; i < count; ++i) {
    Vec<Dim> xi;
    double left = 1;
    for (double& x : xi) {
      x = simplex && !of.mesh.grid ? left * unit(random) : 2 * unit(random) - 1;
      left -= x;
    }
    at.push_back(xi);
  }
  auto points = points_at(of, at);
  for (auto& column : points.C) column.resize(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    points.mass[i] = 1 + 0.5 * any(random);
    points.volume[i] *= 1 + 0.5 * any(random);
    for (auto& column : points.v) column[i] = any(random);
    for (auto& column : points.C) column[i] = any(random);
    for (auto& column : points.sigma) column[i] = any(random);
  }
  return points;
}

/// Random vectors of n numbers for the nodes of an element, in rows that may be read beyond them.
template <class Basis, int n>
std::array<std::array<double, 8>, Basis::nodes> random_rows(double size, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> any(-size, size);
  std::array<std::array<double, 8>, Basis::nodes> rows{};
  for (auto& row : rows) {
    for (int c = 0; c < n; ++c) row[c] = any(random);
  }
  return rows;
}

/// The largest difference of numbers from what they should be, over the largest of these.
class Deviation {
 public:
  void add(double is, double should) {
    largest_ = std::max(largest_, std::abs(should));
    difference_ = std::max(difference_, std::isnan(is) ? 1e300 : std::abs(is - should));
  }
  double relative() const { return difference_ / largest_; }

 private:
  double largest_ = 1e-12, difference_ = 0;
};

/// f(basis, cell, case, points, which) for every case of this dimension with 1 to 9 points, so that lanes are filled in
/// part and more than once: points that lie beside each other in their arrays, and every second one.
template <int Dim, class F>
void for_every_basis(F&& f) {
  for (const auto& of : every_case<Dim>()) {
    for (int count = 1; count <= 9; ++count) {
      for (const int stride : {1, 2}) {
        const auto points = random_points(of, stride * count, static_cast<unsigned>(10 * count + stride));
        std::vector<int> which;
        for (int i = 0; i < count; ++i) which.push_back(stride * i);
        SCOPED_TRACE(of.name + ", " + std::to_string(count) + " points, every " + std::to_string(stride));
        with_basis<Dim>(of.mesh, &of.element, 0, 1, [&]<class Basis>(Basis basis, int, int e) {
          const typename Basis::Cell cell(of.mesh, e);
          f(basis, cell, of, points, which);
        });
      }
    }
  }
}

}  // namespace scarp::test
