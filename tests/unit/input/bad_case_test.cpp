// Bad cases: each gives one InputError with its place, what is wrong, the value found and a remedy.
#include <gtest/gtest.h>

#include "refusal.hpp"

namespace scarp::input::test {
namespace {

TEST(BadCase, UnknownKeys) {
  expect_all_refused({
      {"every = 0.25", "@evry = 0.25", "[output] has no key evry", "0.25", "did you mean every?"},
      {"[output]", "@[ouput]", "the case has no key ouput", "a table", "did you mean output?"},
      {"every = 0.25", "@zzzzzzzz = true", "no key zzzzzzzz", "true",
       "its keys are checkpoint, colour, every, history"},
      {"flip = 0.95", "@safty = 0.4", "[method] has no key safty", "0.4", "did you mean safety?"},
      {"duration = 1.5", "duration = 1.5\n@dampng = 0.1", "[[stage]] has no key dampng", "0.1",
       "did you mean damping?"},
      {"K0 = 0.6", "k0 = 0.6", "a region has either K0", "neither", "write K0 = 0.6", "[[region]]\nname = \"left\""},
      {"hold = 0.1", "@holds = 0.1", "rest has no key holds", "0.1", "did you mean hold?"},
      {"[1.0, 2.0]] }", "[1.0, 2.0]], @lift = 2 }", "remove has no key lift", "2", "did you mean lifts?"},
      {"friction = 0.3", "@frction = 0.3", "[[boundary]] has no key frction", "0.3", "did you mean friction?"},
      {"element = 0.5", "element = 0.5, @orgin = [0, 0]", "grid has no key orgin", "a list", "did you mean origin?"},
      {"element = 0.5 }", "element = 0.5 }\n@fle = 1", "[mesh] has no key fle", "1", "did you mean file?"},
      {"spacing = 0.5", "spacing = 0.5\n@velocty = [0.0, 0.0]", "[[region]] has no key velocty", "", "velocity?"},
      {"kappa = 0.02", "kappa = 0.02\n@kapa = 0.02", "subloading has no constant kapa", "0.02", "scarp models subload"},
      {"OCR = 1.6", "@OCRR = 1.6", "subloading has no initial value OCRR", "1.6", "did you mean OCR?"},
      {"OCR = 1.6", "@zzzzzzzz = 1", "no initial value zzzzzzzz", "1", "its initial values are OCR"},
      {"spacing = 0.5", "spacing = 0.5\ninitial = { @OCR = 2 }", "no initial value OCR", "2", "leave initial out"},
  });
}

TEST(BadCase, SchemesAndConstantsThatAreNotTheirs) {
  expect_all_refused({
      {"flip = 0.95", "@scheme = \"flip\"", "scheme is \"two-term\", \"report\" or", "\"flip\"", "leave it out"},
      {"flip = 0.95", "@scheme = 2", "scheme is a text", "the number 2", "write it in quotes"},
      {"flip = 0.95", "scheme = \"report\"\n@pic_time = 0.5", "pic_time belongs to scheme = \"two-term\"", "0.5",
       "leave it out"},
      {"flip = 0.95", "scheme = \"apic\"\n@pic_time = 0.5", "pic_time belongs to", "0.5", "leave it out"},
      {"flip = 0.95", "scheme = \"report\"\n@stress_damping = 0.1", "stress_damping belongs to", "0.1", "leave it out"},
      {"flip = 0.95", "stress_damping = 0.1\n@stress_damping_time = 0.01", "by stress_damping or by", "both",
       "leave one of them out"},
      {"flip = 0.95", "@stress_damping = -0.1", "0 <= stress_damping", "-0.1", "within these bounds"},
      {"flip = 0.95", "@stress_damping_time = 0", "stress_damping_time", "0", "within these bounds"},
      {"flip = 0.95", "@pic_time = 0", "pic_time", "0", "within these bounds"},
  });
}

TEST(BadCase, LengthsWithoutSofteningOverThem) {
  expect_all_refused({
      {"density = 1.8", "density = 1.8\n@length = -0.5", "length", "-0.5", ""},
      {"density = 1.8", "density = 1.8\n@length = \"long\"", "length is a number", "the text \"long\"",
       "without quotes"},
      {"density = 1.8", "density = 1.8\n@length = [0.5]", "length is a number", "a list", ""},
      {"density = 1.8", "density = 1.8\n@lenght = 0.5", "no constant lenght", "0.5", "scarp models"},
      {"density = 2.2", "density = 2.2\n@length = 1.5", "linear-elastic has no softening", "length = 1.5",
       "leave length out"},
      {"c_b = 20.0", "c_b = 0.0\n@length = 1.5", "these constants leave nothing to", "length = 1.5", "c_b > 0"},
  });
}

TEST(BadCase, WrongTypes) {
  expect_all_refused({
      {"title = \"two columns\"", "@title = 3", "title is a text", "the number 3", "write it in quotes"},
      {"title = \"two columns\"", "@title = \"\"", "title is not empty", "\"\"", "give it a name"},
      {"flip = 0.95", "@flip = \"all\"", "flip is a number", "the text \"all\"", "without quotes"},
      {"flip = 0.95", "@flip = true", "flip is a number", "true", "write a number"},
      {"flip = 0.95", "@flip = [1]", "flip is a number", "a list", "write a number"},
      {"flip = 0.95", "@quadrature = 3", "quadrature is a text", "the number 3", "write it in quotes"},
      {"flip = 0.95", "@quadrature = \"exact\"", "quadrature is", "\"exact\"", "makes it exact"},
      {"flip = 0.95", "@shape = \"cubic\"", "shape is \"linear\", \"gimp\" or", "\"cubic\"", "on grids"},
      {"flip = 0.95", "@leaving = \"ignore\"", "leaving is \"error\" or \"remove\"", "\"ignore\"", "choose"},
      {"flip = 0.95", "@largest_failures = 2.0", "is a whole number", "the number 2", "without a decimal point"},
      {"gravity = [0.0, -9.81]", "@gravity = -9.81", "gravity is a list of 2 numbers", "-9.81", "in brackets"},
      {"gravity = [0.0, -9.81]", "@gravity = [0, 0, 9]", "gravity is a list of 2 numbers", "3 items", "in brackets"},
      {"gravity = [0.0, -9.81]", "gravity = [0.0, @\"g\"]", "gravity is a number", "the text \"g\"", "without quotes"},
      {"[output]\nevery = 0.25\n", "[[output]]\nevery = 0.25\n", "[output] is a table", "a list", "keys and values",
       "output]]"},
      {"kappa = 0.02", "@kappa = \"small\"", "kappa is a number", "the text \"small\"", "without quotes"},
      {"density = 1.8", "@density = true", "density is a number", "true", "write a number"},
      {"model = \"subloading\"", "@model = 3", "model is a text", "the number 3", "in quotes"},
      {"K0 = 0.6", "@K0 = \"soil\"", "K0 is a number or \"model\"", "the text \"soil\"", "write K0 = 0.6"},
      {"K0 = 0.6", "@K0 = true", "K0 is a number", "true", "write a number"},
      {"stress = [1.0, 2.0, 3.0, 0.5]", "@stress = [1.0, 2.0]", "a list of 4 numbers", "2 items", "in brackets"},
      {"OCR = 1.6", "@OCR = false", "OCR is a number, a text or a list", "false", "scarp models"},
      {"OCR = 1.6", "OCR = [1.6, @true]", "OCR is a number", "true", "write a number"},
      {"every = 0.25", "every = 0.25\n@colour = 3", "colour is a text", "3", "in quotes"},
      {"duration = 1.5", "duration = 1.5\n@zero_velocity = 1", "zero_velocity is true or false", "1", "true or false"},
      {"remove = { polygon = [[0.5, 0.5], [1.0, 0.5], [1.0, 2.0]] }", "@remove = 3", "remove is a table", "3", "keys"},
      {"[0.5, 0.5], [1.0, 0.5], [1.0, 2.0]] }", "[0.5, 0.5], [1.0, 0.5], [1.0, 2.0]], @lifts = 1.5 }",
       "lifts is a whole number", "1.5", "decimal point"},
      {"rest = { unbalanced = 1e-2, hold = 0.1 }", "@rest = true", "rest is a table", "true", "keys and values"},
      {"fix = [\"x\", \"y\"]", "@fix = \"x\"", "fix is a list of components", "the text \"x\"", "write fix"},
      {"fix = [\"x\", \"y\"]", "@fix = []", "fix is a list of components", "an empty list", "write fix"},
      {"fix = [\"x\", \"y\"]", "fix = [\"x\", @\"z\"]", "is \"x\" or \"y\"", "the text \"z\"", "write fix"},
      {"fix = [\"x\", \"y\"]", "fix = [\"x\", @1]", "a component of fix is a text", "the number 1", "in quotes"},
      {"nodes = \"bottom\"", "@nodes = 3", "nodes is a text", "the number 3", "in quotes"},
      {"polygon = [[1.0, 0.0], [2.0, 0.0], [2.0, 1.0]]", "@polygon = 1", "at least 3 corners", "the number 1",
       "for ins"},
      {"polygon = [[1.0, 0.0], [2.0, 0.0], [2.0, 1.0]]", "@polygon = [[1.0, 0.0], [2.0, 0.0]]", "at least 3 corners",
       "2 corners", "for instance"},
      {"[2.0, 0.0], [2.0, 1.0]", "[2.0, 0.0], @[2.0]", "a corner is a list of 2 numbers", "1 item", "in brackets"},
      {"[2.0, 0.0], [2.0, 1.0]", "@5, [2.0, 1.0]", "a corner is a list of 2 numbers", "the number 5", "in brackets"},
      {"title = \"two columns\"", "title = @1979-05-27", "dates and times have no place", "",
       "write a number or a text"},
  });
}

TEST(BadCase, MissingKeys) {
  const std::string mesh = "[mesh]", grid = "{ origin", rock = "[[material]]\nname = \"rock\"";
  const std::string left = "[[region]]\nname = \"left\"", right = "[[region]]\nname = \"right\"";
  const std::string bottom = "[[boundary]]\nnodes", cut = "[[stage]]\nname = \"cut\"";
  expect_all_refused({
      {"[mesh]\ngrid = { origin = [-1.0, 0.0], size = [4.0, 2.0], element = 0.5 }", "@[mesh]", "either a file",
       "neither", "write file"},
      {"element = 0.5 }", "element = 0.5 }\nfile = \"a.msh\"", "either a file", "both", "write file", mesh},
      {"{ origin = [-1.0, 0.0], size = [4.0, 2.0], element", "@{ element", "grid lacks the key size", "", "size = ["},
      {", element = 0.5", "", "a grid has either element", "neither", "write element", grid},
      {"element = 0.5", "element = 0.5, elements = [8, 4]", "a grid has either element", "both", "write element", grid},
      {rock, "@[[material]]", "[[material]] lacks the key name", "", "add name"},
      {"model = \"linear-elastic\"", "", "lacks the key model", "", "scarp models", rock},
      {"density = 2.2", "", "lacks the key density", "", "density =", rock},
      {"nu = 0.25\n", "", "nu (Poisson's ratio) of the model linear-elastic is missing", "", "add nu = ..., with",
       rock},
      {left, "@[[region]]", "[[region]] lacks the key name", "", "add name"},
      {"material = \"clay\"", "", "lacks the key material", "", "the name of a [[material]]", left},
      {"polygon = [[1.0, 0.0], [2.0, 0.0], [2.0, 1.0]]", "", "lacks the key polygon", "", "add the corners", right},
      {"spacing = 0.25\n", "", "lacks the key spacing", "", "add the distance", left},
      {"K0 = 0.6\n", "", "either K0", "neither", "write K0", left},
      {"K0 = 0.6", "K0 = 0.6\nstress = [1.0, 1.0, 1.0, 0.0]", "either K0", "both", "write K0", left},
      {"[[boundary]]\nnodes = \"bottom\"", "@[[boundary]]", "a boundary has either nodes", "neither", "write nodes"},
      {"nodes = \"bottom\"", "nodes = \"bottom\"\nline = [[0.0, 0.0], [1.0, 0.0]]", "a boundary has either nodes",
       "both", "write nodes", bottom},
      {"fix = [\"x\", \"y\"]\n", "", "[[boundary]] lacks the key fix", "", "write fix", bottom},
      {cut, "@[[stage]]", "[[stage]] lacks the key name", "", "add name"},
      {"duration = 1.5\n", "", "[[stage]] lacks the key duration", "", "add the time", cut},
      {"{ polygon = [[0.5, 0.5], [1.0, 0.5], [1.0, 2.0]] }", "@{ lifts = 2 }", "remove lacks the key polygon", "",
       "corners"},
  });
}

TEST(BadCase, AbsorbingSides) {
  const std::string left = "friction = 0.3";  // of the minimal case's second boundary
  expect_all_refused({
      {left, "@absorbing = false", "absorbing is true", "false", "write absorbing = true"},
      {left, "absorbing = true", "from", "", "name of the stage", "[[boundary]]\nline"},
      {left, "friction = 0.3\n@absorbing = true\nfrom = \"cut\"", "no wall with friction", "both", "leave one"},
      {left, "absorbing = true\n@from = \"shake\"", "no stage has this name", "\"shake\"", "[[stage]]"},
      {left, "absorbing = true\n@from = \"rest\"", "fixed for a stage before", "the first stage", "a stage with rest"},
      {left, "absorbing = true\nfrom = \"cut\"\n@thickness = -1", "0 <= thickness", "-1", "within these bounds"},
      {left, "absorbing = true\nfrom = \"cut\"\n@impedance = [1.0, 0.0]", "above zero", "[1, 0]", "density times"},
  });
}

TEST(BadCase, OutOfBounds) {
  expect_all_refused({
      {"flip = 0.95", "@flip = 1.01", "flip must satisfy 0 <= flip <= 1", "1.01", "within these bounds"},
      {"flip = 0.95", "@flip = -0.01", "0 <= flip <= 1", "-0.01", "within these bounds"},
      {"flip = 0.95", "@safety = 0", "0 < safety <= 1", "0", "within these bounds"},
      {"flip = 0.95", "@safety = 1.5", "0 < safety <= 1", "1.5", "within these bounds"},
      {"flip = 0.95", "@tolerance = 0.2", "tolerance <= 0.1", "0.2", "within these bounds"},
      {"flip = 0.95", "@largest_failures = -1", "0 <= largest_failures", "-1", "within these bounds"},
      {"flip = 0.95", "@largest_energy_error = -1", "0 <= largest_energy_error", "-1", "within these bounds"},
      {"duration = 1.5", "duration = 1.5\n@release = 1.6", "release <= 1.5", "1.6", "within these bounds"},
      {"hold = 0.1", "@rate = 0", "0 < rate", "0", "within these bounds"},
      {"damping = 0.7", "@damping = 1", "0 <= damping < 1", "1", "within these bounds"},
      {"damping = 0.7", "@damping = -0.1", "0 <= damping < 1", "-0.1", "within these bounds"},
      {"damping = 0.7", "@flip = 2", "0 <= flip <= 1", "2", "within these bounds"},
      {"duration = 1.5", "@duration = 0", "0 < duration", "0", "within these bounds"},
      {"duration = 1.5", "@duration = -3.5", "0 < duration", "-3.5", "within these bounds"},
      {"density = 1.8", "@density = 0.0", "0 < density", "0", "within these bounds"},
      {"spacing = 0.25", "@spacing = -0.25", "0 < spacing", "-0.25", "within these bounds"},
      {"K0 = 0.6", "@K0 = -0.1", "0 <= K0", "-0.1", "within these bounds"},
      {"friction = 0.3", "@friction = -0.3", "0 <= friction", "-0.3", "within these bounds"},
      {"every = 0.25", "@every = -1", "0 <= every", "-1", "within these bounds"},
      {"every = 0.25", "@history = -1", "0 <= history", "-1", "within these bounds"},
      {"unbalanced = 1e-2", "@unbalanced = 0", "0 < unbalanced", "0", "within these bounds"},
      {"hold = 0.1", "@hold = -0.1", "0 <= hold", "-0.1", "within these bounds"},
      {"hold = 0.1", "@kinetic = 0", "0 < kinetic", "0", "within these bounds"},
      {"[1.0, 2.0]] }", "[1.0, 2.0]], @lifts = 0 }", "1 <= lifts", "0", "within these bounds"},
      {"[1.0, 2.0]] }", "[1.0, 2.0]], @over = 1.6 }", "0 <= over <= 1.5", "1.6", "within these bounds"},
      {"nu = 0.25", "@nu = 0.5", "nu must satisfy -1 < nu < 0.5", "0.5", "Poisson's ratio"},
      {"E = 1e4", "@E = 0", "E must satisfy 0 < E", "0", "Young's modulus"},
      {"kappa = 0.02", "@kappa = 0.2", "kappa is less than lambda", "kappa = 0.2, lambda = 0.12", "smaller"},
      {"R_bf = 1.0", "@R_bf = 0.9", "R_bf must satisfy 1 <= R_bf", "0.9", "bonding factor"},
      {"size = [4.0, 2.0]", "@size = [4.0, 0.0]", "0 < size", "0", "within these bounds"},
      {"element = 0.5", "@element = 0.3", "whole multiple of the element", "4 / 0.3", "take element ="},
      {"element = 0.5", "@element = 9.0", "whole multiple of the element", "4 / 9", "take element = 4"},
      {"element = 0.5", "@element = [0.5, -1.0]", "0 < element", "-1", "within these bounds"},
      {"element = 0.5", "@element = 1e-12", "the grid has too many elements", "along x", "larger elements"},
      {"element = 0.5", "@elements = [0, 4]", "at least 1", "0", "write elements"},
      {"element = 0.5", "@elements = [1.5, 4]", "two whole numbers", "1.5", "write elements"},
      {"element = 0.5", "@elements = [1e30, 4]", "two whole numbers", "1e+30", "write elements"},
  });
}

TEST(BadCase, NotFinite) {
  expect_all_refused({
      {"flip = 0.95", "@flip = nan", "flip is finite", "nan", "finite number"},
      {"duration = 1.5", "@duration = inf", "duration is finite", "inf", "finite number"},
      {"density = 1.8", "@density = inf", "density is finite", "inf", "finite number"},
      {"kappa = 0.02", "@kappa = nan", "kappa is finite", "nan", "elastic"},
      {"E = 1e4", "@E = -inf", "E is finite", "-inf", "Young's modulus"},
      {"gravity = [0.0, -9.81]", "gravity = [0.0, @-inf]", "gravity is finite", "-inf", "finite number"},
      {"[2.0, 0.0], [2.0, 1.0]", "[2.0, 0.0], [@nan, 1.0]", "a corner is finite", "nan", "finite number"},
      {"OCR = 1.6", "@OCR = nan", "OCR is finite", "nan", "finite number"},
      {"K0 = 0.6", "@K0 = nan", "K0 is finite", "nan", "finite number"},
      {"stress = [1.0, 2.0, 3.0, 0.5]", "stress = [1.0, 2.0, @inf, 0.5]", "stress is finite", "inf", "finite number"},
      {"line = [[-1.0, 0.0], [-1.0, 2.0]]", "line = [[-1.0, 0.0], [-1.0, @nan]]", "a point is finite", "nan", "finite"},
      {"element = 0.5", "@element = nan", "element is finite", "nan", "finite number"},
      {"element = 0.5", "elements = [8, @inf]", "elements is finite", "inf", "finite number"},
  });
}

// The place is the corner where the second of the two edges starts.
TEST(BadCase, Polygons) {
  const std::string corners = "[[0.0, 0.0], [1.0, 0.0], [1.0, 2.0], [0.0, 2.0]]";
  expect_all_refused({
      {corners, "[[0.0, 0.0], [1.0, 0.0], [0.0, 2.0], @[1.0, 2.0]]", "does not cross or touch itself",
       "(1, 0)-(0, 2) and (1, 2)-(0, 0)", "in order around"},
      {corners, "[[0.0, 0.0], [1.0, 0.0], [1.0, 2.0], @[0.0, 2.0], [0.0, 0.0]]", "does not cross or touch itself",
       "meet", "without repeating the first"},
      {corners, "[[0.0, 0.0], @[0.0, 0.0], [1.0, 2.0], [0.0, 2.0]]", "does not cross or touch itself", "meet",
       "each once"},
      {corners, "[[0.0, 0.0], @[1.0, 0.0], [0.5, 0.0], [0.0, 2.0]]", "does not cross or touch itself", "meet",
       "in order"},
      {corners, "[[0.0, 0.0], [1.0, 1.0], @[2.0, 2.0]]", "does not cross or touch itself", "meet", "in order"},
      {"[0.5, 0.5], [1.0, 0.5], [1.0, 2.0]]", "[0.5, 0.5], [1.0, 2.0], @[1.0, 0.5], [0.6, 2.0]]",
       "the polygon of remove", "meet", "in order"},
  });
}

TEST(BadCase, NamesAndReferences) {
  const std::string left = "[[region]]\nname = \"left\"";
  expect_all_refused({
      {"[[material]]\nname = \"clay\"", "@[[material]]\nname = \"rock\"", "each [[material]] has a name of its own",
       "\"rock\" twice", "rename"},
      {"[[region]]\nname = \"right\"", "@[[region]]\nname = \"left\"", "each [[region]] has a name of its own",
       "\"left\"", "rename"},
      {"[[stage]]\nname = \"cut\"", "@[[stage]]\nname = \"rest\"", "each [[stage]] has a name of its own", "\"rest\"",
       "rename"},
      {"material = \"rock\"", "@material = \"sand\"", "there is no such material", "\"sand\"", "\"rock\", \"clay\""},
      {"model = \"subloading\"", "@model = \"subloding\"", "there is no such model", "\"subloding\"",
       "linear-elastic, subloading"},
      {"grid = { origin = [-1.0, 0.0], size = [4.0, 2.0], element = 0.5 }", "@file = \"not_there.msh\"",
       "the mesh file is not there", "not_there.msh", "relative to the case file's folder"},
      {"line = [[-1.0, 0.0], [-1.0, 2.0]]", "@line = [[-1.0, 0.0]]", "a list of two points", "a list", "write line"},
      {"line = [[-1.0, 0.0], [-1.0, 2.0]]", "@line = [[-1.0, 0.0], [-1.0, 0.0]]", "differ", "the same point",
       "two ends"},
      {"fix = [\"x\"]\nfriction = 0.3", "fix = [\"x\", \"y\"]\n@friction = 0.3", "fixes one component", "both",
       "only the"},
      {"gravity = [0.0, -9.81]", "gravity = [0.5, -9.81]", "gravity that does not point down", "[0.5, -9.81]",
       "a stress", left},
      {"gravity = [0.0, -9.81]", "gravity = [0.0, 9.81]", "gravity that does not point down", "[0, 9.81]", "a stress",
       left},
  });
}

TEST(BadCase, TablesThatClash) {
  expect_all_refused({
      {"[output]", "@[region.x]", "[[region]] has no key x", "a table", "its keys are"},
      {"title = \"two columns\"", "stage = 3", "this is not TOML", "", "toml.io", "[[stage]]\nname = \"rest\""},
      {"title = \"two columns\"", "mesh = 3", "this is not TOML", "", "toml.io", "[mesh]"},
  });
}

/// Line of the error for a whole text.
void expect_not_toml(const std::string& from, const std::string& to, int lines_after = 0) {
  SCOPED_TRACE(to);
  const std::string text = replaced(minimal, from, to);
  const int line = place_of(text, text.rfind(to)).line;
  try {
    read(text);
    ADD_FAILURE() << "no error";
  } catch (const InputError& error) {
    EXPECT_NE(error.problem().find("this is not TOML: "), std::string::npos) << error.what();
    EXPECT_GE(error.position().line, line) << error.what();
    EXPECT_LE(error.position().line, line + lines_after) << error.what();
    EXPECT_GT(error.position().column, 0) << error.what();
    EXPECT_NE(error.remedy().find("toml.io"), std::string::npos) << error.what();
  }
}

// The column is the parser's own; the line is that of the damage, or of where a bracket or quote must have closed.
TEST(BadCase, BrokenSyntax) {
  expect_not_toml("flip = 0.95", "flip = ");
  expect_not_toml("flip = 0.95", "flip 0.95");
  expect_not_toml("flip = 0.95", "flip = 0.95 0.9");
  expect_not_toml("flip = 0.95", "flip = 0,95");
  expect_not_toml("flip = 0.95", "flip = 1\nflip = 1", 1);  // the second
  expect_not_toml("[method]", "[method");
  expect_not_toml("[method]", "[]");
  expect_not_toml("[output]", "[method]");  // twice
  expect_not_toml("\"two columns\"", "\"two columns");
  expect_not_toml("\"two columns\"", "two columns");
  expect_not_toml("\"two columns\"", "\"two \\q columns\"");
  expect_not_toml("\"two columns\"", std::string("\"two \x01 columns\""));
  expect_not_toml("\"two columns\"", std::string("\"two \xff columns\""));
  expect_not_toml("\"two columns\"", "99999999999999999999");
  expect_not_toml("gravity = [0.0, -9.81]", "gravity = [0.0, -9.81", 2);  // where the next table starts
}

std::string title_of(const std::string& title) {
  return read(replaced(minimal, "\"two columns\"", title)).title;
}

// toml++ 3.3.0 looks for white space of Unicode there, in a switch that reaches the unreachable for U+FFBE.
TEST(BadCase, QuotesInTheMiddleOfWords) {
  const std::string problem = "a text in quotes begins where a key or value does";
  expect_all_refused({
      {"every = 0.25", "every = 10-@'\uffbe0", problem, "a quote in a word", "take the quote away"},
      {"every = 0.25", "every@\"\" = 0.25", problem, "a quote in a word", "take the quote away"},
  });
  EXPECT_EQ(title_of("\"two columns\""), "two columns");
  EXPECT_EQ(title_of("'''two'''''"), "two''") << "TOML: two quotes may stand before the last three";
}

TEST(BadCase, LettersOutsideAsciiOutsideQuotes) {
  const std::string remedy = "put the key or value in quotes";
  const std::string problem = "letters outside ASCII stand in quotes or comments only";
  expect_all_refused({
      {"every = 0.25", "@\u00e9very = 0.25", problem, "", remedy},
      {"every = 0.25",
       "every = @\u2212"
       "0.25",
       problem, "", remedy},
      {"every = 0.25", "every = 0.25@\u00a0", problem, "", remedy},
      {"[output]", "[\"\u00fc\"@\u00fctput]", problem, "", remedy},
      {"title = \"two columns\"", "title = \"\\\"\u00e9\" @\u00e9", problem, "", remedy},
      {"title = \"two columns\"", "title = '\u00e9\\' @\u00e9", problem, "", remedy},
      {"title = \"two columns\"", "title = \"\"\"\n\u00e9 \" \n\"\"\" @\u00e9 # \u00e9", problem, "", remedy},
  });
}

/// What is wrong with a text as a whole.
void expect_whole(const std::string& text, const std::string& problem) {
  SCOPED_TRACE(problem);
  const CaseFile file(text);
  try {
    read_case(file.path());
    ADD_FAILURE() << "no error";
  } catch (const InputError& error) {
    EXPECT_EQ(error.position().file, file.path());
    EXPECT_NE(error.problem().find(problem), std::string::npos) << error.what();
    EXPECT_FALSE(error.remedy().empty());
  }
}

TEST(BadCase, WholeFiles) {
  const std::string head = "[mesh]\ngrid = { size = [1.0, 1.0], element = 1.0 }\n";
  expect_whole("", "lacks the key mesh");
  expect_whole("# nothing\n", "lacks the key mesh");
  expect_whole(head, "the case has no [[material]]");
  expect_whole(head + "material = []\n", "[mesh] has no key material");  // inside [mesh]
  expect_whole("material = []\n" + head, "the case has no [[material]]");
  expect_whole("material = 3\n" + head, "material is an array of tables");
  expect_whole(head + "[material]\nname = \"a\"\n", "material is an array of tables");
  expect_whole("material = [3]\n" + head, "[[material]] is a table");
  const std::string material = "[[material]]\nname = \"a\"\nmodel = \"linear-elastic\"\ndensity = 1\nE = 1\nnu = 0\n";
  expect_whole(head + material, "the case has no [[region]]");
  const std::string region =
      "[[region]]\nname = \"r\"\nmaterial = \"a\"\npolygon = [[0, 0], [1, 0], [0, 1]]\nspacing = 1\nK0 = 1\n";
  expect_whole(head + material + region, "the case has no [[stage]]");
  EXPECT_TRUE(read(head + material + region + "[[stage]]\nname = \"s\"\nduration = 1\n").boundaries.empty());
}

TEST(BadCase, FilesThatCannotBeRead) {
  const std::string folder = testing::TempDir();
  EXPECT_THROW(read_case(folder + "scarp_input_no_such_case.toml"), InputError);
  EXPECT_THROW(read_case(folder), InputError) << "a folder";
  EXPECT_THROW(read_case(""), InputError);
}

TEST(BadCase, MeshNamesThatNoFileCanHave) {
  const std::string grid = "grid = { origin = [-1.0, 0.0], size = [4.0, 2.0], element = 0.5 }";
  // Longer than file systems allow.
  expect_all_refused({{grid, "@file = \"" + std::string(5000, 'm') + "\"", "the mesh file", "", "case file's folder"}});
}

}  // namespace
}  // namespace scarp::input::test
