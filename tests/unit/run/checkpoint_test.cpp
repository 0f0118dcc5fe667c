// Checkpoint files: their seal, their names, and that docs/checkpoint.md names all that is in them. That a run goes on
// from them as if it had not stopped: tests/regression/resume_test.py and tests/faults.
#include "scarp/run/checkpoint.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <regex>
#include <set>
#include <string>

#include "scarp/base/error.hpp"
#include "scarp/base/hash.hpp"
#include "scarp/io/file.hpp"
#include "scarp/run/run.hpp"

namespace scarp::run::test {
namespace {

namespace fs = std::filesystem;

/// A folder that is gone after the test.
class Checkpoints : public testing::Test {
 protected:
  Checkpoints() : folder_(fs::path(testing::TempDir()) / ("scarp_checkpoints_" + std::to_string(getpid()))) {
    fs::create_directories(folder_);
  }
  ~Checkpoints() override {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }
  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  /// A file with a head alone.
  std::string written(const std::string& name, int format = CheckpointHead::current_format) const {
    io::Hdf5Image image;
    CheckpointHead head;
    head.format = format;
    head.title = "a column";
    head.steps = 7;
    head.files = {{"a.msh", "0123"}};
    save_head(Saver(image, "scarp"), head);
    const auto bytes = image.finish();
    const std::string content(static_cast<const char*>(bytes.data.get()), bytes.size);
    io::write_whole(path(name), content + seal_of(content.data(), content.size()));
    return path(name);
  }

  fs::path folder_;
};

std::string what_of(const std::string& path, bool edited = false) {
  try {
    const CheckpointFile file(path, edited);
    return "";
  } catch (const InputError& error) {
    return error.what();
  }
}

TEST_F(Checkpoints, TheHeadIsRead) {
  const CheckpointFile file(written("a.h5"));
  EXPECT_EQ(file.head().title, "a column");
  EXPECT_EQ(file.head().steps, 7);
  ASSERT_EQ(file.head().files.size(), 1u);
  EXPECT_EQ(file.head().files[0].path, "a.msh");
  EXPECT_FALSE(file.changed());
}

TEST_F(Checkpoints, AnyChangedByteIsFound) {
  const std::string whole = io::read_whole(written("a.h5"));
  for (std::size_t at = 0; at < whole.size(); at += 97) {
    auto changed = whole;
    changed[at] = static_cast<char>(changed[at] ^ 4);
    io::write_whole(path("b.h5"), changed);
    EXPECT_NE(what_of(path("b.h5")), "") << at;
  }
  for (const std::size_t size : {std::size_t{0}, std::size_t{5}, whole.size() / 2, whole.size() - 1}) {
    io::write_whole(path("b.h5"), whole.substr(0, size));
    EXPECT_NE(what_of(path("b.h5")).find("the checkpoint has no seal"), std::string::npos) << size;
  }
}

TEST_F(Checkpoints, WithoutItsSealAFileIsOneThatWasEdited) {
  const std::string whole = io::read_whole(written("a.h5")), seal = seal_of("", 0);
  io::write_whole(path("b.h5"), whole.substr(0, whole.size() - seal.size()));
  EXPECT_NE(what_of(path("b.h5")).find("--edited"), std::string::npos);
  EXPECT_EQ(what_of(path("b.h5"), true), "");
  EXPECT_TRUE(CheckpointFile(path("b.h5"), true).changed());
}

TEST_F(Checkpoints, AnotherFormatIsNamed) {
  EXPECT_NE(what_of(written("a.h5", 2)).find("format 2 in"), std::string::npos);
}

TEST_F(Checkpoints, TheLatestComesFirst) {
  EXPECT_TRUE(checkpoints_in(path("nosuch")).empty());
  for (const auto& name : {checkpoint_name(20), checkpoint_name(3), stage_checkpoint_name(20, 1),
                           stage_checkpoint_name(12, 0), std::string("checkpoint_x.h5"), std::string("failed.h5"),
                           std::string("stage_0_at_.h5"), std::string("checkpoint_0000000021.h5.part")})
    io::write_whole(path(name), "");
  std::vector<std::string> names;
  for (const auto& its : checkpoints_in(folder_.string())) names.push_back(its.name);
  EXPECT_EQ(names, (std::vector<std::string>{"stage_1_at_0000000020.h5", "checkpoint_0000000020.h5",
                                             "stage_0_at_0000000012.h5", "checkpoint_0000000003.h5"}));
}

TEST(Hash, IsThatOfXxh128sum) {
  // xxh128sum of Debian's xxhash 0.8.1
  EXPECT_EQ(hash_of("", 0), "99aa06d3014798d86001c324468d497f");
  Hash pieces;
  pieces.add("sc", 2);
  pieces.add("arp", 3);
  EXPECT_EQ(pieces.digits(), hash_of("scarp", 5));
}

TEST_F(Checkpoints, ThePageNamesAllThatIsInThem) {
  io::write_whole(path("case.toml"), R"(
mesh = { grid = { size = [2, 4], element = 0.5 } }
method = { scheme = "apic" }
output = { checkpoint = { steps = 3, keep = 100 } }
material = [{ name = "clay", model = "mohr-coulomb", density = 1.8, E = 1e4, nu = 0.3, c = 5, phi = 20, psi = 0, c_residual = 1, epsp_residual = 0.1, length = 1.5 }]
region = [{ name = "bank", material = "clay", spacing = 0.25, K0 = 0.6, polygon = [[0, 0], [2, 0], [2, 3], [0, 3]] }]
boundary = [{ nodes = "bottom", fix = ["x", "y"] }, { nodes = "left", fix = ["x"] },
            { nodes = "right", fix = ["x"], absorbing = true, from = "cut" }]
stage = [{ name = "rest", duration = 0.05, release = 0.04, rest = { required = false, unbalanced = 9, kinetic = 9, rate = 1e-9, hold = 0.01 } },
         { name = "cut", duration = 0.02, remove = { polygon = [[1, 2], [2, 2], [2, 3], [1, 3]] } }]
)");
  Options options;
  options.out = path("r");
  options.quiet = true;
  options.threads = 1;
  run_case(input::read_any_case(path("case.toml")), options);
  const std::string page = io::read_whole(SCARP_DOCS "/checkpoint.md");
  std::set<std::string> missing;
  std::size_t arrays = 0;
  for (const auto& its : checkpoints_in(options.out)) {
    const std::string content = io::read_whole(options.out + "/" + its.name);
    const io::Hdf5File file(content.data(), content.size() - seal_of("", 0).size(), its.name);
    for (const auto& array : file.paths()) {
      const std::string key =
          std::regex_replace(array.substr(std::string("scarp/").size()), std::regex("/[0-9]+/"), "/i/");
      const auto [unit, meaning] = file.note(array);
      ++arrays;
      const auto row = page.find("| `" + key + "` |");
      const auto end = page.find('\n', row);
      const std::string rest = "| " + unit + (unit.empty() ? "| " : " | ") + meaning + " |";
      if (row == page.npos || page.substr(row, end - row).find(rest) == std::string::npos)
        missing.insert(key + " " + rest);
    }
  }
  EXPECT_GT(arrays, 200u);
  for (const auto& row : missing) ADD_FAILURE() << "docs/checkpoint.md lacks or has otherwise: " << row;
}

}  // namespace
}  // namespace scarp::run::test
