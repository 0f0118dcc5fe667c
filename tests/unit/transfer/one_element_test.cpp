// Points of one element to its nodes and back, apart from any step. Functions of every basis reproduce linear fields,
// so that sums at the nodes have the points' mass, momentum, angular momentum and virial, and points take linear fields
// of the nodes as they are, wherever they lie.
#include <gtest/gtest.h>

#include <array>
#include <map>
#include <type_traits>
#include <vector>

#include "elements.hpp"
#include "scarp/mesh/with_basis.hpp"
#include "scarp/transfer/nodes_to_points.hpp"
#include "scarp/transfer/points_to_nodes.hpp"

namespace scarp::test {
namespace {

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
  PointIncrements<Dim> increments;
  increments.reserve(count);
  with_basis<Dim>(of.mesh, &of.element, 0, 1, [&]<class Basis>(Basis, int, int e) {
    const typename Basis::Cell cell(of.mesh, e);
    const auto number = of.mesh.element_nodes(e);
    std::array<transfer::Motion<Dim>, Basis::nodes> motion{};
    const std::array<double, 1024> no_correction{};
    transfer::ElementMotion<Basis> element{{}, no_correction.data(), 1, of.mesh.size_of(e)};
    for (int n = 0; n < Basis::nodes; ++n) {
      for (int j = 0; j < Dim; ++j) {
        motion[n].dv(j) = field(0, j, of.mesh.node(number[n]));
        motion[n].du(j) = field(1, j, of.mesh.node(number[n]));
      }
      element.motion[n] = motion[n].row.data();
    }
    transfer::MotionSums<Dim> sums;
    transfer::nodes_to_points<false, Basis>(cell, element, {}, {}, points, {order.data(), count}, increments, 0,
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
        EXPECT_NEAR(increments.deps[transfer::mandel(j, k)][i], strain, 1e-13) << j << k;
      }
    }
  }
}

/// The corners of an element of the geometry.
template <int Dim>
std::vector<Vec<Dim>> corners_of(const Mesh<Dim>& mesh, int e) {
  std::vector<Vec<Dim>> corners;
  if (mesh.grid) {
    const auto cell = mesh.grid->cell(e);
    for (int c = 0; c < 1 << Dim; ++c) {
      Vec<Dim> x;
      for (int d = 0; d < Dim; ++d) x[d] = mesh.grid->origin[d] + (cell[d] + (c >> d & 1)) * mesh.grid->spacing[d];
      corners.push_back(x);
    }
  } else {
    for (const int n : mesh.element_nodes(e)) corners.push_back(mesh.node(n));
  }
  return corners;
}
template <int Dim>
int corners_in_common(const Mesh<Dim>& mesh, int a, int b) {
  int common = 0;
  for (const auto& x : corners_of(mesh, a)) {
    for (const auto& y : corners_of(mesh, b)) {
      double off = 0;
      for (int d = 0; d < Dim; ++d) off += std::abs(x[d] - y[d]);
      common += off < 1e-12;
    }
  }
  return common;
}

template <int Dim>
bool is_box(const Mesh<Dim>& mesh, int e) {
  return mesh.grid || mesh.type_of(e) == ElementType::Q4 || mesh.type_of(e) == ElementType::H8;
}

/// Local coordinates of x in an element of the geometry.
template <int Dim>
Vec<Dim> local_place(const Mesh<Dim>& mesh, int e, const std::type_identity_t<Vec<Dim>>& x) {
  Vec<Dim> xi;
  if (mesh.grid) {
    const auto cell = mesh.grid->cell(e);
    for (int d = 0; d < Dim; ++d) xi[d] = 2 * ((x[d] - mesh.grid->origin[d]) / mesh.grid->spacing[d] - cell[d]) - 1;
    return xi;
  }
  with_shape<Dim>(mesh.type_of(e),
                  [&]<class Shape>(Shape) { xi = Shape::local_coordinates(node_positions<Shape>(mesh, e), x); });
  return xi;
}

/// Local coordinates of a place on each side of an element of the geometry, not in its middle.
template <int Dim>
std::vector<Vec<Dim>> places_on_sides(const Mesh<Dim>& mesh, int e) {
  std::vector<Vec<Dim>> all;
  if (is_box(mesh, e)) {
    for (int d = 0; d < Dim; ++d) {
      for (const double end : {-1.0, 1.0}) {
        Vec<Dim> xi;
        xi.fill(0.3);
        xi[d] = end;
        all.push_back(xi);
      }
    }
    return all;
  }
  for (int d = 0; d <= Dim; ++d) {
    Vec<Dim> xi;
    xi.fill(0.3);
    if (d < Dim) xi[d] = 0;
    if (d == Dim) xi[0] = 1 - 0.3 * (Dim - 1);
    all.push_back(xi);
  }
  return all;
}

template <int Dim>
bool is_inside(const Mesh<Dim>& mesh, int e, const std::type_identity_t<Vec<Dim>>& xi) {
  double sum = 0;
  for (const double x : xi) {
    if (is_box(mesh, e) ? std::abs(x) > 1 + 1e-9 : x < -1e-9) return false;
    sum += x;
  }
  return is_box(mesh, e) || sum < 1 + 1e-9;
}

/// A point on the side between two elements brings the same m and p to the same nodes from either, and to no others; of
/// functions with one gradient there (B-splines, GIMP) also F_int.
template <int Dim>
void expect_same_from_both_sides(const Case<Dim>& of, bool smooth) {
  int neighbours = 0;
  for (const auto& xi : places_on_sides(of.mesh, of.element)) {
    const auto point = points_at(of, {xi});
    for (int other = 0; other < of.mesh.element_count(); ++other) {
      if (other == of.element || corners_in_common(of.mesh, of.element, other) < Dim) continue;
      const Vec<Dim> xi_there = local_place(of.mesh, other, position_of(point, 0));
      if (!is_inside(of.mesh, other, xi_there)) continue;
      ++neighbours;
      std::map<int, std::array<double, transfer::node_sums<Dim>>> here, there;
      const Case<Dim> from{of.name, of.mesh, other};
      const auto own = to_nodes(of, point), others = to_nodes(from, points_at(from, {xi_there}));
      for (std::size_t n = 0; n < own.size(); ++n) here[of.mesh.element_nodes(of.element)[n]] = own[n];
      for (std::size_t n = 0; n < others.size(); ++n) there[of.mesh.element_nodes(other)[n]] = others[n];
      for (const auto& [a, b] : {std::pair{here, there}, std::pair{there, here}}) {
        for (const auto& [n, sums] : a) {
          for (int q = 0; q < 1 + (smooth ? 2 : 1) * Dim; ++q)
            EXPECT_NEAR(sums[q], b.contains(n) ? b.at(n)[q] : 0, 1e-12) << of.name << " " << q;
        }
      }
    }
  }
  EXPECT_EQ(neighbours, static_cast<int>(places_on_sides(of.mesh, of.element).size()));
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
    expect_same_from_both_sides(of, of.name == "gimp" || of.name == "b-spline");
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
