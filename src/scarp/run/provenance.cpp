#include "scarp/run/provenance.hpp"

#include <fmt/format.h>
#include <gnu/libc-version.h>
#include <spdlog/version.h>
#include <unistd.h>

#include <array>
#include <ctime>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "scarp/base/error.hpp"
#include "scarp/base/hash.hpp"
#include "scarp/base/memory.hpp"
#include "scarp/base/version.hpp"
#include "scarp/io/file.hpp"
#include "scarp/io/hdf5.hpp"

namespace scarp::run {
namespace {

using Json = nlohmann::ordered_json;

std::string date_now() {
  const std::time_t now = std::time(nullptr);
  std::tm parts{};
  localtime_r(&now, &parts);
  std::array<char, 40> text{};
  std::strftime(text.data(), text.size(), "%FT%T%z", &parts);
  return text.data();
}

std::string host_name() {
  std::array<char, 256> name{};
  return gethostname(name.data(), name.size() - 1) == 0 ? name.data() : "";
}

/// What earlier processes have left; nothing where that is no list.
Json runs_before(const std::string& path) {
  std::error_code error;
  if (!std::filesystem::exists(path, error)) return Json::array();
  const Json content = Json::parse(io::read_whole(path), nullptr, false);
  const auto runs = content.is_object() ? content.find("runs") : content.end();
  return content.is_object() && runs != content.end() && runs->is_array() ? *runs : Json::array();
}

Json libraries() {
  return {{"compiler", __VERSION__},
          {"glibc", gnu_get_libc_version()},
          {"fmt", FMT_VERSION},
          {"spdlog", fmt::format("{}.{}.{}", SPDLOG_VER_MAJOR, SPDLOG_VER_MINOR, SPDLOG_VER_PATCH)},
          {"hdf5", io::hdf5_version()}};
}

}  // namespace

std::string program_name() {
  return fmt::format("scarp {} ({})", version, instruction_set());
}

std::string case_in(const std::string& folder) {
  return folder + "/case.toml";
}

std::vector<FileRead> files_read(const std::string& case_text, const std::string& path) {
  std::vector<FileRead> files;
  for (const auto& file : input::files_of_case(case_text, path)) files.push_back({file, hash_of_file(file)});
  return files;
}

void check_case_unchanged(const CheckpointFile& from, const std::string& kept_case) {
  std::error_code error;
  if (std::filesystem::exists(kept_case, error) && io::read_whole(kept_case) != from.head().case_text) {
    throw InputError("the case that the results keep has been changed since the run began", kept_case,
                     "bring it back as it was; to go on with another case, give that one [start] from = this folder");
  }
  const auto now = files_read(from.head().case_text, kept_case);
  for (std::size_t i = 0; i < now.size() && i < from.head().files.size(); ++i) {
    if (now[i].hash == from.head().files[i].hash) continue;
    throw InputError("a file that the case reads has been changed since the run began", now[i].path,
                     "bring it back as it was; to go on with another case, give that one [start] from = this folder");
  }
}

void write_provenance(const std::string& folder, const Options& options, int threads, const CheckpointHead& head) {
  const std::string path = folder + "/provenance.json";
  auto files = Json::array();
  for (const auto& file : head.files) files.push_back({{"path", file.path}, {"xxh128", file.hash}});
  Json runs = runs_before(path);
  std::error_code error;
  runs.push_back({{"date", date_now()},
                  {"command", options.command},
                  {"working_folder", std::filesystem::current_path(error).string()},
                  {"program", program_name()},
                  {"libraries", libraries()},
                  {"from_step", head.steps},
                  {"threads", threads},
                  {"host", host_name()},
                  {"memory_free", free_memory().memory},
                  {"case_xxh128", hash_of(head.case_text.data(), head.case_text.size())},
                  {"files", files}});
  io::write_whole(path, Json{{"runs", runs}}.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
}

}  // namespace scarp::run
