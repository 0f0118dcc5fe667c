// Checkpoint files: a head that says what they are of, the state of the run and that of its body, as HDF5 with a seal
// at the end (docs/checkpoint.md).
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "scarp/input/case.hpp"
#include "scarp/io/hdf5.hpp"
#include "scarp/run/archive.hpp"

namespace scarp::run {

/// A file that a case reads besides itself, and its fingerprint.
struct FileRead {
  std::string path, hash;
};

/// What a checkpoint says of itself.
struct CheckpointHead {
  static constexpr int current_format = 1;

  int format = current_format, dimension = 2;
  std::string program;    ///< version of scarp and level of the processor
  std::string case_name;  ///< of the case file that was run
  std::string title;
  std::string case_text;  ///< with overrides applied, and names of files that lead there from the folder of the results
  std::string mesh;       ///< mesh_hash()
  std::string stage;      ///< under way, or that has ended last
  bool within = false;    ///< is that stage under way?
  bool failed = false;    ///< is it the state of a computation that could not go on?
  double time = 0;        ///< [s]
  std::int64_t steps = 0;
  std::vector<FileRead> files;

  template <class Self, class F>
  static void each_saved(Self& h, F&& f) {
    f(Entry{"format", "", "of the file"}, h.format);
    f(Entry{"dimension", "", "2 or 3"}, h.dimension);
    f(Entry{"program", "", "version of scarp and level of the processor"}, h.program);
    f(Entry{"case_name", "", "of the case file that was run"}, h.case_name);
    f(Entry{"title", "", "of the case"}, h.title);
    f(Entry{"case", "", "the case as it is run, TOML"}, h.case_text);
    f(Entry{"mesh", "", "fingerprint of the mesh"}, h.mesh);
    f(Entry{"stage", "", "name of the stage under way, or that has ended last"}, h.stage);
    f(Entry{"within", "", "1 where that stage is under way"}, h.within);
    f(Entry{"failed", "", "1 for the state of a computation that could not go on"}, h.failed);
    f(Entry{"time", "s", "since the start of the run"}, h.time);
    f(Entry{"steps", "", "since the start of the run"}, h.steps);
  }
};

void save_head(const Saver& save, const CheckpointHead& head);

/// A checkpoint in memory, whole.
class CheckpointFile {
 public:
  /// Reads a file. Throws InputError where it is damaged, of another format, or has no seal and is not `edited`.
  explicit CheckpointFile(const std::string& path, bool edited = false);
  /// The same of its bytes; `path` stands for the file in errors.
  CheckpointFile(const std::string& path, const std::string& content, bool edited);

  const std::string& path() const { return path_; }
  const CheckpointHead& head() const { return head_; }
  /// Has another program changed it?
  bool changed() const { return changed_; }
  Loader load() const { return {*file_, "scarp"}; }

 private:
  std::string path_;
  bool changed_ = false;
  std::unique_ptr<io::Hdf5File> file_;
  CheckpointHead head_;
};

/// What stands after the bytes of a checkpoint: that these are all and unchanged.
std::string seal_of(const void* data, std::size_t bytes);

/// A checkpoint in a folder of results, by its name.
struct CheckpointName {
  std::string name;
  std::int64_t steps = 0;
  int stage = -1;  ///< number of the stage that it is the end of, or -1
};
std::string checkpoint_name(std::int64_t steps);
std::string stage_checkpoint_name(std::int64_t steps, int stage);
inline constexpr const char* failed_checkpoint_name = "failed.h5";

/// The checkpoints in a folder that a run can go on from, the latest first.
std::vector<CheckpointName> checkpoints_in(const std::string& folder);

/// The latest that can be read, if there is one; warns of those that are damaged.
std::optional<CheckpointFile> latest_checkpoint(const std::string& folder, bool edited = false);

}  // namespace scarp::run
