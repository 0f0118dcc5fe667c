#include "scarp/run/checkpoint.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <charconv>
#include <filesystem>
#include <string_view>

#include "scarp/base/error.hpp"
#include "scarp/base/hash.hpp"
#include "scarp/base/log.hpp"
#include "scarp/io/file.hpp"

namespace scarp::run {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view seal_begin = "\nseal of scarp, xxh128 ", seal_end = "\n";
constexpr std::size_t hash_digits = 32, seal_size = seal_begin.size() + hash_digits + seal_end.size();

struct Sealed {
  std::size_t size;  ///< of the file without its seal
  bool good;         ///< does the seal say that this is what was written?
};

Sealed sealed_part(const std::string& content) {
  const auto all = std::string_view(content);
  const bool has_seal = all.size() > seal_size && all.substr(all.size() - seal_size, seal_begin.size()) == seal_begin;
  if (!has_seal) return {all.size(), false};
  const std::size_t size = all.size() - seal_size;
  return {size, all.substr(size) == seal_of(content.data(), size)};
}

CheckpointHead load_head(const Loader& load) {
  CheckpointHead head;
  const auto group = load.within("run");
  group(Entry{"format", "", ""}, head.format);
  if (head.format != CheckpointHead::current_format) {
    throw InputError("the checkpoint is of another format than this program's",
                     fmt::format("format {} in {}, this program has {}", head.format, load.file_name(),
                                 CheckpointHead::current_format),
                     "go on with the version of scarp that wrote it");
  }
  CheckpointHead::each_saved(head, group);
  for (int i = 0;; ++i) {
    const auto file = load.within(fmt::format("files/{}", i));
    if (!file.has("path")) return head;
    auto& its = head.files.emplace_back();
    file(Entry{"path", "", ""}, its.path);
    file(Entry{"hash", "", ""}, its.hash);
  }
}

/// The number in a name between two texts.
std::optional<std::int64_t> number_between(std::string_view name, std::string_view before, std::string_view after) {
  if (!name.starts_with(before) || !name.ends_with(after) || name.size() <= before.size() + after.size()) return {};
  const auto digits = name.substr(before.size(), name.size() - before.size() - after.size());
  std::int64_t number = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), number);
  if (error != std::errc() || end != digits.data() + digits.size() || number < 0) return {};
  return number;
}

}  // namespace

void save_head(const Saver& save, const CheckpointHead& head) {
  CheckpointHead::each_saved(head, save.within("run"));
  for (std::size_t i = 0; i < head.files.size(); ++i) {
    const auto file = save.within(fmt::format("files/{}", i));
    file(Entry{"path", "", "of a file that the case reads, from the folder of the results"}, head.files[i].path);
    file(Entry{"hash", "", "its XXH3 of 128 bits (xxh128sum)"}, head.files[i].hash);
  }
}

std::string seal_of(const void* data, std::size_t bytes) {
  return fmt::format("{}{}{}", seal_begin, hash_of(data, bytes), seal_end);
}

CheckpointFile::CheckpointFile(const std::string& path, bool edited)
    : CheckpointFile(path, io::read_whole(path), edited) {}

CheckpointFile::CheckpointFile(const std::string& path, const std::string& content, bool edited) : path_(path) {
  const auto sealed = sealed_part(content);
  changed_ = !sealed.good;
  if (changed_ && !edited) {
    throw InputError(
        sealed.size == content.size() ? "the checkpoint has no seal: it was cut off, or written by another program"
                                      : "the checkpoint is damaged: its content is not what its seal says",
        path, "take another one; if you have edited it, say so with --edited (in a case: edited = true in [start])");
  }
  file_ = std::make_unique<io::Hdf5File>(content.data(), sealed.size, path);
  head_ = load_head(load());
}

std::string checkpoint_name(std::int64_t steps) {
  return fmt::format("checkpoint_{:010}.h5", steps);
}
std::string stage_checkpoint_name(std::int64_t steps, int stage) {
  return fmt::format("stage_{}_at_{:010}.h5", stage, steps);
}

std::vector<CheckpointName> checkpoints_in(const std::string& folder) {
  std::vector<CheckpointName> all;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    const std::string name = entry.path().filename().string();
    if (const auto steps = number_between(name, "checkpoint_", ".h5")) all.push_back({name, *steps, -1});
    const auto at = name.find("_at_");
    if (at == name.npos) continue;
    const auto stage = number_between(name, "stage_", name.substr(at));
    const auto steps = number_between(name.substr(at), "_at_", ".h5");
    if (stage && steps && *stage < 1'000'000'000) all.push_back({name, *steps, static_cast<int>(*stage)});
  }
  std::sort(all.begin(), all.end(),
            [](const auto& a, const auto& b) { return a.steps != b.steps ? a.steps > b.steps : a.stage > b.stage; });
  return all;
}

std::optional<CheckpointFile> latest_checkpoint(const std::string& folder, bool edited) {
  std::optional<InputError> last;
  for (const auto& its : checkpoints_in(folder)) {
    try {
      return CheckpointFile(folder + "/" + its.name, edited);
    } catch (const InputError& error) {
      logging::info(fmt::format("{} ({}): the one before is taken", error.problem(), error.value()));
      last = error;
    }
  }
  if (last) throw *last;  // there are some, and none is good
  return {};
}

}  // namespace scarp::run
