#include "scarp/run/advice.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "scarp/base/error.hpp"
#include "scarp/base/log.hpp"

namespace scarp::run {
namespace {

/// The edge of an element [m]: the shortest one of a cell, the least height of other quadrilaterals and hexahedra, the
/// mean edge of triangles and tetrahedra.
template <int Dim>
double edge(const Mesh<Dim>& mesh, int e) {
  if (mesh.grid) return *std::min_element(mesh.grid->spacing.begin(), mesh.grid->spacing.end());
  const auto nodes = mesh.element_nodes(e);
  if (nodes.size() != Dim + 1) return mesh.size[e];
  double sum = 0;
  for (std::size_t a = 0; a < nodes.size(); ++a) {
    for (std::size_t b = 0; b < a; ++b) {
      double d2 = 0;
      for (int j = 0; j < Dim; ++j) d2 += std::pow(mesh.nodes[nodes[a]][j] - mesh.nodes[nodes[b]][j], 2);
      sum += std::sqrt(d2);
    }
  }
  return sum / (Dim == 2 ? 3 : 6);
}

}  // namespace

template <int Dim>
void warn_of_sparse_points(const input::CaseOf<Dim>& input, const Body<Dim>& body) {
  for (std::size_t r = 0; r < input.regions.size(); ++r) {
    const auto& element = body.blocks[r].points.element;
    if (element.empty()) continue;
    std::vector<double> edges(element.size());
    std::transform(element.begin(), element.end(), edges.begin(), [&](int e) { return edge(*body.mesh, e); });
    // A few small elements where the mesh is fitted to a corner do not count.
    const auto small = edges.begin() + static_cast<std::ptrdiff_t>(edges.size() / 10);
    std::nth_element(edges.begin(), small, edges.end());
    const auto& region = input.regions[r];
    if (region.spacing <= 0.5 * *small * (1 + 1e-6)) continue;
    logging::warn(InputError(fmt::format("region \"{}\" has fewer than two points along an edge of an element, which "
                                         "is too few for its stress and for its books of energy",
                                         region.name),
                             fmt::format("spacing = {:g} in elements of {:.3g}", region.spacing, *small),
                             fmt::format("give it spacing = {:.3g} or less, or make the elements larger", 0.5 * *small),
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

template void warn_of_ignored_flip<2>(const input::CaseOf<2>&);
template void warn_of_ignored_flip<3>(const input::CaseOf<3>&);
template void warn_of_sparse_points<2>(const input::CaseOf<2>&, const Body<2>&);
template void warn_of_sparse_points<3>(const input::CaseOf<3>&, const Body<3>&);

}  // namespace scarp::run
