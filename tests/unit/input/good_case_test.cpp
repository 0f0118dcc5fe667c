// Good cases: every value lands in the field that it belongs to. Oracle: the text of the case itself.
#include <gtest/gtest.h>

#include <type_traits>

#include "minimal.hpp"

namespace scarp::input::test {
namespace {

TEST(GoodCase, GroundAndMesh) {
  const CaseFile file(minimal);
  const Case c = read_case(file.path());
  EXPECT_EQ(c.path, file.path());
  EXPECT_EQ(c.title, "two columns");
  EXPECT_EQ(c.gravity, (Vec<2>{0.0, -9.81}));
  ASSERT_TRUE(c.mesh.grid);
  EXPECT_FALSE(c.mesh.file);
  EXPECT_EQ(c.mesh.grid->origin, (Vec<2>{-1.0, 0.0}));
  EXPECT_EQ(c.mesh.grid->size, (Vec<2>{4.0, 2.0}));
  EXPECT_EQ(c.mesh.grid->elements, (std::array<int, 2>{8, 4}));
}

TEST(GoodCase, Materials) {
  const Case c = read(minimal);
  ASSERT_EQ(c.materials.size(), 2u);
  EXPECT_EQ(c.materials[0].name, "rock");
  EXPECT_EQ(c.materials[0].density, 2.2);
  EXPECT_TRUE(std::holds_alternative<LinearElastic>(c.materials[0].model));
  EXPECT_EQ(c.materials[1].name, "clay");
  EXPECT_EQ(c.materials[1].density, 1.8);
  EXPECT_TRUE(std::holds_alternative<Subloading>(c.materials[1].model));
  EXPECT_EQ(c.materials[1].position.line, 17);
  EXPECT_EQ(c.materials[1].length, 0.0);
  EXPECT_EQ(read(replaced(minimal, "density = 1.8", "density = 1.8\nlength = 0.75")).materials[1].length, 0.75);
  EXPECT_EQ(read(replaced(minimal, "density = 2.2", "density = 2.2\nlength = 0.0")).materials[0].length, 0.0);
}

TEST(GoodCase, Regions) {
  const Case c = read(minimal);
  ASSERT_EQ(c.regions.size(), 2u);
  const auto &left = c.regions[0], &right = c.regions[1];
  EXPECT_EQ(left.name, "left");
  EXPECT_EQ(left.material, 1u);
  EXPECT_EQ(left.polygon, (Polygon{{0.0, 0.0}, {1.0, 0.0}, {1.0, 2.0}, {0.0, 2.0}}));
  EXPECT_EQ(left.spacing, 0.25);
  EXPECT_EQ(left.velocity, (Vec<2>{0.0, 0.0}));
  EXPECT_EQ(left.K0, 0.6);
  EXPECT_FALSE(left.stress);
  EXPECT_EQ(left.initial, (Values{{"R_b", 3.0}, {"OCR", 1.6}, {"beta", std::string("isotropic")}}));
  EXPECT_EQ(right.name, "right");
  EXPECT_EQ(right.material, 0u);
  EXPECT_EQ(right.polygon.size(), 3u);
  EXPECT_FALSE(right.K0);
  EXPECT_EQ(right.stress, (std::array<double, 4>{1.0, 2.0, 3.0, 0.5}));
  EXPECT_TRUE(right.initial.empty());
}

TEST(GoodCase, Schemes) {
  const auto method = [](const std::string& text) { return read(replaced(minimal, "flip = 0.95", text)).method; };
  const auto standard = method("");
  EXPECT_EQ(standard.scheme, SchemeName::two_term);
  EXPECT_EQ(standard.safety, 0.8);
  EXPECT_EQ(standard.pic_time, 0.5);
  EXPECT_FALSE(standard.stress_damping || standard.ignored_flip);
  EXPECT_EQ(standard.stress_damping_time, 0.0);
  EXPECT_TRUE(method("flip = 0.95").ignored_flip);
  const auto report = method("scheme = \"report\"\nflip = 0.9");
  EXPECT_EQ(report.scheme, SchemeName::report);
  EXPECT_EQ(report.flip, 0.9);
  EXPECT_EQ(report.safety, 0.5);
  EXPECT_FALSE(report.ignored_flip);
  EXPECT_EQ(method("scheme = \"report\"\nsafety = 0.7").safety, 0.7);
  const auto apic = method("scheme = \"apic\"\nstress_damping = 0.2");
  EXPECT_EQ(apic.scheme, SchemeName::apic);
  EXPECT_EQ(apic.stress_damping, 0.2);
  const auto timed = method("scheme = \"two-term\"\npic_time = 2\nstress_damping_time = 0.005");
  EXPECT_EQ(timed.pic_time, 2.0);
  EXPECT_EQ(timed.stress_damping_time, 0.005);
}

TEST(GoodCase, BoundariesAndStages) {
  const Case c = read(minimal);
  ASSERT_EQ(c.boundaries.size(), 2u);
  EXPECT_EQ(c.boundaries[0].nodes, "bottom");
  EXPECT_FALSE(c.boundaries[0].line || c.boundaries[0].friction);
  EXPECT_TRUE(c.boundaries[0].fix_x && c.boundaries[0].fix_y);
  EXPECT_FALSE(c.boundaries[1].nodes);
  EXPECT_EQ(c.boundaries[1].line, (std::array<Vec<2>, 2>{Vec<2>{-1.0, 0.0}, Vec<2>{-1.0, 2.0}}));
  EXPECT_TRUE(c.boundaries[1].fix_x && !c.boundaries[1].fix_y);
  EXPECT_EQ(c.boundaries[1].friction, 0.3);

  ASSERT_EQ(c.stages.size(), 2u);
  const auto &rest = c.stages[0], &cut = c.stages[1];
  EXPECT_EQ(rest.name, "rest");
  EXPECT_EQ(rest.duration, 2.0);
  EXPECT_EQ(rest.damping, 0.7);
  EXPECT_FALSE(rest.flip || rest.remove || rest.zero_displacement || rest.zero_velocity);
  ASSERT_TRUE(rest.rest);
  EXPECT_EQ(rest.rest->unbalanced, 1e-2);
  EXPECT_EQ(rest.rest->hold, 0.1);
  EXPECT_TRUE(rest.rest->required);
  EXPECT_EQ(cut.name, "cut");
  EXPECT_EQ(cut.duration, 1.5);
  EXPECT_FALSE(cut.rest);
  ASSERT_TRUE(cut.remove);
  EXPECT_EQ(cut.remove->polygon, (Polygon{{0.5, 0.5}, {1.0, 0.5}, {1.0, 2.0}}));
  EXPECT_EQ(cut.remove->lifts, 1);
  EXPECT_EQ(cut.remove->over, 0.0);
}

TEST(GoodCase, MethodAndOutput) {
  const Case c = read(minimal);
  const MethodInput standard;
  EXPECT_EQ(c.method.flip, 0.95);
  EXPECT_EQ(c.method.safety, standard.safety);
  EXPECT_EQ(c.method.tolerance, standard.tolerance);
  EXPECT_TRUE(c.method.corrected_quadrature);
  EXPECT_FALSE(c.method.remove_leaving);
  EXPECT_EQ(c.method.shape, GridFunctions::linear);
  EXPECT_EQ(c.output.every, 0.25);
  EXPECT_EQ(c.output.history, 0.0);
  EXPECT_EQ(c.output.colour, "displacement");
}

TEST(GoodCase, ShapeFunctions) {
  const auto shape = [](const std::string& word) {
    return read(replaced(minimal, "flip = 0.95", "shape = \"" + word + "\"")).method.shape;
  };
  EXPECT_EQ(shape("linear"), GridFunctions::linear);
  EXPECT_EQ(shape("gimp"), GridFunctions::gimp);
  EXPECT_EQ(shape("b-spline"), GridFunctions::b_spline);
}

TEST(GoodCase, AbsorbingSide) {
  const auto its = [](const std::string& more) {
    return *read(replaced(minimal, "friction = 0.3", "absorbing = true\nfrom = \"cut\"" + more))
                .boundaries[1]
                .absorbing;
  };
  EXPECT_EQ(its("").from, "cut");
  EXPECT_FALSE(its("").thickness || its("").impedance);
  EXPECT_EQ(its("\nthickness = 40").thickness, 40.0);
  EXPECT_EQ(its("\nimpedance = [600, 300]").impedance, (std::array<double, 2>{600, 300}));
}

// The keys that the minimal case leaves out.
TEST(GoodCase, OptionalKeys) {
  std::string text =
      replaced(minimal, "flip = 0.95",
               "flip = 1\nquadrature = \"points\"\nsafety = 1.0\ntolerance = 1e-6\nlargest_failures = 7\n"
               "largest_energy_error = 0.5\nleaving = \"remove\"");
  text = replaced(text, "spacing = 0.25", "spacing = 0.25\nvelocity = [1.0, -2.0]");
  text = replaced(text, "K0 = 0.6", "K0 = \"model\"");
  text = replaced(text, "hold = 0.1", "hold = 0.1, kinetic = 1e-5, rate = 1e-4, required = false");
  text = replaced(text, "duration = 1.5",
                  "duration = 1.5\nrelease = 1.5\nflip = 0.5\nzero_displacement = true\nzero_velocity = true");
  text = replaced(text, "[1.0, 2.0]] }", "[1.0, 2.0]], lifts = 3, over = 1.5 }");
  text = replaced(text, "every = 0.25", "every = 0.25\nhistory = 0.1\ncolour = \"R_b\"");
  const Case c = read(text);
  EXPECT_EQ(c.method.flip, 1.0);
  EXPECT_FALSE(c.method.corrected_quadrature);
  EXPECT_EQ(c.method.safety, 1.0);
  EXPECT_EQ(c.method.tolerance, 1e-6);
  EXPECT_EQ(c.method.largest_failures, 7);
  EXPECT_EQ(c.method.largest_energy_error, 0.5);
  EXPECT_TRUE(c.method.remove_leaving);
  EXPECT_EQ(c.regions[0].velocity, (Vec<2>{1.0, -2.0}));
  EXPECT_FALSE(c.regions[0].K0 || c.regions[0].stress);
  EXPECT_EQ(c.stages[0].rest->kinetic, 1e-5);
  EXPECT_EQ(c.stages[0].rest->rate, 1e-4);
  EXPECT_FALSE(c.stages[0].rest->required);
  EXPECT_EQ(c.stages[1].flip, 0.5);
  EXPECT_EQ(c.stages[1].release, 1.5);
  EXPECT_TRUE(c.stages[1].zero_displacement && c.stages[1].zero_velocity);
  EXPECT_EQ(c.stages[1].remove->lifts, 3);
  EXPECT_EQ(c.stages[1].remove->over, 1.5);
  EXPECT_EQ(c.output.history, 0.1);
  EXPECT_EQ(c.output.colour, "R_b");
}

TEST(GoodCase, LeavesOutWhatIsOptional) {
  std::string text = replaced(minimal, "title = \"two columns\"\ngravity = [0.0, -9.81]\n", "");
  text = replaced(text, "[method]\nflip = 0.95\n", "");
  text = replaced(text, "[output]\nevery = 0.25\n", "");
  text = replaced(text, "origin = [-1.0, 0.0], ", "");
  const CaseFile file(text);
  const Case c = read_case(file.path());
  EXPECT_EQ(c.title, file.path());
  EXPECT_EQ(c.gravity, (Vec<2>{0.0, -9.81}));
  EXPECT_EQ(c.mesh.grid->origin, (Vec<2>{0.0, 0.0}));
  EXPECT_EQ(c.method.flip, 1.0);
  EXPECT_EQ(c.output.every, 0.0);
}

TEST(GoodCase, GridTakesNumbersOfElementsOrTwoSizes) {
  for (const char* way : {"elements = [8, 2]", "element = [0.5, 1.0]"}) {
    const Case c = read(replaced(minimal, "element = 0.5", way));
    EXPECT_EQ(c.mesh.grid->elements, (std::array<int, 2>{8, 2})) << way;
  }
  // 0.3 / 0.1 is not 3 in doubles; it is within round-off.
  const Case c = read(replaced(minimal, "size = [4.0, 2.0], element = 0.5", "size = [0.3, 0.7], element = 0.1"));
  EXPECT_EQ(c.mesh.grid->elements, (std::array<int, 2>{3, 7}));
}

TEST(GoodCase, MeshFileIsRelativeToTheCase) {
  const CaseFile file("");
  const auto name = std::filesystem::path(file.path()).filename().string();
  file.write(replaced(minimal, "grid = { origin = [-1.0, 0.0], size = [4.0, 2.0], element = 0.5 }",
                      "file = \"" + name + "\""));  // it only has to be there
  const Case c = read_case(file.path());
  EXPECT_FALSE(c.mesh.grid);
  ASSERT_TRUE(c.mesh.file);
  EXPECT_TRUE(std::filesystem::equivalent(*c.mesh.file, file.path()));
}

// A uniform stress needs no gravity, and polygons may run either way around.
TEST(GoodCase, AnyGravityWithStresses) {
  std::string text = replaced(minimal, "gravity = [0.0, -9.81]", "gravity = [1.0, 0.0]");
  text = replaced(text, "K0 = 0.6", "stress = [5.0, 5.0, 5.0, 0.0]");
  text = replaced(text, "[[1.0, 0.0], [2.0, 0.0], [2.0, 1.0]]", "[[2.0, 1.0], [2.0, 0.0], [1.0, 0.0]]");
  EXPECT_EQ(read(text).gravity, (Vec<2>{1.0, 0.0}));
}

TEST(GoodCase, LettersOutsideAsciiInQuotesAndComments) {
  const std::string text =
      replaced(minimal, "title = \"two columns\"", "title = \"b\u00f6schung \u2264 \\\" 'x'\" # \u4e2d\u6587 \"");
  EXPECT_EQ(read(text).title, "b\u00f6schung \u2264 \" 'x'");
  EXPECT_EQ(read(replaced(minimal, "title = \"two columns\"", "title = '\u00f6\\'")).title, "\u00f6\\");
  EXPECT_EQ(read(replaced(minimal, "\"two columns\"", "\"\"\"\n\u00f6 \"\"\nend\"\"\"")).title, "\u00f6 \"\"\nend");
  EXPECT_EQ(read(replaced(minimal, "\"two columns\"", "\"\"\"two \u00f6\"\"\"\"")).title, "two \u00f6\"");
}

TEST(GoodCase, LineEndsOfWindows) {
  std::string text;
  for (const char c : minimal) text += c == '\n' ? "\r\n" : std::string(1, c);
  EXPECT_EQ(read(text).stages.size(), 2u);
}

}  // namespace
}  // namespace scarp::input::test
