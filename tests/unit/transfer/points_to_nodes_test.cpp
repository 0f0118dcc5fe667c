// Points to nodes with a node in each lane, against the general form of the same (transfer/general.hpp) for every basis
// and 1 to 9 points. Band: 1e-13 of the largest number of a kind, some hundred roundings.
#include "scarp/transfer/points_to_nodes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <optional>
#include <vector>

#include "elements.hpp"
#include "scarp/transfer/general.hpp"

namespace scarp::test {
namespace {

constexpr double rounding = 1e-13;

/// The number of local node i, of the g-th of the points that have theirs in these batches.
template <class Basis>
double lane(const transfer::WideNodal<Basis>& x, int i, int g = 0) {
  constexpr int W = lanes_of<transfer::Lane<Basis>>;
  return x[i / W].get(static_cast<std::size_t>(g * W + i % W));
}
/// N_i and B_i of each point.
template <int Dim>
void expect_shapes() {
  for_every_basis<Dim>([]<class Basis>(Basis, const auto& cell, const auto&, const auto& points, const auto& which) {
    Deviation N, B;
    const transfer::ShapesAtPoints<Basis> shapes(cell);
    const PointRange range{which.data(), static_cast<int>(which.size())};
    for_each_batch_of_element<PointBatch<Dim>>(range, [&](const auto& p, int) {
      shapes.with(points, p, [&](const auto& at) {
        transfer::for_each_group<Basis>(p, [&](int l) {
          const transfer::Shapes<Basis> here = at(l);
          for (int g = 0; g < transfer::points_at_once<Basis> && l + g < p.count(); ++g) {
            const auto general = transfer::general::shapes_at<Basis>(cell, points, p.point(l + g));
            for (int i = 0; i < Basis::nodes; ++i) {
              N.add(lane<Basis>(here.N, i, g), general.N[i]);
              for (int d = 0; d < Dim; ++d) B.add(lane<Basis>(here.B[d], i, g), general.B[i][d]);
            }
          }
        });
      });
    });
    EXPECT_LT(N.relative(), rounding);
    EXPECT_LT(B.relative(), rounding);
  });
}
TEST(ShapesInLanes, AreTheBasis) {
  expect_shapes<2>();
  expect_shapes<3>();
}

/// What the step makes of an element's sums: its quadrature, as that of an element full of soil, or eq. 4 as printed.
template <class Basis>
transfer::Quadrature<Basis> quadrature_of(const typename Basis::Cell& cell, const transfer::ElementSums<Basis>& sums,
                                          std::optional<transfer::Means<Basis>>& means, bool averaged) {
  transfer::Quadrature<Basis> q;
  if constexpr (Basis::corrects) {
    q = transfer::full_element<Basis>(cell, *means, xsimd::hadd(sums.Omega), sums.correction,
                                      transfer::totals<Basis>(sums.hoop));
  }
  if (!averaged || is_simplex<Basis>) return q;
  if constexpr (transfer::keeps_means<Basis>) {
    means->gradient = transfer::totals<Basis>(sums.Omega_B);
    for (auto& component : means->gradient) {
      for (auto& batch : component) batch *= transfer::Lane<Basis>(1 / xsimd::hadd(sums.Omega_share));
    }
  }
  q.means = &*means;
  return q;
}

/// Eqs 1, 2, 4 and M_ij, of points with C_p where `affine`.
template <int Dim>
void expect_sums(bool corrected, bool averaged, bool affine) {
  for_every_basis<Dim>([&]<class Basis>(Basis, const auto& cell, const auto& of, const auto& points,
                                        const auto& which) {
    constexpr int K = Basis::nodes;
    const PointRange range{which.data(), static_cast<int>(which.size())};
    transfer::ElementSums<Basis> sums;
    const transfer::ShapesAtPoints<Basis> shapes(cell);
    transfer::with_means<Basis>(averaged, [&](auto apart) {
      if (affine) {
        transfer::points_to_nodes<Basis>(shapes, transfer::NodePlaces<Basis>(of.mesh, of.element), points, range, apart,
                                         sums);
      } else {
        transfer::points_to_nodes<Basis>(shapes, transfer::NoPlaces{}, points, range, apart, sums);
      }
    });
    std::optional<transfer::Means<Basis>> means;
    transfer::general::Quadrature<Basis> general;
    transfer::Quadrature<Basis> q;
    if (corrected) {
      means.emplace(cell);
      q = quadrature_of<Basis>(cell, sums, means, averaged);
      general = transfer::general::full_element<Basis>(cell, points, which, averaged);
      if (is_simplex<Basis>) {  // mean stress goes to the patch of the element
        general.mean = {};
        general.mean_hoop = {};
      }
    }
    std::array<Vec<Dim>, K> places;
    for (int i = 0; i < K; ++i) places[i] = of.mesh.node(of.mesh.element_nodes(of.element)[i]);
    transfer::general::NodeSums<Basis> nodes;
    double Omega = 0, m_v2 = 0;
    for (const int p : which) {
      transfer::general::add_point<Basis>(cell, points, p, general, points.sigma, nodes, affine ? &places : nullptr);
      Omega += points.volume[p];
      for (int j = 0; j < Dim; ++j) m_v2 += points.mass[p] * points.v[j][p] * points.v[j][p];
    }

    std::array<int, K> place;
    for (int i = 0; i < K; ++i) place[i] = i;
    std::array<std::array<double, transfer::node_sums<Dim>>, K> fast{};
    transfer::add_to_nodes<Basis>(sums, transfer::internal_force<Basis>(sums, q), place.data(), fast[0].data());
    Deviation m, p, F, M;
    for (int i = 0; i < K; ++i) {
      m.add(fast[i][0], nodes.m[i]);
      for (int j = 0; j < Dim; ++j) {
        p.add(fast[i][1 + j], nodes.p[i][j]);
        F.add(fast[i][1 + Dim + j], nodes.F[i][j]);
      }
    }
    if constexpr (transfer::keeps_mass_matrix<Basis>) {
      std::array<double, transfer::mass_matrix_size(K, transfer::nodal_size<Basis>)> kept;
      transfer::store_mass_matrix<Basis>(sums.M, kept.data());
      for (int i = 0; i < K; ++i) {
        for (int j = 0; j < K; ++j) M.add(kept[transfer::mass_matrix_place<Basis>(i, j)], nodes.M[i][j]);
      }
    }
    EXPECT_LT(m.relative(), rounding);
    EXPECT_LT(p.relative(), rounding);
    EXPECT_LT(F.relative(), rounding);
    EXPECT_LT(M.relative(), rounding);
    EXPECT_NEAR(xsimd::hadd(sums.Omega), Omega, rounding * Omega);
    EXPECT_NEAR(xsimd::hadd(sums.m_v2), m_v2, rounding * m_v2);
  });
}
TEST(PointsToNodes, AreTheGeneralSumsAsPrinted) {
  expect_sums<2>(false, false, false);
  expect_sums<3>(false, false, false);
}
TEST(PointsToNodes, AreTheGeneralSumsOfFullElements) {
  expect_sums<2>(true, false, false);
  expect_sums<3>(true, false, false);
}
TEST(PointsToNodes, AreTheGeneralSumsWithMeanStress) {
  expect_sums<2>(true, true, false);
  expect_sums<3>(true, true, false);
}
TEST(PointsToNodes, AreTheGeneralSumsOfAffinePoints) {
  expect_sums<2>(false, false, true);
  expect_sums<3>(false, false, true);
}

/// Σ_j M_ij w_j: of n components of kept M_ij, of all side by side, and through the points.
template <int Dim>
void expect_products() {
  for_every_basis<Dim>([]<class Basis>(Basis, const auto& cell, const auto&, const auto& points, const auto& which) {
    constexpr int K = Basis::nodes, n = 2 * Dim, size = transfer::accumulator_size<n>;
    const PointRange range{which.data(), static_cast<int>(which.size())};
    transfer::general::NodeSums<Basis> nodes;
    for (const int p : which) transfer::general::add_point<Basis>(cell, points, p, {}, points.sigma, nodes);
    const auto w = random_rows<Basis, n>(1, 3);
    std::array<std::array<double, n>, K> general{};
    for (int i = 0; i < K; ++i) {
      for (int j = 0; j < K; ++j) {
        for (int c = 0; c < n; ++c) general[i][c] += nodes.M[i][j] * w[j][c];
      }
    }
    transfer::NodeRows<Basis> rows;
    std::array<int, K> place;
    std::array<transfer::Motion<Dim>, K> motion;
    for (int i = 0; i < K; ++i) {
      std::copy_n(w[i].begin(), n, motion[i].row.begin());
      rows[i] = motion[i].row.data();
      place[i] = K - 1 - i;  // not in the order of the nodes
    }
    const auto expect = [&](const std::vector<double>& sums, int each, int first, int count, const char* how) {
      Deviation M_w;
      for (int i = 0; i < K; ++i) {
        for (int c = 0; c < count; ++c) M_w.add(sums[(K - 1 - i) * each + first + c], general[i][c]);
      }
      EXPECT_LT(M_w.relative(), rounding) << how;
    };
    std::vector<double> sums(K * size);
    transfer::add_momentum<Basis, n, size, 0>(cell, points, range, rows, place.data(), sums.data());
    expect(sums, size, 0, n, "through the points");
    sums.assign(K * size, 0);
    transfer::add_momentum<Basis, Dim, size, n - Dim>(cell, points, range, rows, place.data(), sums.data());
    expect(sums, size, n - Dim, Dim, "through the points, in part");
    if constexpr (transfer::keeps_mass_matrix<Basis>) {
      transfer::ElementSums<Basis> of_element;
      transfer::points_to_nodes<Basis>(transfer::ShapesAtPoints<Basis>(cell), transfer::NoPlaces{}, points, range,
                                       std::false_type{}, of_element);
      std::array<double, transfer::mass_matrix_size(K, transfer::nodal_size<Basis>)> kept;
      transfer::store_mass_matrix<Basis>(of_element.M, kept.data());
      sums.assign(K * size, 0);
      transfer::add_products<Basis>(kept.data(), rows, place.data(), sums.data());
      expect(sums, size, 0, n, "side by side");
      sums.assign(K * size, 0);
      transfer::add_momentum<Basis, Dim>(kept.data(), rows, place.data(), sums.data());
      expect(sums, transfer::accumulator_size<Dim>, 0, Dim, "component by component");
    }
  });
}
TEST(MassMatrix, ProductsAreTheGeneralSums) {
  expect_products<2>();
  expect_products<3>();
}

}  // namespace
}  // namespace scarp::test
