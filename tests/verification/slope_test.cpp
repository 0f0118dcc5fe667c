// The report's slope, coarse: verification.md's item 12. It stands under its weight, it stays as it is when left alone,
// it fails after its toe is cut, and mass and energy are accounted for. Elements of 1 m, points of 0.4 m: they do not
// keep step with the mesh. The full case is examples/slope_cut_grid.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <numeric>
#include <regex>
#include <sstream>

#include "scarp/base/error.hpp"
#include "scarp/run/run.hpp"

namespace scarp::verification {
namespace {

namespace fs = std::filesystem;

using Columns = std::map<std::string, std::vector<double>>;

Columns read_csv(const fs::path& path) {
  std::ifstream file(path);
  std::string line, cell;
  std::vector<std::string> names;
  Columns columns;
  std::getline(file, line);
  for (std::istringstream row(line); std::getline(row, cell, ',');) names.push_back(cell);
  while (std::getline(file, line)) {
    std::size_t k = 0;
    for (std::istringstream row(line); std::getline(row, cell, ',');) columns[names[k++]].push_back(std::stod(cell));
  }
  return columns;
}

/// A column of Float64 in a frame: VTU with appended raw data, each array after its length in bytes.
std::vector<double> read_column(const fs::path& path, const std::string& name) {
  std::ifstream file(path, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  const std::regex tag("<DataArray[^>]*Name=\"" + name + "\"[^>]*offset=\"([0-9]+)\"");
  std::smatch match;
  const std::string header = text.substr(0, text.find("<AppendedData"));
  if (!std::regex_search(header, match, tag)) throw std::runtime_error("no column " + name);
  const std::size_t at = text.find('_', header.size()) + 1 + std::stoul(match[1]);
  std::uint64_t bytes = 0;
  std::memcpy(&bytes, text.data() + at, sizeof bytes);
  std::vector<double> column(bytes / sizeof(double));
  std::memcpy(column.data(), text.data() + at + sizeof bytes, bytes);
  return column;
}

double mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

struct SlopeRun {
  nlohmann::json summary;
  Columns history;
  std::vector<double> bonding;  ///< mean bonding factor R_b of each frame
};

SlopeRun run_slope(const std::string& name, std::vector<std::string> overrides) {
  const fs::path out = fs::path(testing::TempDir()) / ("scarp_" + name);
  fs::remove_all(out);
  overrides.insert(overrides.begin(), {"mesh.grid={ origin = [0.0, 0.0], size = [45.0, 17.0], elements = [45, 17] }",
                                       "region.0.spacing=0.4"});
  run::run_case(input::read_case(SCARP_EXAMPLES "/slope_cut_grid/slope_cut_grid.toml", overrides),
                {out.string(), 1, true});
  SlopeRun result{nlohmann::json::parse(std::ifstream(out / "summary.json")), read_csv(out / "history.csv"), {}};
  for (int k = 0; fs::exists(out / fmt::format("points_{:05}.vtu", k)); ++k)
    result.bonding.push_back(mean(read_column(out / fmt::format("points_{:05}.vtu", k), "R_b")));
  fs::remove_all(out);
  return result;
}

/// What holds in every run of the program, whatever the soil does.
void expect_accounts_in_order(const SlopeRun& slope) {
  EXPECT_EQ(slope.summary["status"], "done");
  EXPECT_EQ(slope.summary["failures"], 0);
  // Points carry their mass; what is left is the round-off of summing a few thousand.
  EXPECT_LT(std::abs(slope.summary["mass_error"].get<double>()), 1e-13);
  // Asked: 2 % of the work of gravity. The fine slope leaves 0.1 to 0.3 %, this coarse one 0.2 to 1 %.
  EXPECT_LT(slope.summary["energy_error"].get<double>(), 0.02);
}

TEST(Slope, StandsAndFailsAfterTheCut) {
  const auto slope = run_slope("cut", {"stage.1.duration=30.0"});
  expect_accounts_in_order(slope);
  const auto &rest = slope.summary["stages"][0], &cut = slope.summary["stages"][1];
  EXPECT_EQ(rest["ended"], "at rest");
  EXPECT_LE(rest["unbalanced_ratio"].get<double>(), 1e-3);
  EXPECT_LT(rest["max_velocity"].get<double>(), 0.01);
  // A static solution on finer elements settles by 0.151 m (theory.md, initial state), without the release by 0.18 m.
  EXPECT_NEAR(rest["max_displacement"].get<double>(), 0.15, 0.02);

  // It fails: metres, where the uncut slope moves by a centimetre. On elements of 1 m the point that goes furthest goes
  // 12.3 m (11.2 m with sides that are held in place of absorbing), 98 % of what moves 0.9 m beyond x = 30.
  EXPECT_GT(cut["max_displacement"].get<double>(), 9.0);
  EXPECT_LT(cut["max_displacement"].get<double>(), 15.0);
  // The slide is over by then: what still moves are small surges of the steep debris, below 5 % of the energy at peak.
  const auto& kinetic = slope.history.at("kinetic_energy");
  EXPECT_LT(kinetic.back(), 0.05 * *std::max_element(kinetic.begin(), kinetic.end()));

  // Momentum: on the whole body act its weight and the walls. Nothing pushes sideways faster than the slide itself.
  const auto &mass = slope.history.at("mass"), &momentum = slope.history.at("momentum_x");
  for (std::size_t i = 0; i < mass.size(); ++i) EXPECT_LT(std::abs(momentum[i]), 0.5 * mass[i]);
}

TEST(Slope, LeftAloneTenTimesAsLongItStandsAndItsStructureIsWhole) {
  // No damping in the second stage: noise has nothing to die in but the soil.
  const std::string alone =
      "stage=[{ name = 'at rest', duration = 30.0, damping = 0.7, rest = { unbalanced = 1e-3, kinetic = 1e-6, hold = "
      "0.2 "
      "} }, { name = 'cut', duration = 30.0, zero_displacement = true }]";
  const auto slope = run_slope("alone", {alone, "output.every=30.0"});
  expect_accounts_in_order(slope);
  const auto& stage = slope.summary["stages"][1];
  EXPECT_LE(stage["unbalanced_ratio"].get<double>(), 5e-3);
  EXPECT_LT(stage["max_velocity"].get<double>(), 0.01);
  EXPECT_LT(stage["max_displacement"].get<double>(), 0.03);
  // Whole: the goal of verification.md for 10⁴ steps is 1 % of R_b − R_bf; here are 7,000, on a coarse mesh.
  ASSERT_EQ(slope.bonding.size(), 3u);  // at the start, at rest, at the end
  EXPECT_GT(slope.bonding[1], 2.8);
  const double lost = (slope.bonding[1] - slope.bonding[2]) / (slope.bonding[1] - 1);
  EXPECT_GE(lost, 0);
  EXPECT_LT(lost, 0.02);
  std::printf("slope left alone: %.2f %% of the bonding at rest lost, %.4f m moved\n", 100 * lost,
              stage["max_displacement"].get<double>());
}

std::string bytes_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

TEST(Slope, IsTheSameToTheLastBitOnOneAndTwoThreads) {
  // Rest, cut and the start of the slide, with points that change element and are put in order again.
  std::map<std::string, std::string> files[2];
  for (const int threads : {1, 2}) {
    const fs::path out = fs::path(testing::TempDir()) / fmt::format("scarp_threads_{}", threads);
    fs::remove_all(out);
    const auto input = input::read_case(
        SCARP_EXAMPLES "/slope_cut_grid/slope_cut_grid.toml",
        {"mesh.grid={ origin = [0.0, 0.0], size = [45.0, 17.0], elements = [45, 17] }", "region.0.spacing=0.4",
         "stage.0.duration=0.5", "stage.0.release=0.4", "stage.0.rest.required=false", "stage.1.remove.over=1.0",
         "stage.1.duration=1.5", "output.history=0.0"});
    run::run_case(input, {out.string(), threads, true});
    for (const auto& file : fs::directory_iterator(out)) {
      const auto name = file.path().filename().string();
      // Wall time is in the others.
      if (name.ends_with(".vtu") || name.ends_with(".csv") || name.ends_with(".pvd"))
        files[threads - 1][name] = bytes_of(file.path());
    }
    fs::remove_all(out);
  }
  ASSERT_GT(files[0].size(), 8u);
  ASSERT_EQ(files[0].size(), files[1].size());
  for (const auto& [name, text] : files[0]) EXPECT_TRUE(text == files[1][name]) << name;
}

TEST(Slope, SumOverPointsAsPrintedDoesNotComeToRestWherePointsAndMeshDoNotKeepStep) {
  // The reason for the corrected quadrature, kept as a test: eq. 4 as printed, the same slope.
  EXPECT_THROW(run_slope("printed", {"method.quadrature='points'", "stage.0.duration=6.0", "output.every=6.0"}),
               RunError);
}

}  // namespace
}  // namespace scarp::verification
