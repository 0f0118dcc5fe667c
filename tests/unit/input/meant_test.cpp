// Slips of the pen and keys in the wrong table: the answer names what was meant, or where it belongs.
#include <gtest/gtest.h>

#include "refusal.hpp"

namespace scarp::input::test {
namespace {

TEST(Meant, KeysOfAnotherTable) {
  expect_all_refused({
      {"every = 0.25", "every = 0.25\n@damping = 0.5", "[output] has no key damping", "0.5", "a key of [[stage]]"},
      {"every = 0.25", "every = 0.25\n@flip = 1", "[output] has no key flip", "1", "[method], and of a [[stage]]"},
      {"spacing = 0.5", "spacing = 0.5\n@density = 2", "[[region]] has no key density", "2", "key of [[material]]"},
      {"spacing = 0.5", "spacing = 0.5\n@OCR = 2", "[[region]] has no key OCR", "2",
       "initial = { ... } in a [[region]]"},
      {"spacing = 0.5", "spacing = 0.5\n@M_c = 2", "[[region]] has no key M_c", "2", "[[material]] (of subloading"},
      {"density = 2.2", "density = 2.2\n@spacing = 0.5", "no constant spacing", "0.5", "a key of [[region]]"},
      {"density = 2.2", "density = 2.2\n@K0 = \"model\"", "no constant K0", "\"model\"", "a key of [[region]]"},
      {"density = 2.2", "density = 2.2\n@kappa = 0.1", "linear-elastic has no constant kappa", "0.1", "(of subloading"},
      {"OCR = 1.6", "OCR = 1.6, @c_b = 1.0", "no initial value c_b", "1", "a key of [[material]] (of subloading"},
      {"[mesh]", "[mesh]\n@element = 0.5", "[mesh] has no key element", "0.5", "grid = { ... } in [mesh]"},
      {"friction = 0.3", "@thickness = 3.0", "[[boundary]] has no key thickness", "3", "with absorbing = true"},
      {"[mesh]", "[mesh]\n@gravity = [0, -1]", "[mesh] has no key gravity", "a list", "above its tables"},
      {"duration = 2.0", "duration = 2.0\n@hold = 1.0", "[[stage]] has no key hold", "1", "rest = { ... } in a"},
  });
}

TEST(Meant, ModelsAndConstantsMisspelt) {
  expect_all_refused({
      {"model = \"subloading\"", "@model = \"subloding\"", "no such model", "\"subloding\"",
       "did you mean subloading?"},
      {"model = \"linear-elastic\"", "@model = \"Linear elastic\"", "no such model", "",
       "did you mean linear-elastic?"},
      {"model = \"linear-elastic\"", "@model = \"Mohr-Columb\"", "no such model", "", "did you mean mohr-coulomb?"},
      {"lambda = 0.12", "lambda = 0.12\n@lamda = 0.1", "no constant lamda", "0.1", "did you mean lambda?"},
      {"nu = 0.25", "@nu = 0.6", "nu must satisfy", "0.6", "choose a number with -1 < nu < 0.5"},
  });
}

}  // namespace
}  // namespace scarp::input::test
