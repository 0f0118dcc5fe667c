// The trial of a step (step/trial.hpp) against the step that writes over its points: the same bits of stress, state and
// volume, as often as it is asked for, and nothing else of the body changes before it is committed. The fused step has
// the twin as its oracle (twin_test.cpp).
#include "scarp/step/trial.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cstdint>

#include "scarp/exec/parallel.hpp"
#include "scarp/step/patches.hpp"
#include "scarp/step/phases.hpp"
#include "soils.hpp"

namespace scarp::test {
namespace {

using Bits = std::vector<std::uint64_t>;

template <class Array>
void add(Bits& all, const Array& column) {
  for (const auto value : column) {
    if constexpr (sizeof(value) == 8) {
      all.push_back(std::bit_cast<std::uint64_t>(value));
    } else {
      all.push_back(static_cast<std::uint64_t>(value));
    }
  }
}

/// Everything that points have, and what their nodes have of the step.
template <int Dim>
Bits bits_of(Body<Dim>& body) {
  Bits all;
  for (auto& field : body.fields) {
    for (auto& block : field.blocks) {
      for_each_column(block, [&](const auto& column) { add(all, column); });
      add(all, block.order);
    }
    for (int k = 0; k < field.assembly.size(); ++k) {
      add(all, field.nodes.motion[k].row);
      add(all, field.nodes.a_dt[k]);
      all.push_back(std::bit_cast<std::uint64_t>(field.nodes.node[k].m));
    }
    const auto& buffers = field.buffers;
    for (const auto* column : {&buffers.weight, &buffers.correction, &buffers.sums}) add(all, *column);
    add(all, buffers.left);
  }
  return all;
}

/// What a trial has of points, of itself or as the points have it.
template <int Dim>
Bits bits_of(const exec::UpdatedColumns<Dim>& columns, const Column& volume) {
  Bits all;
  for (const auto& column : columns.sigma) add(all, column);
  for (const auto& column : columns.sigma_ahead) add(all, column);
  for (const auto& column : columns.state) add(all, column);
  add(all, columns.eps_q);
  add(all, volume);
  add(all, columns.flags);
  add(all, columns.substeps);
  return all;
}
template <int Dim>
Bits bits_of(BodyTrial<Dim>& trial) {
  Bits all;
  for (auto& field : trial.fields) {
    for (auto& block : field.blocks) {
      const auto more = bits_of<Dim>(exec::UpdatedColumns<Dim>(block), block.volume);
      all.insert(all.end(), more.begin(), more.end());
    }
  }
  return all;
}
template <int Dim>
Bits updated_bits_of(Body<Dim>& body) {
  Bits all;
  for (auto& block : body.blocks()) {
    const auto more = bits_of<Dim>(exec::UpdatedColumns<Dim>(block), block.points.volume);
    all.insert(all.end(), more.begin(), more.end());
  }
  return all;
}

/// A step as step.cpp makes it, to where its nodes have their displacements.
template <int Dim>
void displace_nodes(Body<Dim>& body, double dt, const StepSettings& settings) {
  const Scheme& scheme = settings.scheme;
  for (auto& field : body.fields) {
    prepare_threads(field);
    std::fill(field.buffers.totals.begin(), field.buffers.totals.end(), BodyTotals<Dim>());
    step::map_points_to_elements(body, field, settings);
    step::accelerate_nodes(body, field, dt, settings);
    if (scheme.two_terms) {
      step::sum_with_mass_matrix<2 * Dim>(body, field, 0);
      step::filter_changes(field, dt, settings);
      step::sum_with_mass_matrix<2 * Dim>(body, field, 0);
    } else {
      step::sum_with_mass_matrix<Dim>(body, field, 0);
    }
    step::velocities_of_nodes(body, field, dt, settings);
    if (scheme.filters_motion()) {
      step::sum_with_mass_matrix<2 * Dim>(body, field, Dim);
      step::filter_displacements(body, field, settings);
    }
  }
}

template <int Dim>
void scale_displacements(Body<Dim>& body, double factor) {
  for (auto& field : body.fields) {
    for (auto& motion : field.nodes.motion) {
      for (int j = 0; j < Dim; ++j) motion.du(j) *= factor;
    }
  }
}

/// What a case has met, for cases to demand that it did.
struct Met {
  int most_substeps = 0;
  std::int64_t separated = 0, massless_nodes = 0;
  bool means = false;
};

/// `steps` steps of `part` of the critical time step, and then one whose trial is compared with it.
template <int Dim>
Met expect_same_bits(Body<Dim> body, int steps, const StepSettings& settings, double part = 0.3) {
  const double dt = part * critical_time_step(body);
  for (int s = 0; s < steps; ++s) advance(body, dt, settings);
  displace_nodes(body, dt, settings);

  const Bits before = bits_of(body), had = updated_bits_of(body);
  BodyTrial<Dim> trial, other;
  form_trial(body, dt, settings, trial);
  const Bits first = bits_of(trial);
  EXPECT_TRUE(before == bits_of(body)) << "a trial has changed the body";
  EXPECT_FALSE(first == had);

  scale_displacements(body, 2);  // the powers of two are exact
  form_trial(body, dt, settings, trial);
  EXPECT_FALSE(first == bits_of(trial)) << "other displacements have another trial";
  scale_displacements(body, 0.5);
  exec::set_threads(3);
  form_trial(body, dt, settings, trial);
  exec::set_threads(1);
  EXPECT_TRUE(first == bits_of(trial)) << "a second trial of the same displacements is another";

  form_trial(body, dt, settings, other);
  commit(body, other);
  EXPECT_TRUE(first == updated_bits_of(body));
  commit(body, other);
  EXPECT_TRUE(before == bits_of(body)) << "a trial that is taken back";

  for (auto& field : body.fields) {
    if (step::uses_patches(body, settings)) step::find_dilations(body, field, settings);
    step::strain_stress_and_motion(body, field, dt, settings);
  }
  const auto totals = step::close_totals(body, dt, settings);
  EXPECT_TRUE(first == updated_bits_of(body)) << "the fused step has other bits";
  EXPECT_EQ(trial.stress.work, totals.stress.work);
  EXPECT_EQ(trial.stress.damping, totals.stress.damping);
  EXPECT_EQ(trial.stress.substeps, totals.stress.substeps);
  EXPECT_EQ(trial.stress.failures, totals.stress.failures);
  EXPECT_EQ(trial.stress.critical_dt, totals.stress.critical_dt);
  for (int j = 0; j < Dim; ++j) {
    EXPECT_TRUE(trial.fields[0].moved[0].points.x[j] == body.blocks()[0].points.x[j]);
    EXPECT_TRUE(trial.fields[0].moved[0].points.v[j] == body.blocks()[0].points.v[j]);
  }
  const auto& means = body.fields[0].buffers.mean_dilatation;
  return {trial.stress.most_substeps, trial.stress.separated, totals.massless_nodes,
          std::count(means.begin(), means.end(), 1) > 0};
}

StepSettings standard() {
  StepSettings s{.scheme = two_term_scheme(0.03), .integration = {1e-4, 1e-5}};
  s.scheme.damping.share = 0.2;
  return s;
}
StepSettings report() {
  return {.scheme = report_scheme(0.98), .damping = 0.1, .integration = {1e-4, 1e-5}};
}
StepSettings apic() {
  return {.scheme = apic_scheme(), .integration = {1e-4, 1e-5}};
}

class TrialInThePlane : public testing::TestWithParam<Background> {};
class TrialInSpace : public testing::TestWithParam<Background> {};

TEST_P(TrialInThePlane, OfTheStandardStep) {
  const auto met = expect_same_bits(soil<2>(plane_mesh(GetParam(), 12), subloading(), 20, 1.0), 20, standard());
  EXPECT_TRUE(met.means) << "no mean dilatation";
}
TEST_P(TrialInThePlane, OfTheReportsStep) {
  expect_same_bits(soil<2>(plane_mesh(GetParam(), 12), subloading(), 20, 1.0), 20, report());
}
TEST_P(TrialInThePlane, OfAnAffineStep) {
  expect_same_bits(soil<2>(plane_mesh(GetParam(), 12), elastic(), 20, 1.0), 20, apic());
}
TEST_P(TrialInThePlane, OfBodiesOfRevolution) {
  if (GetParam() == Background::gimp) GTEST_SKIP() << "no bodies of revolution of points that are boxes";
  expect_same_bits(soil<2>(revolved(plane_mesh(GetParam(), 12)), subloading(), 20, 1.0), 20, standard());
  expect_same_bits(soil<2>(revolved(plane_mesh(GetParam(), 12)), elastic(), 20, 1.0), 20, report());
}
TEST_P(TrialInThePlane, OfSandThatSharesItsOpenings) {
  const auto met = expect_same_bits(soil<2>(plane_mesh(GetParam(), 12), sand(), 20, 1.0), 20, standard());
  EXPECT_GT(met.separated, 0) << "no point is open";
}
TEST_P(TrialInSpace, OfTheStandardStep) {
  expect_same_bits(soil<3>(solid_mesh(GetParam(), 6), subloading(), 7, 1.0), 10, standard());
}
TEST_P(TrialInSpace, OfTheReportsStep) {
  expect_same_bits(soil<3>(solid_mesh(GetParam(), 6), elastic(), 7, 1.0), 10, report());
}
TEST_P(TrialInSpace, OfSandThatSharesItsOpenings) {
  const auto met = expect_same_bits(soil<3>(solid_mesh(GetParam(), 6), sand(), 7, 1.0), 10, standard());
  EXPECT_GT(met.separated, 0) << "no point is open";
}

// A tolerance at which some points, but not all, need more than a substep: they are finished apart.
TEST(Trial, OfPointsThatNeedSubsteps) {
  StepSettings settings = standard();
  settings.integration = {1e-7, 1e-4};
  const auto met = expect_same_bits(soil<2>(plane_mesh(Background::grid, 12), subloading(), 20, 1.0), 20, settings);
  EXPECT_GT(met.most_substeps, 1);
}
TEST(Trial, OfEveryLaw) {
  for (const auto& model : every_model()) {
    SCOPED_TRACE(description_of(model).name);
    expect_same_bits(soil<2>(plane_mesh(Background::grid, 12), model, 20, 1.0), 20, standard());
  }
}
TEST(Trial, OfAUserRoutineWithAStateOfItsOwn) {
  std::vector<Record> state;
  for (const char* name : {"count", "clock", "strain", "letter"})
    state.push_back({{{"name", std::string(name)}, {"kind", std::string("scalar")}}});
  const Values settings{{"library", std::string(SCARP_UMATS "/elastic_c.so")},
                        {"constants", std::vector<double>{1000, 0.3, 5, -1}},
                        {"state", state}};
  const auto umat = make_model("umat", {}, settings).model.value();
  auto body = soil<2>(plane_mesh(Background::grid, 12), umat, 20, 1.0);
  auto& block = body.blocks()[0];
  const auto& law = std::get<Umat>(block.model);
  for (int i = 0; i < block.size(); ++i) {
    std::vector<Problem> problems;
    const auto start = law.initial_state<4>(exec::state_of<2>(block, law, i).sigma, 2, {}, problems);
    exec::store<2>(law, start, block, [i](double x, Column& column) { column[i] = x; });
  }
  expect_same_bits(std::move(body), 20, standard());
}
TEST(Trial, OfSoilThatSoftensOverALength) {
  for (const auto kind : {Background::grid, Background::mixed}) {
    expect_same_bits(soil<2>(plane_mesh(kind, 12), subloading(), 20, 2.0, 0.2), 30, standard());
  }
}
// Nodes with less than a mass that is set so that some have are left out, and move with the others of an element.
TEST(Trial, OfElementsWithNodesWithoutMass) {
  auto body = soil<2>(plane_mesh(Background::triangles, 12), elastic(), 20, 0.0);
  body.fields[0].least_mass = 0.5 * body.blocks()[0].points.mass[0];
  EXPECT_GT(expect_same_bits(std::move(body), 1, standard()).massless_nodes, 0);
}

const auto all_kinds = testing::Values(Background::grid, Background::gimp, Background::b_spline, Background::quads,
                                       Background::triangles, Background::mixed);
constexpr auto name_of_kind = [](const auto& its) {
  return std::array{"grid", "gimp", "b_spline", "quads", "triangles", "mixed"}[static_cast<int>(its.param)];
};
INSTANTIATE_TEST_SUITE_P(All, TrialInThePlane, all_kinds, name_of_kind);
INSTANTIATE_TEST_SUITE_P(All, TrialInSpace, all_kinds, name_of_kind);

}  // namespace
}  // namespace scarp::test
