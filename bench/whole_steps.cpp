#include "whole_steps.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <limits>
#include <memory>
#include <stdexcept>

#include "ground.hpp"
#include "scarp/base/error.hpp"
#include "scarp/io/file.hpp"
#include "scarp/io/hdf5.hpp"
#include "scarp/io/vtu.hpp"
#include "scarp/run/body_state.hpp"
#include "scarp/run/build.hpp"
#include "scarp/run/checkpoint.hpp"
#include "scarp/run/fields.hpp"
#include "scarp/run/runner.hpp"
#include "scarp/run/stage.hpp"
#include "soil.hpp"

namespace scarp::bench {
namespace {

constexpr double time_step = 1e-4;         // [s]; points stay in their elements for hundreds of steps
constexpr double compression_rate = 0.01;  // [1/s]: 1e-6 of strain in a step

template <int Dim>
Times write_frame(const Body<Dim>& body, const std::string& path) {
  const Timer timer;
  const auto frame = run::frame_of(body);
  io::write_points_vtu(path, frame.count, frame.positions, frame.fields);
  Times times;
  timer.read(times);
  return times;
}

template <int Dim>
CheckpointTimes write_checkpoint(const Body<Dim>& body, const std::string& path) {
  CheckpointTimes times;
  times.state_bytes = static_cast<double>(run::size_of_state(body));
  const Timer copy;
  io::Hdf5Image image(run::size_of_state(body));
  run::save_body(run::Saver(image, "scarp"), body);
  const auto bytes = image.finish();
  copy.read(times.copy);
  times.bytes = static_cast<double>(bytes.size);
  const Timer disk;
  io::WholeFile file(path);
  file.write(bytes.data.get(), bytes.size);
  file.write(run::seal_of(bytes.data.get(), bytes.size));
  file.finish();
  disk.read(times.disk);
  return times;
}

/// make() gives the body.
template <class Make>
Prepared steps_of(const Scheme& scheme, Make&& make) {
  StepSettings settings;
  settings.scheme = scheme;
  Prepared prepared;
  const Timer since_start;
  const auto body = std::make_shared<decltype(make())>(make());
  since_start.read(prepared.start);
  compress(*body, compression_rate);
  if (!(time_step < 0.5 * critical_time_step(*body, scheme)))
    throw std::logic_error("the benchmark's time step is too long");
  const int points = body->point_count(), steps = std::clamp(4'000'000 / points, 4, 4000);
  for (int k = 0; k < 3; ++k) advance(*body, time_step, settings);  // buffers and caches find their size
  prepared.points = points;
  prepared.elements = body->fields[0].active.size();
  prepared.write_frame = [body](const std::string& path) { return write_frame(*body, path); };
  prepared.write_checkpoint = [body](const std::string& path) { return write_checkpoint(*body, path); };
  prepared.repeat = [body, steps, points, settings](bool profile) mutable {
    settings.profile = profile;
    Repetition result;
    const Timer timer;
    for (int k = 0; k < steps; ++k) {
      const auto totals = advance(*body, time_step, settings);
      result.substeps += totals.stress.substeps;
      result.changed_element += totals.changed_element;
      for (int i = 0; i < phases; ++i) result.phase_seconds[i] += totals.seconds[i];
    }
    timer.read(result);
    result.steps = steps;
    result.point_steps = static_cast<std::int64_t>(steps) * points;
    return result;
  };
  return prepared;
}

/// A folder that is gone with its owner.
class TemporaryFolder {
 public:
  TemporaryFolder() : path_(std::filesystem::temp_directory_path() / fmt::format("scarp-bench-{}", getpid())) {}
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  std::string path() const { return path_.string(); }

 private:
  std::filesystem::path path_;
};

/// examples/slope_cut as it stands, without output: at rest, ready to be cut any number of times. A cut writes one
/// frame after its first step; that is some milliseconds of many seconds.
class SlopeCut {
 public:
  SlopeCut()
      : input_(without_output(input::read_case(SCARP_SOURCE_DIR "/examples/slope_cut/slope_cut.toml"))),
        body_(run::build_body(input_)),
        state_(std::make_unique<State>(run::new_state(body_))),
        results_(input_, folder_.path(), body_, run::Before::nothing, input_.path),
        progress_(true) {
    run_stage(false);
    at_rest_ = body_.fields[0].blocks;
    conditions_ = body_.conditions;
    state_at_rest_ = std::make_unique<State>(*state_);
  }

  const Body<2>& body() const { return body_; }

  Repetition cut(bool profile) {
    body_.fields[0].blocks = at_rest_;
    body_.conditions = conditions_;  // the cut before this one has let the sides go
    body_.fields[0].outside.sides = {};
    state_ = std::make_unique<State>(*state_at_rest_);
    reorder(body_);
    body_.fields[0].out_of_place = 0;
    const Timer timer;
    run_stage(profile);
    Repetition result;
    timer.read(result);
    const auto &before = state_at_rest_->ledger, &ledger = state_->ledger;
    result.steps = state_->stages.back().steps;
    result.point_steps = ledger.point_steps - before.point_steps;
    result.substeps = ledger.substeps - before.substeps;
    result.changed_element =
        ledger.search.searches() - ledger.search.own - before.search.searches() + before.search.own;
    for (int i = 0; i < phases; ++i) result.phase_seconds[i] = ledger.seconds[i] - before.seconds[i];
    return result;
  }

 private:
  static input::Case without_output(input::Case input) {
    input.output.every = 0;
    input.output.history = 1e9;
    return input;
  }

  /// The next one.
  void run_stage(bool profile) {
    const std::function<bool()> interrupted = [] { return false; };
    const std::function<void()> keep = [] {};
    run::Context<2> context{input_, body_, *state_, results_, progress_, interrupted, keep, profile};
    run::run_stage(context);
  }

  using State = run::RunState<2>;
  TemporaryFolder folder_;
  input::Case input_;
  Body<2> body_;
  std::unique_ptr<State> state_, state_at_rest_;
  run::Results<2> results_;
  run::Progress progress_;
  std::vector<Block<2>> at_rest_;
  Conditions<2> conditions_;
};

Prepared slope_cut_failing() {
  Prepared prepared;
  const Timer since_start;
  const auto slope = std::make_shared<SlopeCut>();
  since_start.read(prepared.start);
  prepared.points = slope->body().point_count();
  prepared.elements = slope->body().fields[0].active.size();
  prepared.repeat = [slope](bool profile) { return slope->cut(profile); };
  prepared.write_frame = [slope](const std::string& path) { return write_frame(slope->body(), path); };
  prepared.write_checkpoint = [slope](const std::string& path) { return write_checkpoint(slope->body(), path); };
  return prepared;
}

}  // namespace

Prepared prepare(const std::string& asked, int points) {
  const auto colon = asked.find(':');
  const std::string name = asked.substr(0, colon);
  const Scheme scheme = colon == std::string::npos ? two_term_scheme()
                        : asked.substr(colon + 1) == "report"
                            ? report_scheme()
                            : throw InputError("a benchmark has the standard scheme, or the report's",
                                               '"' + asked + '"', "append :report, or nothing");
  const AnyModel elastic = LinearElastic({1e4, 0.25});
  if (name == "q4-elastic") return steps_of(scheme, [&] { return run::build_body(grid_case<2>(points, elastic)); });
  if (name == "mesh-elastic")
    return steps_of(scheme, [&] { return mesh_body(points, elastic, ElementShape::quadrilaterals); });
  if (name == "mesh-elastic-t3")
    return steps_of(scheme, [&] { return mesh_body(points, elastic, ElementShape::triangles); });
  if (name == "bspline-elastic") {
    auto input = grid_case<2>(points, elastic);
    input.method.shape = GridFunctions::b_spline;
    return steps_of(scheme, [&] { return run::build_body(input); });
  }
  if (name == "q4-subloading") return steps_of(scheme, [&] { return run::build_body(grid_case<2>(points, soil())); });
  if (name == "h8-elastic") return steps_of(scheme, [&] { return run::build_body(grid_case<3>(points, elastic)); });
  if (name == "h8-subloading") return steps_of(scheme, [&] { return run::build_body(grid_case<3>(points, soil())); });
  if (name == "slope-cut-failing") return slope_cut_failing();
  throw InputError("there is no such benchmark", '"' + name + '"', "see docs/benchmarks.md for their names");
}

}  // namespace scarp::bench
