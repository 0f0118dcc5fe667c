#include "scarp/run/results.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>

#include "scarp/base/error.hpp"
#include "scarp/base/exact_sum.hpp"
#include "scarp/base/log.hpp"
#include "scarp/base/version.hpp"
#include "scarp/comm/alone.hpp"
#include "scarp/input/kept.hpp"
#include "scarp/io/file.hpp"
#include "scarp/io/history.hpp"
#include "scarp/io/pvd.hpp"
#include "scarp/io/vtu.hpp"
#include "scarp/run/checkpoint.hpp"
#include "scarp/run/fields.hpp"
#include "scarp/run/history.hpp"

namespace scarp::run {
namespace {

namespace fs = std::filesystem;

template <int Dim>
std::vector<std::string> keys_of(const std::vector<HistoryColumn<Dim>>& columns) {
  std::vector<std::string> keys;
  for (const auto& column : columns) keys.push_back(column.key);
  return keys;
}

std::string frame_name(int index) {
  return fmt::format("points_{:05}.vtu", index);
}

void remove_file(const fs::path& path) {
  std::error_code error;
  fs::remove(path, error);
  if (error) {
    throw InputError("a file of an earlier run cannot be removed", path.string() + " (" + error.message() + ")",
                     "see to it that you may write in the folder of the results");
  }
}

/// Is this a file that scarp writes into a folder of results?
bool is_ours(const std::string& name) {
  static const std::vector<std::string> names = {"points.pvd",         "mesh.vtu", "history.csv", "summary.json",
                                                 "case.toml",          "run.log",  "failed.h5",   "provenance.json",
                                                 "configurations.png", "plan.png", "fields.png",  "history.png"};
  const bool frame = name.starts_with("points_") && name.ends_with(".vtu");
  const bool checkpoint = (name.starts_with("checkpoint_") || name.starts_with("stage_")) && name.ends_with(".h5");
  return frame || checkpoint || name.ends_with(".part") || std::find(names.begin(), names.end(), name) != names.end();
}

std::unique_ptr<FolderLock> prepare(const fs::path& folder, Before before) {
  std::error_code error;
  if (fs::exists(folder, error) && !fs::is_directory(folder, error)) {
    throw InputError("the results need a folder, but a file has that name", folder.string(), "choose another --out");
  }
  fs::create_directories(folder, error);
  if (error) {
    throw InputError("the folder of the results cannot be made", folder.string() + " (" + error.message() + ")",
                     "choose another --out");
  }
  auto lock = std::make_unique<FolderLock>(folder.string());
  std::vector<fs::path> old;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    const auto name = entry.path().filename().string();
    if (is_ours(name)) old.push_back(entry.path());
  }
  const bool foreign =
      !old.empty() && !fs::exists(folder / "summary.json", error) && !fs::exists(folder / "summary.json.part", error);
  if (foreign) {
    throw InputError(
        "the folder holds files with names that scarp would overwrite, but no summary.json of an earlier run",
        folder.string(), "choose another --out, or move these files away");
  }
  if (!old.empty() && before != Before::replace) {
    throw InputError(
        "the folder holds the results of an earlier run", folder.string(),
        "choose another --out, say --overwrite to replace them, or go on with them: scarp resume " + folder.string());
  }
  // The marker of a folder of results goes last.
  std::stable_partition(old.begin(), old.end(), [](const auto& path) { return path.filename() != "summary.json"; });
  for (const auto& path : old) remove_file(path);
  return lock;
}

/// Removes what an interrupted run wrote after its state was kept, with so many frames, and what it left half written.
void cut_back(const fs::path& folder, std::size_t frames) {
  std::set<std::string> kept;
  for (std::size_t i = 0; i < frames; ++i) kept.insert(frame_name(static_cast<int>(i)));
  std::vector<fs::path> later;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) {
    const auto name = entry.path().filename().string();
    const bool is_frame = name.starts_with("points_") && name.ends_with(".vtu");
    const bool is_rest = (name.ends_with(".part") && is_ours(name)) || name == failed_checkpoint_name;
    if (is_rest || (is_frame && !kept.contains(name))) later.push_back(entry.path());
    kept.erase(name);
  }
  if (!kept.empty()) {
    throw InputError("a frame of the run that is to go on is missing", (folder / *kept.begin()).string(),
                     "bring it back; or run the case again from its start: scarp run " +
                         (folder / "case.toml").string() + " with another --out");
  }
  for (const auto& path : later) remove_file(path);
}

/// Also of texts that are not in UTF-8, such as names of files.
std::string in_text(const nlohmann::ordered_json& json) {
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

nlohmann::ordered_json search_json(const SearchCounts& search) {
  const auto searches = std::max<std::int64_t>(1, search.searches());
  return {{"own", search.own},
          {"surrounding", search.surrounding},
          {"walked", search.walked},
          {"searched_all", search.searched_all},
          {"lost", search.lost},
          {"mean_examined", static_cast<double>(search.elements_examined) / static_cast<double>(searches)},
          {"most_examined", search.most_examined}};
}

nlohmann::ordered_json stages_json(const std::vector<StageRecord>& stages) {
  auto list = nlohmann::ordered_json::array();
  for (const auto& stage : stages) {
    list.push_back({{"name", stage.name},
                    {"start", stage.start},
                    {"end", stage.end},
                    {"steps", stage.steps},
                    {"unbalanced_ratio", stage.unbalanced_ratio},
                    {"max_velocity", stage.max_velocity},
                    {"max_displacement", stage.max_displacement},
                    {"moved_mass", stage.moved_mass},
                    {"moved_beyond", stage.moved_beyond},
                    {"removal", stage.removal},
                    {"ended", stage.ended}});
  }
  return list;
}

}  // namespace

Marker marker_in(const std::string& folder) {
  std::error_code error;
  if (!fs::exists(folder + "/summary.json", error)) return {};
  const auto json = nlohmann::json::parse(io::read_whole(folder + "/summary.json"), nullptr, false);
  const auto text = [&json](const char* key) -> std::string {
    return json.is_object() && json.contains(key) && json[key].is_string() ? json[key].get<std::string>() : "";
  };
  return {text("title"), text("case")};
}

template <int Dim>
struct Results<Dim>::Writers {
  Writers(const std::string& folder, std::vector<HistoryColumn<Dim>> of_history)
      : collection(folder + "/points.pvd"),
        columns(std::move(of_history)),
        history(folder + "/history.csv", keys_of(columns)) {}
  /// Goes on with the files of an earlier process.
  Writers(const std::string& folder, std::vector<HistoryColumn<Dim>> of_history, const ResultsState& before)
      : collection(folder + "/points.pvd"),
        columns(std::move(of_history)),
        history(folder + "/history.csv", keys_of(columns), before.history_bytes),
        last_frame(before.last_frame),
        last_row(before.last_row) {
    for (const double time : before.frame_times) add_frame(time, frame_name(static_cast<int>(frame_times.size())));
    collection.write();
  }

  void add_frame(double time, const std::string& name) {
    frame_times.push_back(time);
    collection.add(time, name);
  }

  io::PvdWriter collection;
  std::vector<HistoryColumn<Dim>> columns;
  io::HistoryWriter history;
  std::vector<double> frame_times;
  double last_frame = -1, last_row = -1;  ///< times; what falls due at the end of a stage is written once
};

template <int Dim>
Results<Dim>::Results(const input::CaseOf<Dim>& input, const std::string& folder, const Body<Dim>& body, Before before,
                      const std::string& case_name)
    : input_(input), folder_(folder), case_name_(case_name) {
  lock_ = prepare(folder, before);
  // The marker of a folder of results comes first.
  const nlohmann::ordered_json marker = {{"title", input.title}, {"case", case_name_}, {"status", "running"}};
  io::write_whole(folder_ + "/summary.json", in_text(marker));
  case_text_ = input::kept_text(input.text, input.path, folder_);
  io::write_whole(folder_ + "/case.toml", case_text_);
  io::write_mesh_vtu(folder_ + "/mesh.vtu", *body.mesh);
  writers_ = std::make_unique<Writers>(folder_, history_columns<Dim>(input));
}

template <int Dim>
Results<Dim>::Results(const input::CaseOf<Dim>& input, const std::string& folder, std::unique_ptr<FolderLock> lock,
                      const ResultsState& state, const std::string& case_name)
    : input_(input), folder_(folder), case_name_(case_name), case_text_(input.text), lock_(std::move(lock)) {
  cut_back(folder_, state.frame_times.size());
  writers_ = std::make_unique<Writers>(folder_, history_columns<Dim>(input), state);
}

template <int Dim>
ResultsState Results<Dim>::state() const {
  return {writers_->frame_times, writers_->last_frame, writers_->last_row, writers_->history.bytes()};
}

template <int Dim>
void Results<Dim>::sync() const {
  writers_->history.sync();
}

template <int Dim>
Results<Dim>::~Results() = default;

template <int Dim>
void Results<Dim>::frame(const Body<Dim>& body, double time) {
  if (time == writers_->last_frame) return;
  writers_->last_frame = time;
  const Frame frame = frame_of(body);
  const auto name = frame_name(static_cast<int>(writers_->frame_times.size()));
  io::write_points_vtu(folder_ + "/" + name, frame.count, frame.positions, frame.fields);
  writers_->add_frame(time, name);
  writers_->collection.write();
}

template <int Dim>
void Results<Dim>::history(int stage, int points, const Ledger<Dim>& l) {
  if (l.time == writers_->last_row) return;
  writers_->last_row = l.time;
  std::vector<double> row;
  for (const auto& column : writers_->columns) row.push_back(column.value({l, stage, points}));
  writers_->history.row(row);
}

template <int Dim>
void Results<Dim>::summary(const Body<Dim>& body, const Ledger<Dim>& ledger, const RunRecord& record) {
  const auto work = static_cast<double>(std::max<std::int64_t>(1, ledger.point_steps));
  const nlohmann::ordered_json json = {{"title", input_.title},
                                       {"version", version},
                                       {"case", case_name_},
                                       {"status", record.status},
                                       {"message", record.message},
                                       {"dimension", Dim},
                                       {"axisymmetric", input_.axisymmetric},
                                       {"points", body.point_count()},
                                       {"elements", body.mesh->element_count()},
                                       {"threads", record.threads},
                                       {"steps", ledger.steps},
                                       {"time", ledger.time},
                                       {"wall_seconds", record.wall_seconds},
                                       {"ns_per_point_step", 1e9 * record.wall_seconds / work},
                                       {"mass_error", ledger.mass_error()},
                                       {"energy_error", record.energy_error},
                                       {"largest_energy_error", record.largest_energy_error},
                                       {"warnings", logging::warnings()},
                                       {"removed_points", ledger.removed_points},
                                       {"failures", ledger.failures},
                                       {"corrected", ledger.corrected},
                                       {"substeps_mean", static_cast<double>(ledger.substeps) / work},
                                       {"search", search_json(ledger.search)},
                                       {"colour", input_.output.colour},
                                       {"stages", stages_json(record.stages)}};
  io::write_whole(folder_ + "/summary.json", in_text(json));
}

namespace {

/// f(displacement, mass) of every point.
template <int Dim, class F>
void for_each_displacement(const Body<Dim>& body, F&& f) {
  for (const auto& block : body.blocks()) {
    for (int i = 0; i < block.size(); ++i) {
      double u2 = 0;
      for (int j = 0; j < Dim; ++j) u2 += block.points.u(j, i) * block.points.u(j, i);
      f(std::sqrt(u2), block.points.mass[i]);
    }
  }
}

}  // namespace

template <int Dim>
double max_displacement(const Body<Dim>& body) {
  double largest = 0;
  for_each_displacement(body, [&](double u, double) { largest = std::max(largest, u); });
  return comm::most_of_all(largest);
}

template <int Dim>
double mass_moved(const Body<Dim>& body, double length) {
  ExactSum mass;
  for_each_displacement(body, [&](double u, double m) {
    if (u > length) mass.add(m);
  });
  return comm::sum_of_all(mass);
}

template class Results<2>;
template class Results<3>;
template double max_displacement<2>(const Body<2>&);
template double max_displacement<3>(const Body<3>&);
template double mass_moved<2>(const Body<2>&, double);
template double mass_moved<3>(const Body<3>&, double);

}  // namespace scarp::run
