// Cases in three dimensions: values land in their fields; each error has its place, value and remedy.
#include <gtest/gtest.h>

#include "refusal.hpp"

namespace scarp::input::test {
namespace {

const std::string space = R"(dimension = 3
gravity = [0.0, 0.0, -9.8]

[mesh]
grid = { size = [4.0, 3.0, 2.0], element = 0.5 }

[[material]]
name = "rock"
model = "linear-elastic"
density = 2.2
E = 1e4
nu = 0.25

[[region]]
name = "block"
material = "rock"
box = [[1.0, 0.0, 0.0], [0.0, 2.0, 1.0]]
spacing = 0.25
velocity = [1.0, 2.0, 3.0]
K0 = 0.6

[[region]]
name = "slope"
material = "rock"
polygon = [[1.0, 0.0], [2.0, 0.0], [2.0, 1.5]]
y = [0.0, 2.5]
spacing = 0.5
stress = [1.0, 2.0, 3.0, 4.0, 5.0, 6.0]

[[boundary]]
box = [[0.0, 0.0, 0.0], [4.0, 3.0, 0.0]]
fix = ["z"]
friction = 0.3

[[stage]]
name = "cut"
duration = 1.5
remove = { box = [[0.5, 0.5, 0.5], [1.0, 1.0, 1.5]], lifts = 2 }
)";

TEST(SpaceCase, Values) {
  const CaseFile file(space);
  const auto any = read_any_case(file.path());
  ASSERT_TRUE(std::holds_alternative<CaseOf<3>>(any));
  const auto& c = std::get<CaseOf<3>>(any);
  EXPECT_EQ(c.gravity, (Vec<3>{0, 0, -9.8}));
  EXPECT_EQ(c.mesh.grid->elements, (std::array<int, 3>{8, 6, 4}));
  EXPECT_EQ(bounds(c.regions[0].shape()).low, (Vec<3>{0, 0, 0}));
  EXPECT_EQ(bounds(c.regions[0].shape()).high, (Vec<3>{1, 2, 1}));
  EXPECT_EQ(c.regions[0].velocity, (Vec<3>{1, 2, 3}));
  EXPECT_NEAR(volume(c.regions[1].shape()), 0.75 * 2.5, 1e-14);
  EXPECT_EQ(c.regions[1].stress, (std::array<double, 6>{1, 2, 3, 4, 5, 6}));
  EXPECT_EQ(c.boundaries[0].fixed(), (std::array<bool, 3>{false, false, true}));
  EXPECT_EQ(c.boundaries[0].box->high, (Vec<3>{4, 3, 0}));
  EXPECT_NEAR(volume(c.stages[0].remove->shape()), 0.25, 1e-14);
  EXPECT_THROW(read_case(file.path()), InputError);
}

TEST(SpaceCase, Refusals) {
  const std::vector<Bad> table{
      {"dimension = 3", "@dimension = 4", "dimension must satisfy", "4", "bounds"},
      {"gravity = [0.0, 0.0, -9.8]", "@gravity = [0.0, -9.8]", "3 numbers in three dimensions", "2 items", "dimension"},
      {"size = [4.0, 3.0, 2.0]", "@size = [4.0, 3.0]", "size is a list of 3 numbers", "2 items", "dimension = 3"},
      {"velocity = [1.0, 2.0, 3.0]", "@velocity = [1.0, 2.0]", "velocity is a list of 3", "2 items", "dimension"},
      {"stress = [1.0, 2.0, 3.0, 4.0, 5.0, 6.0]", "@stress = [1.0, 2.0, 3.0, 4.0]", "list of 6", "4 items",
       "6 numbers"},
      {"box = [[1.0, 0.0, 0.0], [0.0, 2.0, 1.0]]", "@box = [[1.0, 0.0, 0.0], [0.0, 2.0, 0.0]]", "length along z",
       "z = 0", "corners"},
      {"y = [0.0, 2.5]", "@y = [2.5, 0.0]", "y goes from a lower", "[2.5, 0]", "y = [from, to]"},
      {"\ny = [0.0, 2.5]", "", "extent along the third axis", "none", "write y =", "polygon = "},
      {"[2.0, 1.5]]", "@[2.0, 0.0, 1.5]]", "a corner is a list of 2", "3 items", "[x, z]"},
      {"y = [0.0, 2.5]", "@stl = \"no.stl\"", "one of a box", "more than one", "hill.stl",
       "[[region]]\nname = \"slope\""},
      {"box = [[0.0, 0.0, 0.0], [4.0", "@line = [[0.0, 0.0, 0.0], [4.0", "line is a key of cases in two", "a list",
       "box"},
      {"fix = [\"z\"]", "fix = [\"z\", \"x\"]\n", "fixes one component", "x and z fixed", "across", "friction = 0.3"},
      {"fix = [\"z\"]", "fix = [@\"w\"]", "\"x\", \"y\" or \"z\"", "\"w\"", "write fix"},
      {"dimension = 3\ngravity = [0.0, 0.0, -9.8]", "@gravity = [0.0, 0.0, -9.8]", "2 numbers", "3 items",
       "dimension = 3"},
  };
  for (auto bad : table) {
    if (bad.to.find("stl") != std::string::npos) bad.to.erase(0, 1);
    expect_refused(space, bad, [](const std::string& path) { read_any_case(path); });
  }
}

}  // namespace
}  // namespace scarp::input::test
