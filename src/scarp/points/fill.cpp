#include "scarp/points/fill.hpp"

#include <algorithm>
#include <cmath>

#include "scarp/points/lattice.hpp"
#include "scarp/points/surface_shares.hpp"

namespace scarp {
namespace {

Share<2> share_in(const Polygon& polygon, const Vec<2>& low, const Vec<2>& high) {
  const Moments part = moments(clip_to_box(polygon, low, high));
  return {part.area, part.centroid};
}

void find_shares(const Polygon& polygon, Lattice<2>& lattice) {
  const Box& box = lattice.box();
  for (int row = 0; row < lattice.count(1); ++row) {
    const double low = lattice.edge(row, 1), high = lattice.edge(row + 1, 1);
    const Polygon strip = clip_to_box(polygon, {box.low[0], low}, {box.high[0], high});
    if (strip.size() < 3) continue;
    for (int column = 0; column < lattice.count(0); ++column) {
      const Share<2> share = share_in(strip, {lattice.edge(column, 0), low}, {lattice.edge(column + 1, 0), high});
      if (share.volume > 1e-14 * lattice.full_volume()) lattice.cell({column, row}) = share;
    }
  }
}

FillingOf<3> fill_prism(const Prism& prism, double spacing) {
  const Filling section = fill(prism.section, spacing);
  const double length = prism.high - prism.low;
  const int layers = std::max(1, static_cast<int>(std::lround(length / spacing)));
  const auto [i, j] = section_axes(prism.axis);
  FillingOf<3> filling;
  filling.position.reserve(section.volume.size() * static_cast<std::size_t>(layers));
  filling.volume.reserve(filling.position.capacity());
  for (int layer = 0; layer < layers; ++layer) {
    const double along = prism.low + (layer + 0.5) * (length / layers);
    for (std::size_t p = 0; p < section.volume.size(); ++p) {
      Vec<3> x;
      x[prism.axis] = along;
      x[i] = section.position[p][0];
      x[j] = section.position[p][1];
      filling.position.push_back(x);
      filling.volume.push_back(section.volume[p] * (length / layers));
    }
  }
  return filling;
}

FillingOf<3> fill_surface(const Surface& surface, double spacing) {
  Lattice<3> lattice(surface.bounds(), spacing);
  find_shares(surface, lattice);
  const auto inside = [&](const Vec<3>& x) { return surface.contains(x); };
  lattice.merge_small_shares(inside);
  FillingOf<3> filling;
  lattice.collect(
      inside,
      [&](const Vec<3>& low, const Vec<3>& high) {
        const SolidMoments part = surface.share(low, high);
        return Share<3>{part.volume > negligible_share * lattice.full_volume() ? part.volume : 0.0, part.centroid};
      },
      filling);
  return filling;
}

}  // namespace

Filling fill(const Polygon& polygon, double spacing) {
  Lattice<2> lattice(bounds(polygon), spacing);
  find_shares(polygon, lattice);
  const auto inside = [&](const Vec<2>& x) { return contains(polygon, x); };
  lattice.merge_small_shares(inside);
  Filling filling;
  lattice.collect(
      inside, [&](const Vec<2>& low, const Vec<2>& high) { return share_in(polygon, low, high); }, filling);
  return filling;
}

FillingOf<3> fill(const Solid& solid, double spacing) {
  if (const auto* prism = std::get_if<Prism>(&solid)) return fill_prism(*prism, spacing);
  return fill_surface(std::get<Surface>(solid), spacing);
}

template <int Dim>
std::optional<Vec<Dim>> overlap(const Region<Dim>& region, const FillingOf<Dim>& other) {
  const BoxOf<Dim> box = bounds(region);
  for (const auto& x : other.position) {
    bool outside = false;
    for (int j = 0; j < Dim; ++j) outside = outside || x[j] < box.low[j] || x[j] > box.high[j];
    if (!outside && contains(region, x) && !near_boundary(region, x)) return x;
  }
  return {};
}

template std::optional<Vec<2>> overlap<2>(const Polygon&, const FillingOf<2>&);
template std::optional<Vec<3>> overlap<3>(const Solid&, const FillingOf<3>&);

}  // namespace scarp
