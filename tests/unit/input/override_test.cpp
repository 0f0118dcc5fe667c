// --set key=value: each kind of value and of place, and what is refused. An error names the override, since the file
// does not hold the value.
#include <gtest/gtest.h>

#include "minimal.hpp"

namespace scarp::input::test {
namespace {

TEST(Override, ReplacesEachKindOfValue) {
  const Case c = read(minimal, {"title=\"three = columns\"", "gravity=[0.0, -1.62]", "method.flip=0.5",
                                "stage.rest.rest.required=false", "output.colour='R'",
                                "stage.cut.remove={ polygon = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]], lifts = 2 }"});
  EXPECT_EQ(c.title, "three = columns");
  EXPECT_EQ(c.gravity, (Vec<2>{0.0, -1.62}));
  EXPECT_EQ(c.method.flip, 0.5);
  EXPECT_FALSE(c.stages[0].rest->required);
  EXPECT_EQ(c.output.colour, "R");
  EXPECT_EQ(c.stages[1].remove->polygon, (Polygon{{0.0, 0.0}, {1.0, 0.0}, {0.0, 1.0}}));
  EXPECT_EQ(c.stages[1].remove->lifts, 2);
}

TEST(Override, FindsItemsByNameAndByNumber) {
  const Case c = read(minimal, {"stage.cut.duration=4", "stage.0.duration=5", "material.clay.c_b=10",
                                "boundary.1.friction=0.1", "region.right.polygon.2.1=0.75", "boundary.0.fix.1=x"});
  EXPECT_EQ(c.stages[0].duration, 5.0);
  EXPECT_EQ(c.stages[1].duration, 4.0);
  EXPECT_EQ(std::get<Subloading>(c.materials[1].model).parameters().c_b, 10.0);
  EXPECT_EQ(c.boundaries[1].friction, 0.1);
  EXPECT_EQ(c.regions[1].polygon[2], (Vec<2>{2.0, 0.75}));
  EXPECT_FALSE(c.boundaries[0].fix_y);
}

// A name that is a number beats the place of that number.
TEST(Override, NamesComeBeforeNumbers) {
  const std::string text = replaced(minimal, "name = \"cut\"", "name = \"0\"");
  const Case c = read(text, {"stage.0.duration=4"});
  EXPECT_EQ(c.stages[0].duration, 2.0);
  EXPECT_EQ(c.stages[1].duration, 4.0);
}

TEST(Override, AddsKeysAndTablesThatTheFileLeavesOut) {
  const std::string text = replaced(minimal, "[method]\nflip = 0.95\n", "");
  const Case c = read(text, {"method.safety=0.3", "stage.cut.rest.hold=0.5", "region.left.velocity=[1.0, 0.0]",
                             "stage.cut.zero_velocity=true"});
  EXPECT_EQ(c.method.safety, 0.3);
  ASSERT_TRUE(c.stages[1].rest);
  EXPECT_EQ(c.stages[1].rest->hold, 0.5);
  EXPECT_EQ(c.regions[0].velocity, (Vec<2>{1.0, 0.0}));
  EXPECT_TRUE(c.stages[1].zero_velocity);
}

TEST(Override, TakesBareWordsAsText) {
  EXPECT_EQ(read(minimal, {"output.colour=R_b"}).output.colour, "R_b");
  EXPECT_EQ(read(minimal, {"title=a word-or/two 2.5x"}).title, "a word-or/two 2.5x");
  EXPECT_FALSE(read(minimal, {"region.left.K0=model"}).regions[0].K0);
  EXPECT_EQ(read(minimal, {"region.right.material=clay", "region.right.initial={ R_b = 1.0, OCR = 1.0 }"})
                .regions[1]
                .material,
            1u);
}

// TOML knows none of these as numbers; they would be texts.
TEST(Override, TakesNumbersAsPeopleWriteThem) {
  EXPECT_EQ(read(minimal, {"method.flip=.5"}).method.flip, 0.5);
  EXPECT_EQ(read(minimal, {"stage.cut.duration=5."}).stages[1].duration, 5.0);
  EXPECT_EQ(read(minimal, {"gravity.1=-.5e1"}).gravity[1], -5.0);
  EXPECT_EQ(read(minimal, {"stage.cut.duration=+.25E+1"}).stages[1].duration, 2.5);
  EXPECT_EQ(read(minimal, {"stage.cut.remove.lifts=007"}).stages[1].remove->lifts, 7);
  // These are words.
  for (const std::string word : {".", "-", "e5", "1.2.3", "1e", "0x", "2.5x"})
    EXPECT_EQ(read(minimal, {"title=" + word}).title, word);
}

TEST(Override, LaterOnesSeeEarlierOnes) {
  EXPECT_EQ(read(minimal, {"method.flip=0.1", "method.flip=0.2"}).method.flip, 0.2);
  EXPECT_EQ(read(minimal, {"stage.cut.name=dig", "stage.dig.duration=9"}).stages[1].duration, 9.0);
}

// A bad file is mended before it is checked.
TEST(Override, MendsABadValue) {
  EXPECT_EQ(read(replaced(minimal, "flip = 0.95", "flip = 7"), {"method.flip=1"}).method.flip, 1.0);
}

struct Bad {
  std::string text, problem, value, remedy;
  bool in_file = false;  ///< clashes with another part of the file, which the error names instead
};

TEST(Override, RefusesWhatIsWrongAndNamesIt) {
  const std::vector<Bad> table = {
      {"stage.cut.duration", "has the form key=value", "stage.cut.duration", "for instance"},
      {"=4", "has the form key=value", "=4", "for instance"},
      {"", "has the form key=value", "\"\"", "for instance"},
      {"stage.dig.duration=4", "no item \"dig\"", "2 items: rest, cut", "a name or a number from 0"},
      {"stage.2.duration=4", "no item \"2\"", "2 items", "a name or a number from 0"},
      {"stage.-1.duration=4", "no item \"-1\"", "2 items", "a name or a number from 0"},
      {"stage.99999999999999999999.duration=4", "no item", "2 items", "a name or a number from 0"},
      {"stage..duration=4", "no item \"\"", "2 items", "a name or a number from 0"},
      {"boundary.2=4", "no item \"2\"", "2 items", "a name or a number from 0"},
      {"title.x=4", "\"title\" has no keys", "the text \"two columns\"", "name a key"},
      {"method..flip=1", "leads nowhere", "a table", "name a key"},
      {".flip=1", "leads nowhere", "a table", "name a key"},
      {"method.=1", "leads nowhere", "a table", "name a key"},
      {"method.flip=", "not TOML", "", "write a number"},
      {"method.flip=[1", "not TOML", "[1", "write a number"},
      {"method.flip=\"1", "not TOML", "\"1", "write a number"},
      {"title=b\u00f6schung", "not TOML", "b\u00f6schung", "a text in quotes"},
      {"method.flip=1.5", "0 <= flip <= 1", "1.5", "within these bounds"},
      {"method.flip=all", "flip is a number", "the text \"all\"", "without quotes"},
      {"method.flip=nan", "flip is finite", "nan", "finite"},
      {"method.flp=1", "[method] has no key flp", "1", "did you mean flip?"},
      {"metod.flip=1", "the case has no key metod", "a table", "did you mean method?"},
      {"stage=3", "stage is an array of tables", "the number 3", "double brackets"},
      {"stage.cut=3", "[[stage]] is a table", "the number 3", "keys and values"},
      {"stage=[]", "the case has no [[stage]]", "an empty list", "add at least one"},
      {"stage.cut.name=rest", "each [[stage]] has a name of its own", "\"rest\" twice", "rename", true},
      {"region.left.material=sand", "no such material", "\"sand\"", "\"rock\", \"clay\""},
      {"material.clay.kapa=1", "subloading has no constant kapa", "1", "scarp models subloading"},
      {"gravity.0=3", "gravity that does not point down", "[3, -9.81]", "a stress", true},
  };
  for (const auto& bad : table) {
    SCOPED_TRACE(bad.text);
    const CaseFile file(minimal);
    try {
      read_case(file.path(), {bad.text});
      ADD_FAILURE() << "no error";
    } catch (const InputError& error) {
      EXPECT_EQ(error.position().file, bad.in_file ? file.path() : "--set " + bad.text) << error.what();
      EXPECT_NE(error.problem().find(bad.problem), std::string::npos) << error.what();
      EXPECT_NE(error.value().find(bad.value), std::string::npos) << error.what();
      EXPECT_NE(error.remedy().find(bad.remedy), std::string::npos) << error.what();
    }
  }
}

// One override is one value: what follows on another line may not be dropped in silence.
TEST(Override, RefusesMoreThanOneValue) {
  EXPECT_THROW(read(minimal, {"method.flip=0.5\nsafety = 0.1"}), InputError);
}

}  // namespace
}  // namespace scarp::input::test
