// Points of one element to its nodes and back, apart from any step. Functions of every basis reproduce linear fields,
// so that sums at the nodes have the points' mass, momentum, angular momentum and virial, and points take linear fields
// of the nodes as they are, wherever they lie.
#include <gtest/gtest.h>

#include <array>
#include <type_traits>
#include <vector>

#include "mesh/meshes.hpp"
#include "mesh/solids.hpp"
#include "scarp/mesh/with_basis.hpp"
#include "scarp/transfer/transfer.hpp"

namespace scarp::test {
namespace {

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

std::vector<Case<2>> plane_cases() {
  std::vector<Case<2>> all;
  for (const auto& [name, functions] :
       {std::pair{"grid", GridFunctions::linear}, std::pair{"gimp", GridFunctions::gimp},
        std::pair{"b-spline", GridFunctions::b_spline}})
    all.push_back({name, make_grid({0, 0}, {1, 1}, {5, 5}, functions), 12});
  auto quads = irregular(6, 0.2, Kind::quads), triangles = irregular(6, 0.2, Kind::triangles);
  const int q = inner_element(quads, ElementType::Q4), t = inner_element(triangles, ElementType::T3);
  all.push_back({"quadrilateral", std::move(quads), q});
  all.push_back({"triangle", std::move(triangles), t});
  return all;
}
std::vector<Case<3>> solid_cases() {
  std::vector<Case<3>> all;
  for (const auto& [name, functions] :
       {std::pair{"grid", GridFunctions::linear}, std::pair{"gimp", GridFunctions::gimp},
        std::pair{"b-spline", GridFunctions::b_spline}})
    all.push_back({name, make_grid<3>({0, 0, 0}, {1, 1, 1}, {5, 5, 5}, functions), 62});
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

/// m, p and F_int of the nodes of the element, in its order.
template <int Dim>
std::vector<std::array<double, transfer::node_sums<Dim>>> to_nodes(const Case<Dim>& of, const Points<Dim>& points) {
  std::vector<int> order(points.mass.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = static_cast<int>(i);
  std::vector<std::array<double, transfer::node_sums<Dim>>> nodes;
  with_basis<Dim>(of.mesh, &of.element, 0, 1, [&]<class Basis>(Basis, int, int e) {
    const typename Basis::Cell cell(of.mesh, e);
    const transfer::ShapesAtPoints<Basis> shapes(cell);
    transfer::ElementSums<Basis> sums;
    transfer::points_to_nodes<Basis>(shapes, transfer::NoPlaces{}, points,
                                     {order.data(), static_cast<int>(order.size())}, std::false_type{}, sums);
    std::array<int, Basis::nodes> place;
    for (int n = 0; n < Basis::nodes; ++n) place[n] = n;
    nodes.assign(Basis::nodes, {});
    transfer::add_to_nodes<Basis>(sums, transfer::internal_force<Basis>(sums, {}), place.data(), nodes[0].data());
  });
  return nodes;
}

/// What nodes have of mass, momentum, ∑ x p and ∑ x F, and the points of ∑ x m v and ∑ Ω σ.
template <int Dim>
void expect_sums(const Case<Dim>& of, const Points<Dim>& points) {
  const auto nodes = to_nodes(of, points);
  const auto number = of.mesh.element_nodes(of.element);
  double m = 0, of_points = 0;
  Vec<Dim> p{}, p_points{}, F{}, centre{}, centre_points{};
  std::array<std::array<double, Dim>, Dim> xp{}, xp_points{}, xF{}, virial{};
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    const auto& x = of.mesh.node(number[n]);
    m += nodes[n][0];
    for (int j = 0; j < Dim; ++j) {
      p[j] += nodes[n][1 + j];
      F[j] += nodes[n][1 + Dim + j];
      centre[j] += nodes[n][0] * x[j];
      for (int k = 0; k < Dim; ++k) {
        xp[j][k] += x[j] * nodes[n][1 + k];
        xF[j][k] += x[j] * nodes[n][1 + Dim + k];
      }
    }
  }
  for (std::size_t i = 0; i < points.mass.size(); ++i) {
    of_points += points.mass[i];
    for (int j = 0; j < Dim; ++j) {
      p_points[j] += points.mass[i] * points.v[j][i];
      centre_points[j] += points.mass[i] * points.x[j][i];
      for (int k = 0; k < Dim; ++k) {
        xp_points[j][k] += points.x[j][i] * points.mass[i] * points.v[k][i];
        virial[j][k] += points.volume[i] * points.sigma[transfer::mandel(j, k)][i] / (j == k ? 1 : sqrt2);
      }
    }
  }
  const double tiny = 1e-13;
  EXPECT_NEAR(m, of_points, tiny);
  for (int j = 0; j < Dim; ++j) {
    EXPECT_NEAR(p[j], p_points[j], tiny);
    EXPECT_NEAR(F[j], 0, tiny);
    EXPECT_NEAR(centre[j], centre_points[j], tiny);
    for (int k = 0; k < Dim; ++k) {
      EXPECT_NEAR(xp[j][k], xp_points[j][k], tiny) << j << k;  // the part j k − k j is the angular momentum
      EXPECT_NEAR(xF[j][k], virial[j][k], tiny) << j << k;
    }
  }
}

/// Nodes that change their velocity by a + A x and move by b + B x: so do the points.
template <int Dim>
void expect_linear_fields(const Case<Dim>& of, Points<Dim> points) {
  const auto field = [](int kind, int j, const Vec<Dim>& x) {
    double value = 0.3 + 0.1 * kind - 0.2 * j;
    for (int k = 0; k < Dim; ++k) value += 0.01 * (1 + kind + 2 * j - 3 * k) * x[k];
    return value;
  };
  const Points<Dim> before = points;
  std::vector<int> order(points.mass.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = static_cast<int>(i);
  const int count = static_cast<int>(order.size());
  Strains<Dim> strains;
  strains.reserve(count);
  with_basis<Dim>(of.mesh, &of.element, 0, 1, [&]<class Basis>(Basis, int, int e) {
    const typename Basis::Cell cell(of.mesh, e);
    const auto number = of.mesh.element_nodes(e);
    std::array<transfer::Motion<Dim>, Basis::nodes> motion{};
    const std::array<double, 1024> no_shift{};
    transfer::ElementMotion<Basis> element{{}, {}, no_shift.data(), 1, of.mesh.size_of(e)};
    for (int n = 0; n < Basis::nodes; ++n) {
      for (int j = 0; j < Dim; ++j) {
        motion[n].dv(j) = field(0, j, of.mesh.node(number[n]));
        motion[n].du(j) = field(1, j, of.mesh.node(number[n]));
      }
      element.motion[n] = motion[n].row.data();
    }
    transfer::MotionSums<Dim> sums;
    transfer::nodes_to_points<false, Basis>(cell, element, {}, points, {order.data(), count}, strains, 0,
                                            std::false_type{}, sums, [](const auto&, const auto&, const auto&) {});
  });
  for (int i = 0; i < count; ++i) {
    const auto x = position_of(before, i);
    for (int j = 0; j < Dim; ++j) {
      EXPECT_NEAR(points.v[j][i], before.v[j][i] + field(0, j, x), 1e-13);
      EXPECT_NEAR(points.x[j][i], x[j] + field(1, j, x), 1e-13);
      for (int k = j; k < Dim; ++k) {
        const double L_jk = 0.01 * (2 + 2 * j - 3 * k), L_kj = 0.01 * (2 + 2 * k - 3 * j);
        const double strain = j == k ? L_jk : (L_jk + L_kj) / sqrt2;
        EXPECT_NEAR(strains.deps[transfer::mandel(j, k)][i], strain, 1e-13) << j << k;
      }
    }
  }
}

template <int Dim>
void expect_all(const std::vector<Case<Dim>>& cases) {
  for (const auto& of : cases) {
    const auto all = places<Dim>(of.mesh.type_of(of.element));
    const char* names[] = {"inside", "on a side", "on an edge", "at a corner"};
    for (std::size_t i = 0; i < all.size(); ++i) {
      SCOPED_TRACE(of.name + ", one point " + names[i]);
      expect_sums(of, points_at(of, {all[i]}));
      expect_linear_fields(of, points_at(of, {all[i]}));
    }
    SCOPED_TRACE(of.name + ", several points");
    expect_sums(of, points_at(of, {all[0], all[1]}));
    expect_sums(of, points_at(of, all));
    expect_linear_fields(of, points_at(of, all));
  }
}

TEST(OneElement, InThePlane) {
  expect_all(plane_cases());
}
TEST(OneElement, InSpace) {
  expect_all(solid_cases());
}

}  // namespace
}  // namespace scarp::test
