#include "scarp/run/run.hpp"

#include <fmt/format.h>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <utility>

#include "scarp/base/error.hpp"
#include "scarp/base/log.hpp"
#include "scarp/exec/parallel.hpp"
#include "scarp/run/advice.hpp"
#include "scarp/run/body_state.hpp"
#include "scarp/run/boundary_nodes.hpp"
#include "scarp/run/build.hpp"
#include "scarp/run/expectation.hpp"
#include "scarp/run/lengths.hpp"
#include "scarp/run/provenance.hpp"
#include "scarp/run/results.hpp"
#include "scarp/run/runner.hpp"
#include "scarp/run/scheme.hpp"
#include "scarp/run/start.hpp"

namespace scarp::run {
namespace {

template <int Dim>
std::string name_of(const input::CaseOf<Dim>& input, const Options& options) {
  return options.case_name.empty() ? input.path : options.case_name;
}

/// What the case's checkpoints say of it.
template <int Dim>
CheckpointHead head_of(const input::CaseOf<Dim>& input, const Options& options, const Results<Dim>& results,
                       const Body<Dim>& body) {
  CheckpointHead head;
  head.dimension = Dim;
  head.program = program_name();
  head.case_name = name_of(input, options);
  head.title = input.title;
  head.case_text = results.case_text();
  head.mesh = mesh_hash(*body.mesh);
  head.files = files_read(head.case_text, case_in(results.folder()));
  return head;
}

template <int Dim>
Outcome run_in(const input::CaseOf<Dim>& input, const Options& options) {
  const int threads = exec::set_threads(options.threads);
  Body<Dim> body = input.start ? start_body(input) : build_body(input);
  warn_of_ignored_flip(input);
  warn_of_sparse_points(input, body);
  warn_of_idle_removals(input, body);
  warn_of_many_frames(input, body);
  for (const auto& warning : short_lengths(input, body)) logging::warn(warning);
  auto state = new_state(body);
  Results<Dim> results(input, options.out, body, options.overwrite ? Before::replace : Before::nothing,
                       name_of(input, options));
  const auto head = head_of(input, options, results, body);
  write_provenance(results.folder(), options, threads, head);
  const logging::Copy copy(results.folder() + "/run.log");
  warn_of_small_disk(input, body, results.folder());
  results.frame(body, 0);
  return Runner<Dim>(input, options, threads, body, state, results, head).go();
}

/// The run of a checkpoint, from there to its end.
template <int Dim>
Outcome resume_in(input::CaseOf<Dim> input, const Options& options, std::optional<CheckpointFile> from,
                  std::unique_ptr<FolderLock> lock) {
  const auto head = from->head();
  const int threads = exec::set_threads(options.threads);
  input.title = head.title;  // the standard one is the name of the file that was read
  Body<Dim> body = build_ground(input);
  if (mesh_hash(*body.mesh) != head.mesh) {
    throw InputError("the mesh is not that of the checkpoint", from->path(), "bring back the mesh file as it was");
  }
  load_body(from->load(), from->changed() ? Elements::by_place : Elements::as_kept, body);
  auto state = new_state(body);
  load_run(from->load(), input, body, state);
  if (from->changed()) {  // by a user's hand, which the books of energy know nothing of
    record_motion(body, state.ledger.last);
    state.energy.start(state.ledger);
  }
  from.reset();  // as large as the body
  logging::set_warnings(state.warnings);
  Results<Dim> results(input, options.out, std::move(lock), state.results, head.case_name);
  write_provenance(results.folder(), options, threads, head);
  const logging::Copy copy(results.folder() + "/run.log");
  warn_of_small_disk(input, body, results.folder());
  return Runner<Dim>(input, options, threads, body, state, results, head).go();
}

template <int Dim>
std::string check_in(const input::CaseOf<Dim>& input) {
  Body<Dim> body = input.start ? start_body(input) : build_body(input);
  warn_of_ignored_flip(input);
  warn_of_sparse_points(input, body);
  warn_of_idle_removals(input, body);
  warn_of_many_frames(input, body);
  std::string text = fmt::format("{}: {}\n", input.path, input.title);
  text += fmt::format("  mesh: {} elements, {} nodes, {}\n", body.mesh->element_count(), body.mesh->node_count(),
                      body.mesh->grid ? "a structured grid" : "unstructured");
  text += fmt::format("  points: {}\n", points_per_element(body));
  for (const auto& block : body.blocks()) {
    double mass = 0, volume = 0;
    for (int i = 0; i < block.size(); ++i) {
      mass += block.points.mass[i];
      volume += block.points.volume[i];
    }
    const bool area = Dim == 2 && !input.axisymmetric;
    const char* share = input.axisymmetric ? " per radian" : area ? " per m" : "";
    text += fmt::format("    region \"{}\": {} points, {} {:.6g} {}{}, mass {:.6g}{}\n", block.name, block.size(),
                        area ? "area" : "volume", volume, area ? "m2" : "m3", area ? "" : share, mass, share);
  }
  for (const auto& line : describe_boundaries(*body.mesh, input.boundaries)) text += fmt::format("  {}\n", line);
  for (const auto& warning : short_lengths(input, body)) text += fmt::format("  warning: {}\n", warning);
  const double critical = critical_time_step(body, scheme_of(input.method));
  const double dt = input.method.safety * critical;
  text += fmt::format("  time step: {:.3g} s at the start (critical {:.3g} s, safety {:g})\n", dt, critical,
                      input.method.safety);
  for (const auto& stage : input.stages) {
    text += fmt::format("  stage \"{}\": {:g} s, about {:.0f} steps\n", stage.name, stage.duration,
                        std::ceil(stage.duration / dt));
  }
  return text + expectation(input, body, dt);
}

}  // namespace

Outcome run_case(const input::AnyCase& input, const Options& options) {
  return std::visit([&](const auto& its) { return run_in(its, options); }, input);
}

Outcome resume_case(const Options& options) {
  const std::string kept = case_in(options.out);
  if (std::error_code none; !std::filesystem::exists(kept, none))
    throw InputError(
        "there is no run to go on with",
        std::filesystem::is_directory(options.out, none) ? "no " + kept : options.out + ", which is no folder",
        "name the folder of the results of a run, or begin one with scarp run");
  auto lock = std::make_unique<FolderLock>(options.out);
  auto from = latest_checkpoint(options.out, options.edited);
  std::error_code error;
  if (!from && !std::filesystem::exists(kept, error))
    throw InputError("there is no run to go on with in this folder", options.out,
                     "name the folder of a run's results, which has a case.toml and checkpoints");
  if (!from) {
    auto input = input::read_any_case(kept);
    logging::info(fmt::format("{} has no checkpoint yet: the run starts again", options.out));
    auto again = options;
    again.overwrite = true;
    const auto marker = marker_in(options.out);
    again.case_name = marker.case_name;
    std::visit([&](auto& its) { its.title = marker.title.empty() ? its.title : marker.title; }, input);
    lock.reset();
    return run_case(input, again);
  }
  check_case_unchanged(*from, kept);
  if (!options.quiet) {
    logging::info(fmt::format("goes on from {}: stage \"{}\", t = {:.6g} s, step {}", from->path(), from->head().stage,
                              from->head().time, from->head().steps));
  }
  auto input = input::read_case_text(from->head().case_text, kept);
  return std::visit([&](auto& its) { return resume_in(std::move(its), options, std::move(from), std::move(lock)); },
                    input);
}

std::string check_case(const input::AnyCase& input) {
  return std::visit([](const auto& its) { return check_in(its); }, input);
}

}  // namespace scarp::run
