#include "scarp/base/solid.hpp"

#include <algorithm>
#include <cmath>

namespace scarp {
namespace {

template <class... F>
struct Cases : F... {
  using F::operator()...;
};
template <class... F>
Cases(F...) -> Cases<F...>;

Vec<2> in_section(const Prism& prism, const Vec<3>& x) {
  const auto [i, j] = section_axes(prism.axis);
  return {x[i], x[j]};
}

/// The vertical through x, as stretches of heights. Half-open across the section and the axis, as vertical_cuts().
std::vector<std::array<double, 2>> prism_cuts(const Prism& prism, const Vec<3>& x) {
  if (prism.axis != 2) {
    const double along = x[prism.axis];
    if (!(along >= prism.low && along < prism.high)) return {};
    return vertical_cuts(prism.section, x[1 - prism.axis]);
  }
  for (const auto& [low, high] : vertical_cuts(prism.section, x[0])) {
    if (x[1] >= low && x[1] < high) return {{prism.low, prism.high}};
  }
  return {};
}

double largest_length(const BoxOf<3>& box) {
  return std::max({box.high[0] - box.low[0], box.high[1] - box.low[1], box.high[2] - box.low[2]});
}

BoxOf<3> prism_bounds(const Prism& prism) {
  const auto [i, j] = section_axes(prism.axis);
  const Box box = bounds(prism.section);
  BoxOf<3> result{};
  result.low[prism.axis] = prism.low;
  result.high[prism.axis] = prism.high;
  result.low[i] = box.low[0];
  result.high[i] = box.high[0];
  result.low[j] = box.low[1];
  result.high[j] = box.high[1];
  return result;
}

bool prism_contains(const Prism& prism, const Vec<3>& x) {
  const double along = x[prism.axis], round_off = 1e-12 * (prism.high - prism.low);
  return along >= prism.low - round_off && along <= prism.high + round_off &&
         contains(prism.section, in_section(prism, x));
}

bool near_prism(const Prism& prism, const Vec<3>& x) {
  const double near = 1e-9 * largest_length(prism_bounds(prism)), along = x[prism.axis];
  const Vec<2> plane = in_section(prism, x);
  const double beside = distance_from_edges(prism.section, plane);
  if (along < prism.low - near || along > prism.high + near) return false;
  if (beside <= near) return true;
  return contains(prism.section, plane) && std::min(along - prism.low, prism.high - along) <= near;
}

}  // namespace

Prism make_box(const Vec<3>& low, const Vec<3>& high) {
  return {{{low[0], low[1]}, {high[0], low[1]}, {high[0], high[1]}, {low[0], high[1]}}, 2, low[2], high[2]};
}

BoxOf<3> bounds(const Solid& solid) {
  return std::visit(Cases{[](const Prism& prism) { return prism_bounds(prism); },
                          [](const Surface& surface) { return surface.bounds(); }},
                    solid);
}

bool contains(const Solid& solid, const Vec<3>& x) {
  return std::visit(Cases{[&](const Prism& prism) { return prism_contains(prism, x); },
                          [&](const Surface& surface) { return surface.contains(x); }},
                    solid);
}

SolidMoments moments(const Solid& solid) {
  if (const auto* surface = std::get_if<Surface>(&solid)) return surface->moments();
  const auto& prism = std::get<Prism>(solid);
  const Moments section = moments(prism.section);
  const auto [i, j] = section_axes(prism.axis);
  SolidMoments result;
  result.volume = section.area * (prism.high - prism.low);
  result.centroid[i] = section.centroid[0];
  result.centroid[j] = section.centroid[1];
  result.centroid[prism.axis] = prism.low + 0.5 * (prism.high - prism.low);
  return result;
}

double volume(const Polygon& polygon) {
  return moments(polygon).area;
}

double volume(const Solid& solid) {
  return moments(solid).volume;
}

bool near_boundary(const Polygon& polygon, const Vec<2>& x) {
  const Box box = bounds(polygon);
  return distance_from_edges(polygon, x) <= 1e-9 * std::max(box.high[0] - box.low[0], box.high[1] - box.low[1]);
}

bool near_boundary(const Solid& solid, const Vec<3>& x) {
  return std::visit(Cases{[&](const Prism& prism) { return near_prism(prism, x); },
                          [&](const Surface& surface) { return surface.near(x, surface.largest_distance()); }},
                    solid);
}

std::vector<std::array<double, 2>> cuts_through(const Polygon& polygon, const Vec<2>& x) {
  return vertical_cuts(polygon, x[0]);
}

std::vector<std::array<double, 2>> cuts_through(const Solid& solid, const Vec<3>& x) {
  return std::visit(Cases{[&](const Prism& prism) { return prism_cuts(prism, x); },
                          [&](const Surface& surface) { return surface.vertical_cuts(x[0], x[1]); }},
                    solid);
}

}  // namespace scarp
