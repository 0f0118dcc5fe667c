// The material point method and the laboratory on a law from a shared library, against the same law built in, and the
// tensors of its state under rotation: everything from the case file on.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <string>

#include "body_maker.hpp"
#include "scarp/base/error.hpp"
#include "scarp/exec/stress_update.hpp"
#include "scarp/input/case.hpp"
#include "scarp/input/lab_test.hpp"
#include "scarp/lab/driver.hpp"
#include "scarp/run/build.hpp"
#include "scarp/run/fields.hpp"

namespace scarp::verification {
namespace {

/// A folder with a case in it and, beside it, the libraries; removed at the end.
class CaseFolder {
 public:
  CaseFolder() : path_(std::filesystem::path(testing::TempDir()) / ("scarp_umat_" + std::to_string(getpid()))) {
    std::filesystem::create_directories(path_);
    std::error_code there;
    std::filesystem::create_directory_symlink(SCARP_UMATS, path_ / "laws", there);
  }
  ~CaseFolder() { std::filesystem::remove_all(path_); }
  CaseFolder(const CaseFolder&) = delete;
  CaseFolder& operator=(const CaseFolder&) = delete;

  input::Case read(const std::string& material, const std::string& region = "") const {
    std::ofstream(path_ / "case.toml") << R"(gravity = [0.0, -9.81]
[mesh]
grid = { size = [6.0, 4.0], element = 0.5 }
[[material]]
name = "soil"
density = 2.0
)" << material << R"(
[[region]]
name = "block"
material = "soil"
polygon = [[1.0, 0.0], [4.0, 0.0], [4.0, 2.0], [1.5, 3.0]]
spacing = 0.23
K0 = 0.5
velocity = [0.5, 0.0]
)" << region << R"(
[[boundary]]
nodes = "bottom"
fix = ["x", "y"]
[[stage]]
name = "sway"
duration = 1.0
)";
    return input::read_case((path_ / "case.toml").string());
  }

  lab::Test read_lab(const std::string& material, const std::string& stages) const {
    std::ofstream(path_ / "path.csv")
        << "eps_xx,eps_yy,eps_zz,eps_xy,eps_yz,eps_zx\n0.001,0.002,-0.001,0.003,0.001,0.002\n"
           "0.002,-0.001,0.003,0.001,0.004,-0.005\n";
    std::ofstream(path_ / "test.toml") << "[material]\n"
                                       << material << "[initial]\nstress = [50.0, 50.0, 50.0, 0.0, 0.0, 0.0]\n"
                                       << stages;
    return input::read_lab_test((path_ / "test.toml").string()).test;
  }

 private:
  std::filesystem::path path_;
};

const std::string built_in = "model = \"linear-elastic\"\nE = 2e3\nnu = 0.3\n";

std::string elastic(const std::string& library) {
  return "model = \"umat\"\nlibrary = \"laws/" + library + ".so\"\nconstants = [2e3, 0.3]\n";
}

double largest_difference(const Column& a, const Column& b) {
  double worst = a.size() == b.size() ? 0 : INFINITY;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) worst = std::max(worst, std::abs(a[i] - b[i]));
  return worst;
}

/// 400 steps of two bodies that should move alike; the largest difference of stress, of 100 kPa, and of place and
/// velocity, of 1 m and 1 m/s.
double difference_of_runs(const std::string& one, const std::string& other) {
  const CaseFolder folder;
  auto a = run::build_body(folder.read(one)), b = run::build_body(folder.read(other));
  const double critical = critical_time_step(a);
  EXPECT_NEAR(critical_time_step(b) / critical, 1, 1e-14);
  double worst = 0;
  for (int step = 0; step < 400; ++step) {
    const auto totals = advance(a, 0.3 * critical, {}), others = advance(b, 0.3 * critical, {});
    EXPECT_NEAR(others.stress.critical_dt / totals.stress.critical_dt, 1, 1e-12);
    EXPECT_EQ(others.stress.failures, 0);
    const auto &p = a.blocks()[0].points, &q = b.blocks()[0].points;
    for (std::size_t c = 0; c < 4; ++c) worst = std::max(worst, largest_difference(p.sigma[c], q.sigma[c]) / 100);
    for (std::size_t c = 0; c < 2; ++c) {
      worst = std::max(worst, largest_difference(p.x[c], q.x[c]));
      worst = std::max(worst, largest_difference(p.v[c], q.v[c]));
    }
  }
  const auto& points = a.blocks()[0].points;
  EXPECT_GT(*std::max_element(points.eps_q.begin(), points.eps_q.end()), 1e-3);  // something happened
  return worst;
}

// All points, all steps. Band: both add the same numbers in another order; 400 steps of rounding.
TEST(UmatInTheMpm, ElasticInCIsTheBuiltInLaw) {
  const double worst = difference_of_runs(built_in, elastic("elastic_c"));
  EXPECT_LT(worst, 1e-11);
  std::printf("elastic UMAT in C against the built-in law, 400 steps: %.1e\n", worst);
}

TEST(UmatInTheMpm, OneAtATimeOrAllAtOnceIsTheSame) {
  EXPECT_EQ(difference_of_runs(elastic("elastic_c"), elastic("elastic_c") + "calls = \"parallel\"\n"), 0);
}

/// What reading the case and building its body complains of.
std::string complaint(const std::string& material, const std::string& region = "") {
  const CaseFolder folder;
  try {
    run::build_body(folder.read(material, region));
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

void expect_parts(const std::string& text, const std::vector<std::string>& parts) {
  for (const auto& part : parts) EXPECT_NE(text.find(part), std::string::npos) << part << " is not in:\n" << text;
}

// Each message has place, value and remedy. The material's keys start at line 7, column 1.
TEST(UmatInTheMpm, MistakesInTheCaseAreAnswered) {
  const std::string head = "model = \"umat\"\n";
  expect_parts(complaint(head), {"case.toml:4:1: ", "the key library", "add library = ..., a text"});
  expect_parts(complaint(head + "library = \"laws/none.so\"\n"),
               {"case.toml:8:1: ", "is not there", "laws/none.so", "from the folder of the case file"});
  expect_parts(complaint(head + "library = \"laws/no_umat.so\"\n"),
               {"case.toml:4:1: ", "no such routine", "none of umat_, umat, UMAT", "nm -D"});
  expect_parts(complaint(head + "library = \"laws/no_umat.so\"\nsymbol = \"soil\"\n"),
               {"case.toml:9:1: ", "none of soil, soil_"});
  expect_parts(complaint(head + "library = 3\n"), {"case.toml:8:1: ", "library is a text", "the number 3"});
  expect_parts(complaint(elastic("elastic_c") + "celent = \"big\"\n"),
               {"case.toml:10:1: ", "celent is a number", "the text \"big\"", "without quotes"});
  expect_parts(complaint(elastic("elastic_c") + "E = 3\n"),
               {"case.toml:10:1: ", "no constant E", "`scarp models umat`"});
  expect_parts(complaint(elastic("elastic_c") + "state = [{ name = \"a\", kind = \"b\" }]\n"),
               {"case.toml:10:1: ", "state[0]: kind is", "\"b\"", "write state = ["});
  expect_parts(complaint(elastic("elastic_c") + "state = [\"a\"]\n"),
               {"case.toml:10:", "a table of state is a table", "the text \"a\""});
  expect_parts(complaint(elastic("elastic_c") + "state = [{ name = \"p_c\" }]\n", "initial = { pc = 3.0 }\n"),
               {"no initial value pc", "did you mean p_c?"});
  expect_parts(complaint(head + "library = \"laws/elastic_c.so\"\nconstants = [2e3]\n"),
               {"region \"block\", initial state at (", "the UMAT of the material SOIL (", "= nan", "NPROPS = 1"});
}

TEST(UmatInTheMpm, ANanInTheRunIsAFailureOfThePoint) {
  const CaseFolder folder;
  auto body = run::build_body(
      folder.read("model = \"umat\"\nlibrary = \"laws/elastic_c.so\"\nconstants = [2e3, 0.3, 1, 0.005]\n"));
  const double dt = 0.3 * critical_time_step(body);
  testing::internal::CaptureStderr();
  double time = 0;
  std::int64_t failures = 0;
  for (; failures == 0 && time < 0.1; time += dt) failures = advance(body, dt, {}).stress.failures;
  const auto text = testing::internal::GetCapturedStderr();
  EXPECT_EQ(failures, body.point_count());
  EXPECT_GT(time, 0.005);
  EXPECT_NE(text.find("the UMAT of the material SOIL"), std::string::npos) << text;
}

TEST(UmatInTheMpm, XitEndsTheRunWithItsMessage) {
  const CaseFolder folder;
  auto body = run::build_body(
      folder.read("model = \"umat\"\nlibrary = \"laws/elastic_c.so\"\nconstants = [2e3, 0.3, 2, 0.005]\n"));
  const double dt = 0.3 * critical_time_step(body);
  try {
    for (int step = 0; step < 100; ++step) advance(body, dt, {});
    ADD_FAILURE() << "the run goes on";
  } catch (const RunError& error) {
    EXPECT_NE(std::string(error.what()).find("the UMAT of the material SOIL"), std::string::npos) << error.what();
  }
}

/// The rows of a curve, and the place of its columns.
struct Curve {
  std::vector<std::string> columns;
  std::vector<std::vector<double>> rows;

  double at(std::size_t row, const std::string& name) const {
    return rows[row][static_cast<std::size_t>(std::find(columns.begin(), columns.end(), name) - columns.begin())];
  }
};

Curve curve_of(const std::string& material, const std::string& stages) {
  const CaseFolder folder;
  const auto test = folder.read_lab(material, stages);
  Curve curve{lab::curve_columns(test.model), {}};
  lab::run_test(test, [&](const std::vector<double>& row) { curve.rows.push_back(row); });
  for (const auto& row : curve.rows) EXPECT_EQ(row.size(), curve.columns.size());
  return curve;
}

/// Largest difference of stress between the elastic UMAT and the built-in law.
double difference_of_curves(const std::string& stages) {
  const auto a = curve_of(built_in, stages), b = curve_of(elastic("elastic_c"), stages);
  EXPECT_EQ(a.rows.size(), b.rows.size());
  double worst = 0;
  for (std::size_t row = 0; row < a.rows.size(); ++row) {
    for (const char* component : lab::component_names) {
      const std::string name = std::string("sig_") + component;
      worst = std::max(worst, std::abs(a.at(row, name) - b.at(row, name)));
    }
  }
  return worst;
}

TEST(UmatInTheLaboratory, ElasticIsTheBuiltInLaw) {
  // Rounding of some 50 kPa.
  EXPECT_LT(difference_of_curves("[[stage]]\ntype = \"strain-path\"\nfile = \"path.csv\"\nduration = 1.0\n"), 1e-12);
  // A law with an update meets constraints at the end of an increment, to 1e-8 of the stress and of what the strain
  // does.
  EXPECT_LT(difference_of_curves("[[stage]]\ntype = \"triaxial-undrained\"\neps_a = [0.01, -0.01]\ncycles = 2\n"
                                 "increments = 10\nduration = 1.0\n"),
            1e-6);
}

#ifdef SCARP_FORTRAN_UMATS
TEST(UmatInTheMpm, ElasticInFortranIsTheBuiltInLaw) {
  EXPECT_LT(difference_of_runs(built_in, elastic("elastic_f")), 1e-11);
}

const std::string kinematic = R"(model = "umat"
library = "laws/kinematic_f.so"
constants = [2e3, 0.3, 60.0, 300.0]
state = [
  { name = "alpha", kind = "tensor", initial = [1.0, 2.0, -3.0, 4.0] },
  { name = "epsp", kind = "strain" },
  { name = "epsp_eq" },
]
)";

const io::Field& field(const std::vector<io::Field>& all, const std::string& name) {
  return *std::find_if(all.begin(), all.end(), [&](const io::Field& f) { return f.name == name; });
}

// What was declared is kept, a column for each of its values in plane strain and none for the rest, and comes out by
// name. Oracle: the case; alpha as tensor components.
TEST(UmatInTheMpm, StateIsKeptAndShownByName) {
  const CaseFolder folder;
  const auto body = run::build_body(folder.read(kinematic, "initial = { epsp_eq = 0.25 }"));
  EXPECT_EQ(body.blocks()[0].state.size(), 4u + 3u + 9u);
  const auto frame = run::frame_of(body);
  const auto alpha = io::values_of<double>(field(frame.fields, "alpha"), frame.count);
  const auto equivalent = io::values_of<double>(field(frame.fields, "epsp_eq"), frame.count);
  ASSERT_EQ(alpha.size(), 6 * equivalent.size());
  const std::array<double, 6> expected{1, 2, -3, 4, 0, 0};
  for (std::size_t i = 0; i < alpha.size(); ++i) EXPECT_NEAR(alpha[i], expected[i % 6], 1e-15);
  for (const double x : equivalent) EXPECT_EQ(x, 0.25);
}

// A quarter turn of all points without strain in 100 steps: xx and yy change places, xy changes its sign.
TEST(UmatInTheMpm, TensorStateTurnsWithThePoints) {
  const CaseFolder folder;
  auto body = run::build_body(folder.read(kinematic));
  auto& block = body.blocks()[0];
  auto& points = block.points;
  const std::array<double, 4> sigma{-6, -10, -7, 2};
  for (int p = 0; p < block.size(); ++p)
    for (int c = 0; c < 4; ++c) points.sigma[c][p] = sigma[c];
  PointIncrements<2> increments;  // none, but for the spin
  increments.reserve(block.size());
  // W_xy of an anticlockwise turn is negative; Hughes–Winget turns by 2 atan(|W_xy|/2).
  std::fill(increments.spin[0].begin(), increments.spin[0].end(), -2 * std::tan(std::numbers::pi / 2 / 100 / 2));
  for (auto* column : {&increments.volume, &increments.per_mass}) std::fill(column->begin(), column->end(), 1.0);
  exec::StressTotals totals;
  for (int step = 0; step < 100; ++step)
    exec::update_stresses(block, {block.order.data(), block.size()}, increments, 0, 1e-3, {}, totals);
  const std::array<double, 4> turned_sigma{-10, -6, -7, -2}, turned_alpha{2, 1, -3, -4 * sqrt2};
  for (int p = 0; p < block.size(); ++p) {
    for (int c = 0; c < 4; ++c) {
      EXPECT_NEAR(points.sigma[c][p], turned_sigma[c], 1e-12);  // rounding of a hundred rotations
      EXPECT_NEAR(block.state[7 + c][p], turned_alpha[c], 1e-12);
    }
    EXPECT_NEAR(block.state[5][p], 0.1, 1e-14);  // time
    EXPECT_EQ(block.state[6][p], 100);
  }
}

// Drained triaxial compression. Closed form, with ε_a = q/E + ε_p and q = σ_y + H ε_p: q = (σ_y + H ε_a)/(1 + H/E). The
// cell pressure is constant, and the state of the routine stands in columns under its names.
TEST(UmatInTheLaboratory, KinematicHardeningInTriaxialCompression) {
  auto material = kinematic;
  material.replace(material.find(", initial = [1.0, 2.0, -3.0, 4.0]"), 33, "");
  const auto curve = curve_of(material,
                              "[[stage]]\ntype = \"triaxial-drained\"\neps_a = 0.1\nincrements = 20\n"
                              "duration = 10.0\n");
  ASSERT_EQ(curve.rows.size(), 20u);
  for (std::size_t row = 9; row < 20; ++row) {
    const double q = (60 + 300 * curve.at(row, "eps_zz")) / (1 + 300.0 / 2e3), ep = (q - 60) / 300;
    EXPECT_NEAR(curve.at(row, "q"), q, 1e-5);  // constraints to 1e-8 of stress, and of 2e3 kPa times strain
    EXPECT_NEAR(curve.at(row, "sig_xx"), 50, 1e-5);
    EXPECT_NEAR(curve.at(row, "epsp_eq"), ep, 1e-7);
    EXPECT_NEAR(curve.at(row, "alpha_zz"), -2.0 / 3 * 300 * ep, 1e-5);  // signs of the UMAT
    EXPECT_NEAR(curve.at(row, "epsp_zz"), -ep, 1e-7);
    EXPECT_NEAR(curve.at(row, "umat_time"), 0.5 * (static_cast<double>(row) + 1), 1e-9);
  }
}
#endif

}  // namespace
}  // namespace scarp::verification
