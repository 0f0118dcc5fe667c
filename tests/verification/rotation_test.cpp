// A body that turns rigidly, with every shape function of a grid: what the increments of a step make of it.
//
// Nodes turn rigidly, so that the field of the points is linear, and every basis has its exact gradient (S1 in
// docs/theory.md). There are two increments to choose from:
//   - on tangents, du = W x with W skew, as the velocities of a rigid motion make it: no strain (eq. 10), but |x| grows
//     by √(1 + w²) in each step, w the turn of W, and volumes with det(I + W) = 1 + w²;
//   - on chords, du = (Q − I) x, Q the turn by θ: positions and volumes are exact, but eq. 10 takes
//     sym(Q − I) = −(1 − cos θ)(I − k⊗k) for a strain, k the axis.
// Either error is ½θ² in a step, and ½θ times the angle in all: of first order in the time step.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "method.hpp"
#include "scarp/mesh/with_basis.hpp"
#include "scarp/transfer/nodes_to_points.hpp"
#include "unit/tensor/matrix.hpp"

namespace scarp::verification {
namespace {

using test::Matrix;
using test::operator*;

constexpr Solid solid{100, 0.25, 2};

/// Of the axis k: the plane's normal, or one that lies along no face of an element.
template <int Dim>
constexpr Vec<3> axis() {
  return Dim == 2 ? Vec<3>{0, 0, 1} : Vec<3>{1.0 / 3, 2.0 / 3, 2.0 / 3};
}

/// α I + β (k ×) + γ (I − k⊗k)
template <int Dim>
Matrix around_axis(double alpha, double beta, double gamma) {
  const auto k = axis<Dim>();
  const Matrix cross{{{0, -k[2], k[1]}, {k[2], 0, -k[0]}, {-k[1], k[0], 0}}};
  Matrix m;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3; ++j)
      m[i][j] = alpha * (i == j) + beta * cross[i][j] + gamma * ((i == j) - k[i] * k[j]);
  }
  return m;
}

/// Q of a turn by `angle`, by Rodrigues' formula.
template <int Dim>
Matrix turn(double angle) {
  return around_axis<Dim>(1, std::sin(angle), std::cos(angle) - 1);
}

/// The components of m x that x has.
template <class Vector>
Vector product(const Matrix& m, const Vector& x) {
  Vector y{};
  for (std::size_t i = 0; i < x.size(); ++i) {
    for (std::size_t j = 0; j < x.size(); ++j) y[i] += m[i][j] * x[j];
  }
  return y;
}

/// Stress of the soil at the start; none of its directions is the axis.
template <int Dim>
Sym<double, sym_size<Dim>> stress_at_start() {
  const Sym<double, 6> sigma{{-3, -5, -4, 1, 0.5, -0.7}};
  return test::from_matrix<sym_size<Dim>>(test::to_matrix(sigma));
}

constexpr double spacing = 0.16;
template <int Dim>
constexpr std::array counts{7, 5, Dim == 2 ? 1 : 3};

/// Where point `id` starts.
template <int Dim>
Vec<Dim> place_of(int id) {
  constexpr int nx = counts<Dim>[0], ny = counts<Dim>[1];
  const std::array at{id % nx, id / nx % ny, id / (nx * ny)};
  Vec<Dim> x;
  for (int j = 0; j < Dim; ++j) x[j] = spacing * at[j] - 0.45;
  return x;
}

/// A block off the middle of a grid of [−1, 1]^Dim in eight elements along each axis, whose points do not keep step
/// with these; it may turn about the origin and stays inside.
template <int Dim>
Body<Dim> stressed_block(GridFunctions shape) {
  Vec<Dim> low, size, gravity{};
  std::array<int, Dim> elements;
  low.fill(-1);
  size.fill(2);
  elements.fill(8);
  Body<Dim> body(std::make_unique<const Mesh<Dim>>(make_grid<Dim>(low, size, elements, shape)), gravity);
  Block<Dim> block("soil", linear_elastic(solid.E, solid.nu));
  resize(block, counts<Dim>[0] * counts<Dim>[1] * counts<Dim>[2]);
  auto& points = block.points;
  for (int p = 0; p < block.size(); ++p) {
    for (int j = 0; j < Dim; ++j) points.x[j][p] = place_of<Dim>(p)[j];
    points.volume[p] = points.initial_volume[p] = std::pow(spacing, Dim);
    points.mass[p] = solid.rho * points.volume[p];
    points.id[p] = p;
    for (int c = 0; c < sym_size<Dim>; ++c) points.sigma[c][p] = stress_at_start<Dim>()[c];
  }
  body.fields[0].blocks.push_back(std::move(block));
  locate_points(body);
  return body;
}

/// Steps 6 to 11 with nodes that move by du = m x: the same for all points, wherever they are.
template <int Dim>
void move_with_nodes(Body<Dim>& body, const Matrix& m) {
  auto& block = body.blocks()[0];
  PointIncrements<Dim> increments;
  increments.reserve(block.size());
  transfer::MotionSums<Dim> sums;
  with_basis(*body.mesh, body.fields[0].active.element.data(), 0, body.fields[0].active.size(),
             [&]<class Basis>(Basis, int slot, int e) {
               constexpr double no_correction[Dim * transfer::nodal_size<Basis>] = {};
               const auto nodes = body.mesh->element_nodes(e);
               std::array<transfer::Motion<Dim>, Basis::nodes> motion;
               transfer::ElementMotion<Basis> element{{}, no_correction, 1, body.mesh->size_of(e), no_correction};
               for (int i = 0; i < Basis::nodes; ++i) {
                 const auto du = product(m, body.mesh->node(nodes[i]));
                 for (int j = 0; j < Dim; ++j) motion[i].du(j) = du[j];
                 element.motion[i] = motion[i].row.data();
               }
               transfer::nodes_to_points<false, Basis>(
                   typename Basis::Cell(*body.mesh, e), element, {}, {}, block.points,
                   {block.order.data() + block.begin[slot], block.begin[slot + 1] - block.begin[slot]}, increments,
                   block.begin[slot], std::false_type{}, sums, [](const auto&...) {});
             });
  exec::StressTotals totals;
  exec::update_stresses(block, {block.order.data(), block.size()}, increments, 0, 1.0, {}, totals);
  locate_points(body);
}

/// Positions x = m X, one stress, and volumes that have grown by a factor.
template <int Dim>
void expect_state(const Body<Dim>& body, const Matrix& m, const Matrix& sigma, double growth) {
  const auto& points = body.blocks()[0].points;
  const auto components = test::from_matrix<sym_size<Dim>>(sigma);
  for (int p = 0; p < points.size(); ++p) {
    const auto x = product(m, place_of<Dim>(points.id[p]));
    // Round-off of some ten sums of order one in each of some hundred steps, of a stress of some ten.
    for (int j = 0; j < Dim; ++j) ASSERT_NEAR(points.x[j][p], x[j], 1e-12);
    for (int c = 0; c < sym_size<Dim>; ++c) ASSERT_NEAR(points.sigma[c][p], components[c], 1e-10);
    ASSERT_NEAR(points.volume[p] / points.initial_volume[p], growth, 1e-12);
  }
}

constexpr int steps_of_a_turn = 300;
constexpr double theta = 2 * std::numbers::pi / steps_of_a_turn;

/// Moves a block by m for two turns; expect(body, n, σ turned n times by `turn_of_stress`) now and then.
template <int Dim, class F>
void follow(GridFunctions shape, const Matrix& m, double turn_of_stress, F&& expect) {
  auto body = stressed_block<Dim>(shape);
  for (int n = 1; n <= 2 * steps_of_a_turn; ++n) {
    move_with_nodes(body, m);
    if (n % 40 != 0) continue;
    SCOPED_TRACE(testing::Message() << Dim << " dimensions, step " << n);
    const auto Q = turn<Dim>(n * turn_of_stress);
    expect(body, n, Q * test::to_matrix(stress_at_start<Dim>()) * test::transposed(Q));
  }
}

template <int Dim>
void expect_tangents_without_strain(GridFunctions shape) {
  const double w = 2 * std::tan(theta / 2);  // of which the formula of Hughes and Winget makes a turn by θ
  follow<Dim>(shape, around_axis<Dim>(0, w, 0), theta, [&](const auto& body, int n, const Matrix& sigma) {
    const double growth = std::pow(1 + w * w, n), r = std::sqrt(growth), angle = n * std::atan(w);
    expect_state(body, around_axis<Dim>(1, r * std::sin(angle), r * std::cos(angle) - 1), sigma, growth);
  });
}

template <int Dim>
void expect_chords_without_growth(GridFunctions shape) {
  const double strain = 1 - std::cos(theta);
  const auto chord = around_axis<Dim>(0, std::sin(theta), std::cos(theta) - 1);
  follow<Dim>(shape, chord, 2 * std::atan(std::sin(theta) / 2), [&](const auto& body, int n, Matrix sigma) {
    const auto added = around_axis<Dim>(-2 * solid.lambda() * n * strain, 0, -2 * solid.mu() * n * strain);
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t j = 0; j < 3; ++j) sigma[i][j] += added[i][j];
    }
    expect_state(body, turn<Dim>(n * theta), sigma, 1);
  });
}

class Turning : public testing::TestWithParam<GridFunctions> {};

TEST_P(Turning, NodesOnTangentsTurnStressWithoutStrain) {
  expect_tangents_without_strain<2>(GetParam());
  expect_tangents_without_strain<3>(GetParam());
}

TEST_P(Turning, NodesOnChordsKeepVolumeAndAddTheKnownStrain) {
  expect_chords_without_growth<2>(GetParam());
  expect_chords_without_growth<3>(GetParam());
}

INSTANTIATE_TEST_SUITE_P(Shapes, Turning, testing::ValuesIn(all_shapes), label_of);

}  // namespace
}  // namespace scarp::verification
