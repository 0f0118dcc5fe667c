// Nodes to points with a point in each lane, against the general form of the same (transfer/general.hpp) for every
// basis and 1 to 9 points; strain and spin against plain 3 × 3 matrices (tests/step/twin_strain.hpp). Band: 1e-13 of
// the largest number of a kind, some hundred roundings.
#include "scarp/transfer/nodes_to_points.hpp"

#include <gtest/gtest.h>

#include <array>
#include <optional>

#include "../../step/twin_strain.hpp"
#include "elements.hpp"
#include "scarp/transfer/general.hpp"
#include "scarp/transfer/points_to_nodes.hpp"

namespace scarp::test {
namespace {

constexpr double rounding = 1e-13;

/// Σ N_i u_i and Σ u_i B_i of a field of Dim components.
template <int Dim>
void expect_fields() {
  for_every_basis<Dim>([]<class Basis>(Basis, const auto& cell, const auto&, const auto& points, const auto& which) {
    using T = PointBatch<Dim>;
    const auto u = random_rows<Basis, Dim>(1, 5);
    transfer::NodeRows<Basis> rows;
    std::array<Vec<Dim>, Basis::nodes> nodes;
    for (int i = 0; i < Basis::nodes; ++i) {
      rows[i] = u[i].data();
      for (int j = 0; j < Dim; ++j) nodes[i][j] = u[i][j];
    }
    const transfer::Field<Basis, Dim, transfer::Rows::just> field(cell, rows);
    Deviation value, slope;
    const PointRange range{which.data(), static_cast<int>(which.size())};
    for_each_batch_of_element<T>(range, [&](const auto& p, int) {
      const auto local = transfer::local_coordinates<Basis>(cell, points, p);
      const auto here = field.at(local);
      for (int l = 0; l < p.count(); ++l) {
        const auto lane = static_cast<std::size_t>(l);
        const auto at = transfer::general::shapes_at<Basis>(cell, points, p.point(l));
        const auto u_p = transfer::general::value<Basis>(at, nodes);
        for (int j = 0; j < Dim; ++j) {
          value.add(here.value(j).get(lane), u_p[j]);
          repeat<Dim>([&](auto d) {
            double sum = 0;
            for (int i = 0; i < Basis::nodes; ++i) sum += u[i][j] * at.B[i][d];
            slope.add(here.template derivative<d>(j).get(lane), sum);
          });
        }
      }
    });
    EXPECT_LT(value.relative(), rounding);
    EXPECT_LT(slope.relative(), rounding);
  });
}
TEST(FieldsInLanes, AreSumsOverTheNodes) {
  expect_fields<2>();
  expect_fields<3>();
}

/// An element's quadrature as the step keeps it for its points.
template <class Basis>
struct Kept {
  std::array<double, Basis::dim * transfer::nodal_size<Basis> + 8> correction{};
  std::array<double, transfer::nodal_size<Basis>> hoop{};
  double weight = 1;
};

template <class Basis, class Which>
Kept<Basis> kept_of(const typename Basis::Cell& cell, const Points<Basis::dim>& points, const Which& which) {
  Kept<Basis> kept;
  if constexpr (Basis::corrects) {
    transfer::ElementSums<Basis> sums;
    transfer::points_to_nodes<Basis>(transfer::ShapesAtPoints<Basis>(cell), transfer::NoPlaces{}, points,
                                     {which.data(), static_cast<int>(which.size())}, std::false_type{}, sums);
    const auto q = transfer::full_element<Basis>(cell, transfer::Means<Basis>(cell), xsimd::hadd(sums.Omega),
                                                 sums.correction, transfer::totals<Basis>(sums.hoop));
    q.correction.store(kept.correction.data());
    if constexpr (is_axisymmetric<Basis>) transfer::store_nodal<Basis>(q.hoop_correction[0], kept.hoop.data());
    kept.weight = q.weight;
  }
  return kept;
}

/// What the points of an element should come to.
template <int Dim>
struct Expected {
  Deviation x, v, C, deps, spin, volume, volume_of_middle, per_mass, speed2;
};

struct How {
  bool corrected, averaged, middle;
};

template <bool pic, int Dim>
void expect_motion(const How& how) {
  for_every_basis<Dim>([&]<class Basis>(Basis, const auto& cell, const auto&, const auto& before, const auto& which) {
    constexpr int K = Basis::nodes;
    const bool has_means = how.averaged && !is_simplex<Basis>;  // theirs are of patches
    const auto c = random_rows<Basis, Dim>(0.3, 1), du = random_rows<Basis, Dim>(0.01, 2),
               change = random_rows<Basis, Dim>(0.3, 3);
    std::array<transfer::Motion<Dim>, K> motion;
    std::array<Vec<Dim>, K> c_i, du_i, a_dt_i;
    transfer::NodeRows<Basis> rows, a_dt;
    for (int i = 0; i < K; ++i) {
      for (int j = 0; j < Dim; ++j) {
        motion[i].dv(j) = c_i[i][j] = c[i][j];
        motion[i].du(j) = du_i[i][j] = du[i][j];
        a_dt_i[i][j] = change[i][j];
      }
      rows[i] = motion[i].row.data();
      a_dt[i] = change[i].data();
    }
    transfer::general::Quadrature<Basis> q;
    Kept<Basis> kept;
    if (how.corrected) {
      q = transfer::general::full_element<Basis>(cell, before, which, has_means);
      kept = kept_of<Basis>(cell, before, which);
    }
    transfer::ElementMotion<Basis> element{rows, kept.correction.data(), kept.weight, 0.15, kept.hoop.data()};
    element.least_per_mass = 0.2;
    for (int i = 0; i < K; ++i) {
      for (int j = 0; j < Dim; ++j) element.mean_dilation += du[i][j] * q.mean[i][j];
      element.mean_dilation += du[i][0] * q.mean_hoop[i];
    }
    const transfer::MotionRules rules{0.7, how.middle, pic, 0.01};
    auto points = before;
    PointIncrements<Dim> increments;
    increments.reserve(3 + static_cast<int>(which.size()));
    transfer::MotionSums<Dim> sums;
    transfer::with_means<Basis>(has_means, [&](auto averaged) {
      transfer::nodes_to_points<pic, Basis>(cell, element, a_dt, rules, points,
                                            {which.data(), static_cast<int>(which.size())}, increments, 3, averaged,
                                            sums, [](const auto&, const auto&, const auto&) {});
    });

    Expected<Dim> of;
    double mass = 0, kinetic = 0, taken = 0;
    for (std::size_t k = 0; k < which.size(); ++k) {
      const int p = which[k];
      const std::size_t at_p = 3 + k;
      const auto at = transfer::general::shapes_at<Basis>(cell, before, p);
      const auto v_change = transfer::general::value<Basis>(at, c_i), path = transfer::general::value<Basis>(at, du_i),
                 flip = transfer::general::value<Basis>(at, a_dt_i);
      const auto L = transfer::general::gradient<Basis>(cell, before, p, q, du_i);
      double v2 = 0;
      mass += before.mass[p];
      for (int j = 0; j < Dim; ++j) {
        const double v = 0.7 * before.v[j][p] + v_change[j], v_flip = before.v[j][p] + flip[j];
        v2 += v * v;
        taken += before.mass[p] * (v_flip * v_flip - v * v);
        of.v.add(points.v[j][p], v);
        of.x.add(points.x[j][p] - before.x[j][p], path[j]);
        for (int d = 0; d < Dim && pic; ++d) {
          double C = 0;
          for (int i = 0; i < K; ++i) C += du[i][j] / 0.01 * at.B[i][d];
          of.C.add(points.C[j * Dim + d][p], C);
        }
      }
      kinetic += before.mass[p] * v2;
      const Kinematics strain(L, how.middle);
      for (int j = 0; j < 3; ++j) {
        for (int l = j; l < 3; ++l) {
          if (transfer::mandel(j, l) >= sym_size<Dim>) continue;
          of.deps.add(increments.deps[transfer::mandel(j, l)][at_p], strain.strain[j][l] * (j == l ? 1 : sqrt2));
        }
      }
      const int pairs[3][2] = {{0, 1}, {1, 2}, {2, 0}};
      for (int s = 0; s < spin_size<Dim>; ++s)
        of.spin.add(increments.spin[s][at_p], strain.spin[pairs[s][0]][pairs[s][1]]);
      const double Omega = before.volume[p] * determinant(one_and(1, L));
      of.volume.add(points.volume[p], Omega);
      of.volume_of_middle.add(increments.volume[at_p], q.weight * Omega * (1 - 0.5 * (L[0][0] + L[1][1] + L[2][2])));
      const double per_mass = std::max(1.0, q.weight) * Omega / before.mass[p] / (0.15 * 0.15);
      of.per_mass.add(increments.per_mass[at_p], is_simplex<Basis> ? std::max(per_mass, 0.2) : per_mass);
      of.speed2.add(increments.speed2[at_p], v2 / (0.15 * 0.15));
    }
    for (const auto& [name, deviation] :
         {std::pair{"x", of.x}, std::pair{"v", of.v}, std::pair{"C", of.C}, std::pair{"deps", of.deps},
          std::pair{"spin", of.spin}, std::pair{"volume", of.volume}, std::pair{"middle", of.volume_of_middle},
          std::pair{"per_mass", of.per_mass}, std::pair{"speed2", of.speed2}})
      EXPECT_LT(deviation.relative(), rounding) << name;
    EXPECT_NEAR(xsimd::hadd(sums.mass), mass, rounding * mass);
    EXPECT_NEAR(xsimd::hadd(sums.kinetic_energy), kinetic, rounding * kinetic);
    if (pic) {
      EXPECT_NEAR(xsimd::hadd(sums.taken), taken, rounding * kinetic);
    }
  });
}
TEST(NodesToPoints, AreTheGeneralSumsAsPrinted) {
  expect_motion<false, 2>({false, false, false});
  expect_motion<false, 3>({false, false, false});
}
TEST(NodesToPoints, AreTheGeneralSumsWithPicAndAffinePoints) {
  expect_motion<true, 2>({true, false, false});
  expect_motion<true, 3>({true, false, false});
}
TEST(NodesToPoints, AreTheGeneralSumsInTheMiddleOfTheStep) {
  expect_motion<false, 2>({true, false, true});
  expect_motion<false, 3>({true, false, true});
}
TEST(NodesToPoints, AreTheGeneralSumsWithMeanDilatation) {
  expect_motion<false, 2>({true, true, true});
  expect_motion<false, 3>({true, true, true});
}

/// Σ du_i · B̄_i of an element, from its cell and from its Means; of GIMP from those that its points have stored.
template <int Dim>
void expect_dilation() {
  for_every_basis<Dim>([]<class Basis>(Basis, const auto& cell, const auto&, const auto& points, const auto& which) {
    const auto q = transfer::general::full_element<Basis>(cell, points, which, true);
    const auto w = random_rows<Basis, 2 * Dim>(1, 4);
    double general = 0;
    transfer::NodeRows<Basis> rows;
    for (int i = 0; i < Basis::nodes; ++i) {
      for (int j = 0; j < Dim; ++j) general += w[i][Dim + j] * q.mean[i][j];
      general += w[i][Dim] * q.mean_hoop[i];
      rows[i] = w[i].data();
    }
    if constexpr (transfer::keeps_means<Basis>) {
      std::array<double, transfer::Means<Basis>::size> kept;
      transfer::Means<Basis> means(cell);
      for (int j = 0; j < Dim; ++j) {
        for (int i = 0; i < Basis::nodes; ++i) kept[j * transfer::nodal_size<Basis> + i] = q.mean[i][j];
      }
      EXPECT_NEAR(transfer::Means<Basis>::dilation(kept.data(), rows, Dim), general, 1e-12);
    } else {
      EXPECT_NEAR(transfer::mean_dilation<Basis>(cell, rows), general, 1e-12);
      EXPECT_NEAR(transfer::mean_dilation<Basis>(transfer::Means<Basis>(cell), rows), general, 1e-12);
    }
  });
}
TEST(MeanDilatation, IsTheGeneralSum) {
  expect_dilation<2>();
  expect_dilation<3>();
}

}  // namespace
}  // namespace scarp::test
