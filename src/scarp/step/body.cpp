#include "scarp/step/body.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <limits>

#include "scarp/base/error.hpp"

namespace scarp {

template <int Dim>
Body<Dim>::Body(std::unique_ptr<const Mesh<Dim>> background, const Vec<Dim>& gravitational_acceleration)
    : mesh(std::move(background)),
      locator(*mesh),
      conditions(mesh->node_count()),
      gravity(gravitational_acceleration),
      incidence(exec::incidence(*mesh)),
      node(static_cast<std::size_t>(mesh->node_count())) {}

template <int Dim>
int Body<Dim>::point_count() const {
  int count = 0;
  for (const auto& block : blocks) count += block.size();
  return count;
}

template <int Dim>
void locate_points(Body<Dim>& body) {
  for (auto& block : body.blocks) {
    auto& points = block.points;
    exec::for_each(block.size(), [&](int i) {
      Vec<Dim> x;
      for (int j = 0; j < Dim; ++j) x[j] = points.x[j][i];
      const auto found = body.locator.find_anywhere(x);
      points.element[i] = found.element;
      for (int j = 0; j < Dim; ++j) points.xi[j][i] = found.xi[j];
    });
    for (int i = 0; i < block.size(); ++i) {
      if (points.element[i] >= 0) continue;
      throw InputError(fmt::format("the mesh does not hold the soil: region \"{}\" has a point outside it", block.name),
                       fmt::format("a point at ({:.6g}, {:.6g})", points.x[0][i], points.x[1][i]),
                       "extend the mesh over the region, or move the region into the mesh");
    }
  }
  double lightest = std::numeric_limits<double>::infinity();
  for (const auto& block : body.blocks) {
    for (const double m : block.points.mass) lightest = std::min(lightest, m);
  }
  body.least_mass = 1e-12 * lightest;
  reorder(body);
  arrange_in_order(body.blocks);
  body.out_of_place = 0;
}

template <int Dim>
void reorder(Body<Dim>& body) {
  sort_by_element(body.blocks, body.mesh->element_count(), body.active);
  body.nodes = exec::active_nodes(*body.mesh, body.active);
  body.quadrature.assign(static_cast<std::size_t>(body.active.size()), {});
  body.sums.resize(static_cast<std::size_t>(body.active.size()));
  body.momentum.resize(static_cast<std::size_t>(body.active.size()));
}

template struct Body<2>;
template void locate_points<2>(Body<2>&);
template void reorder<2>(Body<2>&);

}  // namespace scarp
