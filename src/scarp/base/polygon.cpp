#include "scarp/base/polygon.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace scarp {
namespace {

double cross(const Vec<2>& o, const Vec<2>& a, const Vec<2>& b) {
  return (a[0] - o[0]) * (b[1] - o[1]) - (a[1] - o[1]) * (b[0] - o[0]);
}

double extent(std::span<const Vec<2>> polygon) {
  const Box box = bounds(polygon);
  return std::max(box.high[0] - box.low[0], box.high[1] - box.low[1]);
}

/// Distance of x from the segment a–b.
double distance(const Vec<2>& a, const Vec<2>& b, const Vec<2>& x) {
  const double dx = b[0] - a[0], dy = b[1] - a[1], length2 = dx * dx + dy * dy;
  const double t = length2 > 0 ? std::clamp(((x[0] - a[0]) * dx + (x[1] - a[1]) * dy) / length2, 0.0, 1.0) : 0.0;
  return std::hypot(x[0] - a[0] - t * dx, x[1] - a[1] - t * dy);
}

/// Do the closed segments a–b and c–d share a point?
bool touch(const Vec<2>& a, const Vec<2>& b, const Vec<2>& c, const Vec<2>& d, double tolerance) {
  const double c_side = cross(a, b, c), d_side = cross(a, b, d), a_side = cross(c, d, a), b_side = cross(c, d, b);
  if (((c_side > 0) != (d_side > 0)) && ((a_side > 0) != (b_side > 0))) return true;
  return distance(a, b, c) <= tolerance || distance(a, b, d) <= tolerance || distance(c, d, a) <= tolerance ||
         distance(c, d, b) <= tolerance;
}

/// The part of the polygon on one side of the line x[axis] = at.
Polygon clip_half(const Polygon& polygon, int axis, double at, bool keep_above) {
  Polygon kept;
  auto inside = [&](const Vec<2>& v) { return keep_above ? v[axis] >= at : v[axis] <= at; };
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec<2>&a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    if (inside(a)) kept.push_back(a);
    if (inside(a) == inside(b)) continue;
    const double t = (at - a[axis]) / (b[axis] - a[axis]);
    Vec<2> crossing{};
    crossing[axis] = at;
    crossing[1 - axis] = a[1 - axis] + t * (b[1 - axis] - a[1 - axis]);
    kept.push_back(crossing);
  }
  return kept;
}

}  // namespace

Moments moments(std::span<const Vec<2>> polygon) {
  if (polygon.size() < 3) return {};
  const Vec<2> o = polygon[0];
  double twice = 0, x = 0, y = 0;
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
    const double part = cross(o, polygon[i], polygon[i + 1]);
    twice += part;
    x += part * (polygon[i][0] + polygon[i + 1][0] - 2 * o[0]);
    y += part * (polygon[i][1] + polygon[i + 1][1] - 2 * o[1]);
  }
  if (twice == 0) return {0, o};
  return {0.5 * std::abs(twice), {o[0] + x / (3 * twice), o[1] + y / (3 * twice)}};
}

bool contains(std::span<const Vec<2>> polygon, const Vec<2>& point) {
  const double tolerance = 1e-12 * extent(polygon);
  bool inside = false;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec<2>&a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    if (distance(a, b, point) <= tolerance) return true;
    if ((a[1] > point[1]) == (b[1] > point[1])) continue;
    const double x = a[0] + (point[1] - a[1]) / (b[1] - a[1]) * (b[0] - a[0]);
    if (point[0] < x) inside = !inside;
  }
  return inside;
}

double distance_from_edges(std::span<const Vec<2>> polygon, const Vec<2>& point) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    least = std::min(least, distance(polygon[i], polygon[(i + 1) % polygon.size()], point));
  }
  return least;
}

Polygon clip_to_box(std::span<const Vec<2>> polygon, const Vec<2>& low, const Vec<2>& high) {
  Polygon part(polygon.begin(), polygon.end());
  for (int axis = 0; axis < 2; ++axis) {
    part = clip_half(part, axis, low[axis], true);
    part = clip_half(part, axis, high[axis], false);
  }
  return part;
}

std::optional<std::pair<std::size_t, std::size_t>> self_crossing(std::span<const Vec<2>> polygon) {
  const std::size_t n = polygon.size();
  const double tolerance = 1e-12 * extent(polygon);
  for (std::size_t i = 0; i < n; ++i) {
    const Vec<2>&a = polygon[i], &b = polygon[(i + 1) % n], &c = polygon[(i + 2) % n];
    if (std::hypot(b[0] - a[0], b[1] - a[1]) <= tolerance) return std::pair{i, (i + 1) % n};
    // The next edge may not fold back over this one.
    if (distance(a, b, c) <= tolerance || distance(b, c, a) <= tolerance) return std::pair{i, (i + 1) % n};
    for (std::size_t j = i + 2; j < n; ++j) {
      if (i == 0 && j == n - 1) continue;  // neighbours over the end of the list
      if (touch(a, b, polygon[j], polygon[(j + 1) % n], tolerance)) return std::pair{i, j};
    }
  }
  return {};
}

std::vector<std::array<double, 2>> vertical_cuts(std::span<const Vec<2>> polygon, double x) {
  std::vector<double> heights;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec<2>&a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    // Half-open in x, so that a corner counts once and vertical edges never do: the cuts come in pairs.
    if ((a[0] > x) == (b[0] > x)) continue;
    heights.push_back(a[1] + (x - a[0]) / (b[0] - a[0]) * (b[1] - a[1]));
  }
  std::sort(heights.begin(), heights.end());
  std::vector<std::array<double, 2>> cuts;
  for (std::size_t i = 0; i + 1 < heights.size(); i += 2) cuts.push_back({heights[i], heights[i + 1]});
  return cuts;
}

Box bounds(std::span<const Vec<2>> polygon) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Box box{{infinity, infinity}, {-infinity, -infinity}};
  for (const auto& corner : polygon) {
    for (int j = 0; j < 2; ++j) {
      box.low[j] = std::min(box.low[j], corner[j]);
      box.high[j] = std::max(box.high[j], corner[j]);
    }
  }
  return box;
}

}  // namespace scarp
