// Every basis in every element of small meshes: what shape functions must do whatever they are, and those of grids
// against their definitions (grid_oracles.hpp).
#include "scarp/mesh/with_basis.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "grid_oracles.hpp"
#include "meshes.hpp"
#include "scarp/mesh/grid.hpp"
#include "solids.hpp"

namespace scarp {
namespace {

// Sums of up to 64 products of numbers of order one; gradients are of order 1/h ≤ 100.
constexpr double value_band = 4e-15, slope_band = 1e-12;

/// What a basis takes as the place of a point, from x and half the edge of its domain.
template <class Basis, class T>
auto place_in(const typename Basis::Cell& cell, const std::array<T, Basis::dim>& x, double half,
              const std::array<T, Basis::dim>& xi) {
  if constexpr (Basis::stores_local) {
    return xi;
  } else if constexpr (Basis::has_domains) {
    return cell.local(x, T(half));
  } else {
    return cell.local(x);
  }
}

/// A point of element e: its position, and its local coordinates where the element is no cell of a grid.
template <int Dim>
struct Sample {
  Vec<Dim> x{}, xi{};
};

template <int Dim>
Sample<Dim> sample(const Mesh<Dim>& mesh, int e, std::mt19937& random) {
  std::uniform_real_distribution<double> part(0, 1);
  Sample<Dim> point;
  if (mesh.grid) {
    const auto at = mesh.grid->cell(e);
    for (int d = 0; d < Dim; ++d) {
      // A fifth of all lie near a side of the cell, some on it.
      double s = part(random);
      if (part(random) < 0.1) s = part(random) < 0.5 ? 0 : 1e-7;
      if (part(random) < 0.1) s = part(random) < 0.5 ? 1 : 1 - 1e-7;
      point.x[d] = mesh.grid->origin[d] + (at[d] + s) * mesh.grid->spacing[d];
    }
    return point;
  }
  return with_shape<Dim>(mesh.type_of(e), [&]<class Shape>(Shape) {
    if constexpr (Shape::nodes == Dim + 1) {
      for (double& c : point.xi) c = part(random) / Dim;
    } else {
      for (double& c : point.xi) c = 2 * part(random) - 1;
    }
    point.x = global_coordinates<Shape>(node_positions<Shape>(mesh, e), point.xi);
    return point;
  });
}

template <int Dim>
std::vector<Mesh<Dim>> grids(GridFunctions functions) {
  std::vector<Mesh<Dim>> all;
  for (const int n : {1, 2, 3, 5}) {
    if constexpr (Dim == 2) {
      all.push_back(make_grid<2>({1, -2}, {0.4 * n, 0.25 * 3}, {n, 3}, functions));
      all.push_back(make_grid<2>({-1, 0}, {0.1, 0.2 * n}, {1, n}, functions));
    } else {
      all.push_back(make_grid<3>({1, -2, 3}, {0.4 * n, 0.25 * 2, 0.1}, {n, 2, 1}, functions));
      all.push_back(make_grid<3>({0, 0, 0}, {0.3, 0.2 * 4, 0.2 * n}, {3, 4, n}, functions));
    }
  }
  return all;
}

template <int Dim>
std::vector<Mesh<Dim>> all_meshes() {
  std::vector<Mesh<Dim>> all;
  for (const auto functions : {GridFunctions::linear, GridFunctions::gimp, GridFunctions::b_spline})
    for (auto& mesh : grids<Dim>(functions)) all.push_back(std::move(mesh));
  if constexpr (Dim == 2) {
    for (const auto kind : {test::Kind::quads, test::Kind::triangles, test::Kind::mixed})
      all.push_back(test::irregular(3, 0.2, kind));
  } else {
    for (const auto kind : {test::Solid::hexahedra, test::Solid::tetrahedra, test::Solid::mixed})
      all.push_back(test::irregular(2, 0.1, kind));
  }
  return all;
}

/// Half the edges of domains that GIMP is tried with, in cells: none, tiny, in between, more than it takes.
constexpr double halves[] = {0, 1e-9, 0.17, 0.25, 0.5, 3};

/// f(basis, cell, e, sample, half) for random points of every element, and every half where the basis has domains.
template <int Dim, class F>
void for_points(const Mesh<Dim>& mesh, int each, F&& f) {
  std::mt19937 random(5);
  std::vector<int> elements;
  for (int e = 0; e < mesh.element_count(); ++e) elements.push_back(e);
  with_basis<Dim>(mesh, elements.data(), 0, mesh.element_count(), [&]<class Basis>(Basis basis, int, int e) {
    const typename Basis::Cell cell(mesh, e);
    for (int k = 0; k < each; ++k) {
      const auto point = sample(mesh, e, random);
      for (const double half : halves) {
        f(basis, cell, e, point, half * (mesh.grid ? mesh.grid->spacing[0] : 1));
        if (!Basis::has_domains) break;
      }
    }
  });
}

template <int Dim>
void expect_one_and_linear(const Mesh<Dim>& mesh) {
  for_points(mesh, 20, [&]<class Basis>(Basis, const auto& cell, int e, const auto& point, double half) {
    std::array<double, Basis::nodes> N, alone;
    std::array<Vec<Dim>, Basis::nodes> B;
    const auto at = place_in<Basis, double>(cell, point.x, half, point.xi);
    cell.gradients(at, N, B);
    cell.shape(at, alone);
    const auto nodes = mesh.element_nodes(e);
    ASSERT_EQ(static_cast<int>(nodes.size()), Basis::nodes);
    double one = 0;
    Vec<Dim> x{}, zero{}, identity[Dim]{};
    for (int i = 0; i < Basis::nodes; ++i) {
      EXPECT_EQ(N[i], alone[i]);
      EXPECT_GE(N[i], -value_band);
      one += N[i];
      for (int j = 0; j < Dim; ++j) {
        zero[j] += B[i][j];
        x[j] += N[i] * mesh.node(nodes[i])[j];
        for (int k = 0; k < Dim; ++k) identity[j][k] += mesh.node(nodes[i])[j] * B[i][k];
      }
    }
    EXPECT_NEAR(one, 1, value_band);
    for (int j = 0; j < Dim; ++j) {
      EXPECT_NEAR(zero[j], 0, slope_band);
      EXPECT_NEAR(x[j], point.x[j], 4 * value_band);  // of coordinates up to 4
      for (int k = 0; k < Dim; ++k) EXPECT_NEAR(identity[j][k], j == k ? 1 : 0, slope_band);
    }
  });
}

// Oracles: Σ N_i = 1, Σ N_i x_i = x, Σ ∇N_i = 0, Σ x_i ⊗ ∇N_i = I.
TEST(Basis, SumsToOneAndReproducesALinearFieldInThePlane) {
  for (const auto& mesh : all_meshes<2>()) expect_one_and_linear(mesh);
}
TEST(Basis, SumsToOneAndReproducesALinearFieldInSpace) {
  for (const auto& mesh : all_meshes<3>()) expect_one_and_linear(mesh);
}

/// A line cuts a domain of 1e-9 or 1e-7 cells to the round-off of x, 1e-15; so its shares on either side, which slopes
/// go with, to 1e-6.
constexpr double narrow_slope_band = 1e-4;
template <class Basis, int Dim>
bool is_narrow(const Mesh<Dim>& mesh, const Vec<Dim>& x, double half) {
  if (!Basis::has_domains || half == 0) return false;
  bool narrow = half < 1e-6;
  for (int d = 0; d < Dim; ++d) {
    const double s = (x[d] - mesh.grid->origin[d]) / mesh.grid->spacing[d];
    narrow = narrow || std::abs(s - std::round(s)) < 1e-6;
  }
  return narrow;
}

template <int Dim>
void expect_definitions(const Mesh<Dim>& mesh) {
  for_points(mesh, 20, [&]<class Basis>(Basis, const auto& cell, int e, const auto& point, double half) {
    std::array<double, Basis::nodes> N;
    std::array<Vec<Dim>, Basis::nodes> B;
    cell.gradients(place_in<Basis, double>(cell, point.x, half, point.xi), N, B);
    const auto exact = test::functions_of_all_nodes<Dim>(mesh, e, point.x, half);
    // Local nodes may stand for a node twice (GIMP beside a side), and nodes that are not local must have nothing.
    test::AtNodes<Dim> sums;
    sums.N.resize(mesh.node_count());
    sums.B.resize(mesh.node_count());
    for (int i = 0; i < Basis::nodes; ++i) {
      const int n = mesh.element_nodes(e)[i];
      sums.N[n] += N[i];
      for (int j = 0; j < Dim; ++j) sums.B[n][j] += B[i][j];
    }
    const double band = is_narrow<Basis, Dim>(mesh, point.x, half) ? narrow_slope_band : slope_band;
    for (int n = 0; n < mesh.node_count(); ++n) {
      EXPECT_NEAR(sums.N[n], exact.N[n], value_band);
      for (int j = 0; j < Dim; ++j) EXPECT_NEAR(sums.B[n][j], exact.B[n][j], band);
    }
  });
}

// Oracles: Cox and de Boor's recursion, averages of hats (grid_oracles.hpp).
TEST(Basis, OfGridsIsWhatItIsDefinedAs) {
  for (const auto functions : {GridFunctions::linear, GridFunctions::gimp, GridFunctions::b_spline}) {
    for (const auto& mesh : grids<2>(functions)) expect_definitions(mesh);
    for (const auto& mesh : grids<3>(functions)) expect_definitions(mesh);
  }
}

template <int Dim>
void expect_differences(const Mesh<Dim>& mesh) {
  for_points(mesh, 5, [&]<class Basis>(Basis, const auto& cell, int, const auto& point, double half) {
    if constexpr (!Basis::stores_local) {
      if (half > 0 && half < 1e-6) return;  // its functions bend within the step
      std::array<double, Basis::nodes> N;
      std::array<Vec<Dim>, Basis::nodes> B;
      cell.gradients(place_in<Basis, double>(cell, point.x, half, point.xi), N, B);
      constexpr double step = 1e-6;
      for (int j = 0; j < Dim; ++j) {
        std::array<double, Basis::nodes> ahead, behind;
        auto x = point.x;
        x[j] += step;
        cell.shape(place_in<Basis, double>(cell, x, half, {}), ahead);
        x[j] -= 2 * step;
        cell.shape(place_in<Basis, double>(cell, x, half, {}), behind);
        // Central differences: exact for quadratics but for round-off 1e-16/step, and for half a bend of the slope,
        // 1/h² times the step, where a piece of GIMP ends within it.
        for (int i = 0; i < Basis::nodes; ++i) EXPECT_NEAR((ahead[i] - behind[i]) / (2 * step), B[i][j], 1e-3);
      }
    }
  });
}

// Oracle: finite differences of the values.
TEST(Basis, GradientsAreTheSlopesOfTheValues) {
  for (const auto functions : {GridFunctions::linear, GridFunctions::gimp, GridFunctions::b_spline}) {
    for (const auto& mesh : grids<2>(functions)) expect_differences(mesh);
    for (const auto& mesh : grids<3>(functions)) expect_differences(mesh);
  }
  expect_differences(test::irregular(3, 0.2, test::Kind::triangles));
  expect_differences(test::irregular(2, 0.1, test::Solid::tetrahedra));
}

/// Three Gauss points along each axis of a cell: exact for what is of degree five along each.
template <int Dim, class F>
void for_gauss_points(const Grid<Dim>& grid, int e, F&& f) {
  const double place[3] = {-std::sqrt(0.6), 0, std::sqrt(0.6)}, weight[3] = {5.0 / 18, 8.0 / 18, 5.0 / 18};
  const auto at = grid.cell(e);
  for (int q = 0; q < (Dim == 2 ? 9 : 27); ++q) {
    const int k[3] = {q % 3, q / 3 % 3, q / 9};
    Vec<Dim> x;
    double w = 1;
    for (int d = 0; d < Dim; ++d) {
      x[d] = grid.origin[d] + (at[d] + 0.5 + 0.5 * place[k[d]]) * grid.spacing[d];
      w *= weight[k[d]] * grid.spacing[d];
    }
    f(x, w);
  }
}

template <int Dim>
void expect_integrals(const Mesh<Dim>& mesh) {
  for (int only = 0; only < mesh.element_count(); ++only) {
    with_basis<Dim>(mesh, &only, 0, 1, [&]<class Basis>(Basis, int, int e) {
      if constexpr (Basis::corrects && !Basis::stores_local) {
        const typename Basis::Cell cell(mesh, e);
        double V, V_sum = 0;
        std::array<Vec<Dim>, Basis::nodes> g, sum{};
        std::array<double, Basis::nodes> h{}, hoop_sum{};
        if constexpr (is_axisymmetric<Basis>) {
          cell.integrals(V, g, h);
        } else {
          cell.integrals(V, g);
        }
        for_gauss_points(*mesh.grid, e, [&](const Vec<Dim>& x, double area) {
          std::array<double, Basis::nodes> N;
          std::array<Vec<Dim>, Basis::nodes> B;
          cell.gradients(cell.local(x), N, B);
          const double w = mesh.axisymmetric ? area * x[0] : area;
          V_sum += w;
          for (int i = 0; i < Basis::nodes; ++i) {
            for (int j = 0; j < Dim; ++j) sum[i][j] += w * B[i][j];
            hoop_sum[i] += is_axisymmetric<Basis> ? area * N[i] : 0.0;
          }
        });
        EXPECT_NEAR(V, V_sum, value_band * std::max(1.0, V));
        for (int i = 0; i < Basis::nodes; ++i) {
          for (int j = 0; j < Dim; ++j) EXPECT_NEAR(g[i][j], sum[i][j], value_band * std::max(1.0, V));
          EXPECT_NEAR(h[i], hoop_sum[i], value_band);
        }
      }
    });
  }
}

// Oracle: Gauss quadrature of the gradients, exact for these functions.
TEST(Basis, IntegratesItsGradientsOverACell) {
  for (const auto functions : {GridFunctions::linear, GridFunctions::b_spline}) {
    for (const auto& mesh : grids<2>(functions)) expect_integrals(mesh);
    for (const auto& mesh : grids<3>(functions)) expect_integrals(mesh);
  }
}

// The same with r dA for the volume, and ∫ N_i dA for the circumference.
TEST(Basis, IntegratesOverACellOfABodyOfRevolution) {
  for (const auto functions : {GridFunctions::linear, GridFunctions::b_spline}) {
    for (auto mesh : grids<2>(functions)) {
      mesh.axisymmetric = true;
      expect_integrals(mesh);
    }
  }
}

template <int Dim>
void expect_lanes(const Mesh<Dim>& mesh) {
  using T = PointBatch<Dim>;
  for_points(mesh, 3, [&]<class Basis>(Basis, const auto& cell, int, const auto& point, double half) {
    std::array<double, Basis::nodes> N;
    std::array<Vec<Dim>, Basis::nodes> B;
    cell.gradients(place_in<Basis, double>(cell, point.x, half, point.xi), N, B);
    const double band = is_narrow<Basis, Dim>(mesh, point.x, half) ? narrow_slope_band : slope_band;
    // The point in the last lane, others beside it.
    std::array<T, Dim> x, xi;
    for (int d = 0; d < Dim; ++d) {
      double lanes[lanes_of<T>], local[lanes_of<T>];
      for (int l = 0; l < lanes_of<T>; ++l) {
        lanes[l] = point.x[d] - 0.01 * (lanes_of<T> - 1 - l);
        local[l] = point.xi[d] - 0.01 * (lanes_of<T> - 1 - l);
      }
      x[d] = T::load_unaligned(lanes);
      xi[d] = T::load_unaligned(local);
    }
    std::array<T, Basis::nodes> N_lanes;
    std::array<std::array<T, Dim>, Basis::nodes> B_lanes;
    cell.gradients(place_in<Basis, T>(cell, x, half, xi), N_lanes, B_lanes);
    for (int i = 0; i < Basis::nodes; ++i) {
      EXPECT_NEAR(N_lanes[i].get(lanes_of<T> - 1), N[i], value_band);
      for (int j = 0; j < Dim; ++j) EXPECT_NEAR(B_lanes[i][j].get(lanes_of<T> - 1), B[i][j], band);
    }
  });
}

// Oracle: the same on double; a fused product may round otherwise.
TEST(Basis, IsTheSameInALaneOfABatch) {
  for (const auto& mesh : all_meshes<2>()) expect_lanes(mesh);
  for (const auto& mesh : all_meshes<3>()) expect_lanes(mesh);
}

// Lanes without a point are zeros; what they give is multiplied by no mass and must be a number.
TEST(Basis, GivesNumbersFarFromTheCell) {
  for (const auto functions : {GridFunctions::gimp, GridFunctions::b_spline}) {
    const Mesh<2> mesh = make_grid({1e5, -1e5}, {40, 40}, {10, 10}, functions);
    const int e = 57;
    with_basis<2>(mesh, &e, 0, 1, [&]<class Basis>(Basis, int, int) {
      const typename Basis::Cell cell(mesh, e);
      std::array<double, Basis::nodes> N;
      std::array<Vec<2>, Basis::nodes> B;
      cell.gradients(place_in<Basis, double>(cell, Vec<2>{}, 0, Vec<2>{}), N, B);
      for (int i = 0; i < Basis::nodes; ++i) EXPECT_TRUE(std::isfinite(N[i] + B[i][0] + B[i][1]));
    });
  }
}

// What conditions rely on: the functions of a side's own nodes alone are not zero there, and sum to one.
TEST(Basis, OfAGridIsHeldAtASideByTheNodesOfThatSide) {
  for (const auto functions : {GridFunctions::linear, GridFunctions::gimp, GridFunctions::b_spline}) {
    for (const auto& mesh : grids<2>(functions)) {
      const auto& grid = *mesh.grid;
      const Vec<2> high{grid.origin[0] + grid.elements[0] * grid.spacing[0],
                        grid.origin[1] + grid.elements[1] * grid.spacing[1]};
      const auto held = [&](const char* side, const Vec<2>& x, int e) {
        const auto exact = test::functions_of_all_nodes<2>(mesh, e, x, 0.3 * grid.spacing[0]);
        double sum = 0;
        for (const int n : mesh.node_sets.at(side)) sum += exact.N[n];
        EXPECT_NEAR(sum, 1, value_band) << side;
      };
      held("left", {grid.origin[0], grid.origin[1] + 0.3 * grid.spacing[1]}, 0);
      held("bottom", {grid.origin[0] + 0.7 * grid.spacing[0], grid.origin[1]}, 0);
      held("right", {high[0], high[1] - 0.1 * grid.spacing[1]}, mesh.element_count() - 1);
      held("top", {high[0] - 0.9 * grid.spacing[0], high[1]}, mesh.element_count() - 1);
    }
  }
}

}  // namespace
}  // namespace scarp
