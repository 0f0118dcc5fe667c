// Whole files, the table of a run and the collection of its frames. Oracles: the text of the files, read back by hand.
#include <cmath>
#include <limits>
#include <sstream>
#include <vector>

#include "files.hpp"
#include "scarp/base/error.hpp"
#include "scarp/io/file.hpp"
#include "scarp/io/history.hpp"
#include "scarp/io/pvd.hpp"

namespace scarp::io::test {
namespace {

using Writers = Files;

TEST_F(Writers, AFileIsThereWhenItIsWhole) {
  write_whole(path("a"), "old");
  {
    WholeFile file(path("a"));
    file.write("ne");
    EXPECT_EQ(content("a"), "old");
    file.write("w\0!", 3);
    EXPECT_EQ(content("a"), "old");
    file.finish();
    EXPECT_EQ(content("a"), std::string("new\0!", 5));
  }
  EXPECT_EQ(content("a"), std::string("new\0!", 5));
  EXPECT_FALSE(is_there("a.part"));
}

TEST_F(Writers, AFileThatIsNotFinishedLeavesTheOldOne) {
  write_whole(path("a"), "old");
  { WholeFile(path("a")).write("half"); }
  EXPECT_EQ(content("a"), "old");
  EXPECT_FALSE(is_there("a.part"));
}

template <class F>
void expect_cannot_be_written(const std::string& path, F&& f) {
  try {
    f();
    ADD_FAILURE() << "written";
  } catch (const RunError& error) {
    EXPECT_NE(error.problem().find(path), std::string::npos) << error.what();
    EXPECT_NE(error.problem().find("cannot be written"), std::string::npos) << error.what();
    EXPECT_FALSE(error.value().empty());
  }
}

TEST_F(Writers, SayWhatCannotBeWritten) {
  const auto nowhere = path("none/a"), folder = path("folder");
  expect_cannot_be_written(nowhere, [&] { write_whole(nowhere, "x"); });
  expect_cannot_be_written(nowhere, [&] { HistoryWriter(nowhere, std::vector<std::string>{"t"}); });
  std::filesystem::create_directories(folder + "/full");  // a folder has the name
  expect_cannot_be_written(folder, [&] { write_whole(folder, "x"); });
  EXPECT_FALSE(is_there("folder.part"));
}

TEST_F(Writers, ATableKeepsAllDigitsAndEveryRowAtOnce) {
  const std::vector<std::string> columns{"time", "energy", "steps"};
  const std::vector<std::vector<double>> rows{
      {0, 0.1, 1}, {1.0 / 3, -2.2250738585072014e-308, 1e300}, {std::nextafter(1.0, 2.0), 5e-324, 12345678901234.0}};
  HistoryWriter history(path("h.csv"), columns);
  EXPECT_EQ(content("h.csv"), "time,energy,steps\n");
  for (std::size_t r = 0; r < rows.size(); ++r) {
    history.row(rows[r]);
    std::istringstream text(content("h.csv"));
    std::string line;
    for (std::size_t skip = 0; skip < r + 2; ++skip) std::getline(text, line);
    std::istringstream cells(line);
    for (const double expected : rows[r]) {
      std::string cell;
      std::getline(cells, cell, ',');
      EXPECT_EQ(std::strtod(cell.c_str(), nullptr), expected) << cell;
    }
    EXPECT_FALSE(std::getline(text, line)) << "more than its rows";
  }
  EXPECT_THROW(history.row(std::vector<double>{1, 2}), RunError);
  EXPECT_THROW(history.row(std::vector<double>{1, 2, 3, 4}), RunError);
}

TEST_F(Writers, ACollectionIsWholeAfterEachFrame) {
  PvdWriter collection(path("points.pvd"));
  const std::string head =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"LittleEndian\">\n"
      "<Collection>\n";
  collection.add(0, "points_00000.vtu");
  collection.write();
  const std::string first = "<DataSet timestep=\"0\" part=\"0\" file=\"points_00000.vtu\"/>\n",
                    tail = "</Collection>\n</VTKFile>\n";
  EXPECT_EQ(content("points.pvd"), head + first + tail);
  collection.add(0.1, "points_00001.vtu");
  collection.write();
  EXPECT_EQ(content("points.pvd"),
            head + first + "<DataSet timestep=\"0.1\" part=\"0\" file=\"points_00001.vtu\"/>\n" + tail);
}

}  // namespace
}  // namespace scarp::io::test
