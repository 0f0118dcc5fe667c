#include "scarp/run/advice.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <system_error>

#include "scarp/base/error.hpp"
#include "scarp/base/log.hpp"
#include "scarp/base/memory.hpp"
#include "scarp/base/zero_pages.hpp"
#include "scarp/mesh/near.hpp"
#include "scarp/run/expectation.hpp"
#include "scarp/run/memory_need.hpp"

namespace scarp::run {
namespace {

/// The edge of an element [m]: the shortest one of a cell, the least height of other quadrilaterals and hexahedra, the
/// mean edge of triangles and tetrahedra.
template <int Dim>
double edge(const Mesh<Dim>& mesh, int e) {
  if (mesh.grid) return *std::min_element(mesh.grid->spacing.begin(), mesh.grid->spacing.end());
  const auto nodes = mesh.element_nodes(e);
  if (nodes.size() != Dim + 1) return mesh.size_of(e);
  double sum = 0;
  for (std::size_t a = 0; a < nodes.size(); ++a) {
    for (std::size_t b = 0; b < a; ++b) {
      double d2 = 0;
      for (int j = 0; j < Dim; ++j) d2 += std::pow(mesh.node(nodes[a])[j] - mesh.node(nodes[b])[j], 2);
      sum += std::sqrt(d2);
    }
  }
  return sum / (Dim == 2 ? 3 : 6);
}

template <int Dim>
Vec<Dim> middle_of(const Mesh<Dim>& mesh, int e) {
  Vec<Dim> x{};
  if (mesh.grid) {
    const auto cell = mesh.grid->cell(e);
    for (int k = 0; k < Dim; ++k) x[k] = mesh.grid->origin[k] + (cell[k] + 0.5) * mesh.grid->spacing[k];
    return x;
  }
  const auto nodes = mesh.element_nodes(e);
  for (const int n : nodes) {
    for (int k = 0; k < Dim; ++k) x[k] += mesh.node(n)[k] / static_cast<double>(nodes.size());
  }
  return x;
}

/// Elements whose middle is in the region: how many, how many of them hold no point of any region, and the edges of
/// those of these that are smaller than the spacing, and so stay empty by chance in no place only.
template <int Dim>
struct Hollow {
  int elements = 0, empty = 0;
  std::vector<double> too_small;

  Hollow(const Region<Dim>& region, double spacing, const Body<Dim>& body) {
    const BoxOf<Dim> box = bounds(region);
    ZeroPages<std::uint8_t> holds(body.mesh->element_count());
    for (const auto& block : body.blocks()) {
      for (const int e : block.points.element) holds[e] = 1;
    }
    for_elements_near(*body.mesh, box, [&](int e) {
      const Vec<Dim> x = middle_of(*body.mesh, e);
      bool near = true;
      for (int k = 0; k < Dim; ++k) near = near && x[k] >= box.low[k] && x[k] <= box.high[k];
      if (!near || !contains(region, x)) return;
      ++elements;
      if (holds[e]) return;
      ++empty;
      if (const double a = edge(*body.mesh, e); a < spacing) too_small.push_back(a);
    });
  }

  /// A few small elements where the mesh is fitted to a corner do not count.
  bool falls_apart() const { return 50 * too_small.size() > static_cast<std::size_t>(elements); }
};

constexpr int most_searched = 2000000;  ///< elements that are looked through for empty ones without a reason

/// The edge below which a tenth of them are.
double small_one(std::vector<double> edges) {
  const auto small = edges.begin() + static_cast<std::ptrdiff_t>(edges.size() / 10);
  std::nth_element(edges.begin(), small, edges.end());
  return *small;
}

}  // namespace

template <int Dim>
std::string points_per_element(const Body<Dim>& body) {
  ZeroPages<int> counts(body.mesh->element_count());
  std::vector<int> filled;
  for (const auto& block : body.blocks()) {
    for (const int e : block.points.element) {
      if (counts[e]++ == 0) filled.push_back(e);
    }
  }
  int least = filled.empty() ? 0 : std::numeric_limits<int>::max();
  for (const int e : filled) least = std::min(least, counts[e]);
  return fmt::format("{} in {} elements, {:.3g} each on average, {} at least", body.point_count(), filled.size(),
                     filled.empty() ? 0.0 : body.point_count() / static_cast<double>(filled.size()), least);
}

template <int Dim>
void warn_of_sparse_points(const input::CaseOf<Dim>& input, const Body<Dim>& body) {
  for (std::size_t r = 0; r < input.regions.size(); ++r) {
    const auto& element = body.blocks()[r].points.element;
    if (element.empty()) continue;
    const auto& region = input.regions[r];
    std::vector<double> edges(element.size());
    std::transform(element.begin(), element.end(), edges.begin(), [&](int e) { return edge(*body.mesh, e); });
    double small = small_one(std::move(edges));
    const bool sparse = region.spacing > 0.5 * small * (1 + 1e-6);
    if (!sparse && (body.mesh->grid || body.mesh->element_count() > most_searched)) continue;
    const Hollow<Dim> hollow(region.shape(), region.spacing, body);
    if (!sparse && !hollow.falls_apart()) continue;
    if (hollow.falls_apart()) small = std::min(small, small_one(hollow.too_small));
    std::string found = fmt::format("spacing = {:g} in elements of {:.3g}", region.spacing, small);
    if (hollow.empty > 0)
      found +=
          fmt::format("; {} of the {} elements inside it hold no point, and no stress crosses them: it falls apart",
                      hollow.empty, hollow.elements);
    logging::warn(InputError(fmt::format("region \"{}\" has fewer than two points along an edge of an element, which "
                                         "is too few for its stress and for its books of energy",
                                         region.name),
                             found,
                             fmt::format("give it spacing = {:.3g} or less, or make the elements larger", 0.5 * small),
                             region.position)
                      .what());
  }
}

template <int Dim>
void warn_of_ignored_flip(const input::CaseOf<Dim>& input) {
  if (input.method.scheme == input::SchemeName::report) return;
  const auto warn = [](double flip, const Position& position) {
    logging::warn(
        InputError("flip is ignored: it is a share of each step, of scheme = \"report\", and makes the motion "
                   "depend on the time step",
                   fmt::format("flip = {:g}", flip),
                   "leave it out; pic_time in [method] takes the place of flip below 1", position)
            .what());
  };
  if (input.method.ignored_flip) warn(input.method.flip, *input.method.ignored_flip);
  for (const auto& stage : input.stages) {
    if (stage.flip) warn(*stage.flip, stage.position);
  }
}

template <int Dim>
void warn_of_idle_removals(const input::CaseOf<Dim>& input, const Body<Dim>& body) {
  const auto holds_soil = [&](const auto& shape) {
    const auto box = bounds(shape);
    for (const auto& block : body.blocks()) {
      for (int i = 0; i < block.size(); ++i) {
        const auto x = position_of(block.points, i);
        bool near = true;
        for (int k = 0; k < Dim; ++k) near = near && x[k] >= box.low[k] && x[k] <= box.high[k];
        if (near && contains(shape, x)) return true;
      }
    }
    return false;
  };
  for (const auto& stage : input.stages) {
    if (!stage.remove || holds_soil(stage.remove->shape())) continue;
    logging::warn(InputError(fmt::format("the removal of stage \"{}\" takes nothing away", stage.name),
                             "no point of the soil inside it, as it stands at the start",
                             "move it to where the soil is, in metres like the regions", stage.position)
                      .what());
  }
}

template <int Dim>
void warn_of_many_frames(const input::CaseOf<Dim>& input, const Body<Dim>& body) {
  constexpr double many = 10000;
  if (frame_count(input) <= many) return;
  const auto frames = frames_expected(input, body);
  logging::warn(InputError("the output of this case is that of very many frames",
                           fmt::format("every = {:g}: about {:.3g} frames, {}", input.output.every, frames.count,
                                       as_bytes(frames.bytes)),
                           "enlarge every in [output]; history.csv may have as many rows as you like",
                           {input.path, 0, 0})
                    .what());
}

template <int Dim>
void warn_of_small_disk(const input::CaseOf<Dim>& input, const Body<Dim>& body, const std::string& folder) {
  std::error_code none;
  const auto space = std::filesystem::space(folder, none);
  if (none) return;
  const auto frames = frames_expected(input, body);
  const double free = static_cast<double>(space.available);
  // The next checkpoint is on the disk beside those that are kept until it is whole.
  const auto& kept = input.output.checkpoint;
  const double checkpoints = kept.every > 0 || kept.steps > 0 || kept.time > 0 || kept.stages
                                 ? (kept.keep + 1 + (kept.stages ? static_cast<double>(input.stages.size()) : 0.0)) *
                                       memory_need(input).checkpoint
                                 : 0.0;
  if (frames.bytes + checkpoints <= free) return;
  // No warning for summary.json, which is the same on a larger disk.
  logging::line(fmt::format(
      "scarp: warning: the disk of {} has {} free, and this run may write {} ({:.6g} frames of {} in all, checkpoints "
      "of "
      "{}): free some, enlarge every in [output], or name another folder with --out. A run that a full disk stops goes "
      "on with scarp resume",
      folder, as_bytes(free), as_bytes(frames.bytes + checkpoints), frames.count, as_bytes(frames.bytes),
      as_bytes(checkpoints)));
}

template <int Dim>
void warn_of_losses(const Ledger<Dim>& ledger, int points) {
  if (ledger.failures > 0)
    logging::warn(
        fmt::format("{} stress updates failed in this run, and kept the stress that they had: look at the "
                    "field \"failed\" of the frames",
                    ledger.failures));
  if (ledger.last.stress.on_floor > 0)
    logging::warn(fmt::format(
        "{} of {} points ({:.2g} %) end on the floor of p_c, where the law is not that of the soil: look at "
        "the field \"on_floor\" of the last frame",
        ledger.last.stress.on_floor, points, 100 * static_cast<double>(ledger.last.stress.on_floor) / points));
  if (ledger.left_mesh > 0)
    logging::warn(
        fmt::format("{} points left the mesh and were lost: extend the mesh to where the soil goes", ledger.left_mesh));
}

template void warn_of_idle_removals<2>(const input::CaseOf<2>&, const Body<2>&);
template void warn_of_idle_removals<3>(const input::CaseOf<3>&, const Body<3>&);
template void warn_of_many_frames<2>(const input::CaseOf<2>&, const Body<2>&);
template void warn_of_many_frames<3>(const input::CaseOf<3>&, const Body<3>&);
template void warn_of_small_disk<2>(const input::CaseOf<2>&, const Body<2>&, const std::string&);
template void warn_of_small_disk<3>(const input::CaseOf<3>&, const Body<3>&, const std::string&);
template void warn_of_losses<2>(const Ledger<2>&, int);
template void warn_of_losses<3>(const Ledger<3>&, int);
template std::string points_per_element(const Body<2>&);
template std::string points_per_element(const Body<3>&);
template void warn_of_ignored_flip<2>(const input::CaseOf<2>&);
template void warn_of_ignored_flip<3>(const input::CaseOf<3>&);
template void warn_of_sparse_points<2>(const input::CaseOf<2>&, const Body<2>&);
template void warn_of_sparse_points<3>(const input::CaseOf<3>&, const Body<3>&);

}  // namespace scarp::run
