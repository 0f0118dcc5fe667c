#include "scarp/run/start.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <filesystem>
#include <optional>

#include "scarp/base/error.hpp"
#include "scarp/base/log.hpp"
#include "scarp/exec/stress_update.hpp"
#include "scarp/run/body_state.hpp"
#include "scarp/run/build.hpp"
#include "scarp/run/checkpoint.hpp"
#include "scarp/run/provenance.hpp"

namespace scarp::run {
namespace {

namespace fs = std::filesystem;

/// That of a stage's end in a folder of results.
CheckpointFile end_of_stage(const input::StartInput& start) {
  std::vector<std::string> names;
  for (const auto& its : checkpoints_in(start.from)) {
    if (its.stage < 0) continue;
    CheckpointFile file(start.from + "/" + its.name, start.edited);
    if (file.head().stage == *start.stage) return file;
    names.push_back('"' + file.head().stage + '"');
  }
  throw InputError(fmt::format("the results in {} have no end of stage \"{}\"", start.from, *start.stage),
                   names.empty() ? "no stage has ended there" : fmt::format("ends of {}", fmt::join(names, ", ")),
                   "name one of these, or leave stage out for the latest state", start.stage_position);
}

CheckpointFile checkpoint_of(const input::StartInput& start) {
  std::error_code error;
  if (fs::is_regular_file(start.from, error)) {
    if (start.stage) {
      throw InputError("from names a checkpoint, which is of one time: a stage cannot be chosen in it", start.from,
                       "leave stage out, or name the folder of the results", start.stage_position);
    }
    return CheckpointFile(start.from, start.edited);
  }
  if (!fs::is_directory(start.from, error))
    throw InputError("the results to start from are not there", start.from,
                     "names are relative to the case file's folder; run that case first");
  if (start.stage) return end_of_stage(start);
  auto latest = latest_checkpoint(start.from, start.edited);
  if (!latest)
    throw InputError("the results to start from have no checkpoint", start.from, "let that case run on first");
  return std::move(*latest);
}

/// What a region says of its soil at the start, which comes from the other run here.
template <int Dim>
std::optional<std::string> first_difference(const input::RegionInputOf<Dim>& a, const input::RegionInputOf<Dim>& b) {
  const auto box = bounds(a.shape()), other = bounds(b.shape());
  if (box.low != other.low || box.high != other.high || volume(a.shape()) != volume(b.shape())) return "its shape";
  if (a.spacing != b.spacing) return fmt::format("its spacing, {:g}", b.spacing);
  if (a.K0 != b.K0) return "its K0";
  if (a.stress != b.stress) return "its stress";
  if (a.velocity != b.velocity) return "its velocity";
  if (a.initial != b.initial) return "its initial values";
  return {};
}

/// That the regions are those of the other run's case. Their soil comes from there: what is said of it here and is
/// something else would be ignored.
template <int Dim>
void check_regions(const input::CaseOf<Dim>& input, const CheckpointFile& from) {
  const auto there = std::get<input::CaseOf<Dim>>(input::read_case_text(from.head().case_text, from.path()));
  for (std::size_t r = 0; r < input.regions.size(); ++r) {
    const auto& region = input.regions[r];
    const auto refuse = [&](const std::string& what) {
      throw InputError(
          fmt::format("region \"{}\" is not that of the run it starts from: {} differs", region.name, what),
          from.path(), "write the region as it is in the case of that run: its soil comes from there", region.position);
    };
    if (r >= there.regions.size()) return;  // said with the points
    if (there.regions[r].name != region.name) refuse(fmt::format("its name, \"{}\" there,", there.regions[r].name));
    if (const auto what = first_difference(region, there.regions[r])) refuse(*what);
    const auto& material = input.materials[region.material];
    const double density = there.materials[there.regions[r].material].density;
    if (material.density != density)
      throw InputError(
          fmt::format("the points of region \"{}\" have their mass from the run they start from", region.name),
          fmt::format("density {:g} here, {:g} there", material.density, density),
          "give the material the density that it had", material.position);
  }
}

/// That the law of a region can go on from its points' states with the constants that it has here.
template <int Dim>
void check_states(const input::RegionInputOf<Dim>& region, const Block<Dim>& block, double tolerance) {
  int outside = 0;
  for (int i = 0; i < block.size(); ++i) {
    exec::with_state(block, i, [&](const auto& model, auto state) {
      const bool sound = model.admissible(state);
      const auto flags = model.accept(state, tolerance);
      if (!sound || !flags.sound)
        throw InputError(fmt::format("the law of region \"{}\" cannot take the state in which point {} is, at ({:.4g})",
                                     region.name, block.points.id[i], fmt::join(position_of(block.points, i), ", ")),
                         description_of(block.model).name + " with the constants of this case",
                         "take constants nearer to those of the run it starts from", region.position);
      outside += flags.corrected ? 1 : 0;
    });
  }
  if (outside > 0)
    logging::warn(
        fmt::format("region \"{}\": the stress of {} of {} points lies outside what the constants of this "
                    "case allow; the first step pulls it back",
                    region.name, outside, block.size()));
}

template <int Dim>
Body<Dim> body_from(const input::CaseOf<Dim>& input, const CheckpointFile& from) {
  const auto& head = from.head();
  if (head.dimension != Dim)
    throw InputError(fmt::format("the run to start from is one in {} dimensions", head.dimension), from.path(),
                     "start from one with the dimension of this case");
  if (head.failed)
    throw InputError("this is the state of a computation that could not go on", from.path(),
                     "start from a checkpoint before that");
  Body<Dim> body = build_ground(input);
  if (mesh_hash(*body.mesh) != head.mesh)
    throw InputError("the mesh is not that of the run to start from: its nodes, elements or shape functions differ",
                     from.path(), "give the case the mesh, shape and axisymmetric of that run");
  check_regions(input, from);
  load_points(from.load(), from.changed() ? Elements::by_place : Elements::as_kept, body);
  for (std::size_t r = 0; r < input.regions.size(); ++r)
    check_states(input.regions[r], body.blocks()[r], input.method.tolerance);
  check_soil(input, body);
  return body;
}

}  // namespace

template <int Dim>
Body<Dim> start_body(const input::CaseOf<Dim>& input) {
  try {
    return body_from(input, checkpoint_of(*input.start));
  } catch (const InputError& error) {
    if (error.position().line > 0) throw;
    throw InputError(error.problem(), error.value(), error.remedy(), input.start->position);
  }
}

template Body<2> start_body<2>(const input::CaseOf<2>&);
template Body<3> start_body<3>(const input::CaseOf<3>&);

}  // namespace scarp::run
