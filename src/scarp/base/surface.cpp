#include "scarp/base/surface.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "scarp/base/side.hpp"

namespace scarp {
namespace {

Vec<3> minus(const Vec<3>& a, const Vec<3>& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

double dot(const Vec<3>& a, const Vec<3>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

Vec<3> cross(const Vec<3>& a, const Vec<3>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// On which side of the edge a-b (x, y) is in plan. A point on the edge counts as shifted by (e, e²) with e
/// infinitesimal, so that it belongs to the triangle on one side; 0 only where the edge is vertical.
int side(const Vec<3>& a, const Vec<3>& b, double x, double y) {
  if (const int sign = side_of_line({a[0], a[1]}, {b[0], b[1]}, {x, y})) return sign;
  const double shift = b[1] != a[1] ? a[1] - b[1] : b[0] - a[0];
  return (shift > 0) - (shift < 0);
}

/// Height of the triangle's plane over (x, y) in it.
double height(const Triangle& t, double x, double y) {
  const auto twice_area = [&](const Vec<3>& a, const Vec<3>& b) {
    return (a[0] - x) * (b[1] - y) - (a[1] - y) * (b[0] - x);
  };
  const double at_0 = twice_area(t[1], t[2]), at_1 = twice_area(t[2], t[0]), at_2 = twice_area(t[0], t[1]);
  const double sum = at_0 + at_1 + at_2;
  if (sum == 0) return t[0][2];
  const double z = t[0][2] + (at_1 * (t[1][2] - t[0][2]) + at_2 * (t[2][2] - t[0][2])) / sum;
  return std::clamp(z, std::min({t[0][2], t[1][2], t[2][2]}), std::max({t[0][2], t[1][2], t[2][2]}));
}

double distance_from_segment(const Vec<3>& a, const Vec<3>& b, const Vec<3>& x) {
  const Vec<3> ab = minus(b, a), ax = minus(x, a);
  const double t = std::clamp(dot(ax, ab) / dot(ab, ab), 0.0, 1.0);
  const Vec<3> rest{ax[0] - t * ab[0], ax[1] - t * ab[1], ax[2] - t * ab[2]};
  return std::sqrt(dot(rest, rest));
}

double distance(const Triangle& t, const Vec<3>& x) {
  const Vec<3> normal = cross(minus(t[1], t[0]), minus(t[2], t[0]));
  bool over = true;
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 3; ++i) {
    const Vec<3>&a = t[i], &b = t[(i + 1) % 3];
    over = over && dot(cross(normal, minus(b, a)), minus(x, a)) >= 0;
    least = std::min(least, distance_from_segment(a, b, x));
  }
  return over ? std::min(least, std::abs(dot(normal, minus(x, t[0]))) / std::sqrt(dot(normal, normal))) : least;
}

/// Does the triangle's bounding box, widened by `margin`, hold x?
bool in_box_of(const Triangle& t, const Vec<3>& x, double margin) {
  for (int j = 0; j < 3; ++j) {
    if (x[j] < std::min({t[0][j], t[1][j], t[2][j]}) - margin) return false;
    if (x[j] > std::max({t[0][j], t[1][j], t[2][j]}) + margin) return false;
  }
  return true;
}

}  // namespace

Surface::Surface(std::vector<Triangle> triangles) : triangles_(std::move(triangles)) {
  measure();
  fill_buckets();
}

void Surface::measure() {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  bounds_ = {{infinity, infinity, infinity}, {-infinity, -infinity, -infinity}};
  for (const auto& triangle : triangles_) {
    for (const auto& corner : triangle) {
      for (int j = 0; j < 3; ++j) {
        bounds_.low[j] = std::min(bounds_.low[j], corner[j]);
        bounds_.high[j] = std::max(bounds_.high[j], corner[j]);
      }
    }
  }
  for (int j = 0; j < 3; ++j) extent_ = std::max(extent_, bounds_.high[j] - bounds_.low[j]);
  margin_ = 1e-9 * extent_;
  FacetMoments sum;
  for (const auto& triangle : triangles_) {
    const auto part = scarp::moments(Facet(triangle), bounds_.low);
    sum.z += part.z;
    sum.xz += part.xz;
    sum.yz += part.yz;
    sum.half_zz += part.half_zz;
  }
  const Vec<3>& o = bounds_.low;
  moments_ = {std::abs(sum.z), {o[0] + sum.xz / sum.z, o[1] + sum.yz / sum.z, o[2] + sum.half_zz / sum.z}};
  if (sum.z < 0) {
    for (auto& triangle : triangles_) std::swap(triangle[1], triangle[2]);
  }
}

int Surface::bucket(double x, int axis) const {
  const double low = bounds_.low[axis], length = bounds_.high[axis] - low;
  return static_cast<int>(std::clamp((x - low) / length * count_[axis], 0.0, count_[axis] - 1.0));
}

void Surface::fill_buckets() {
  // About one triangle to a bucket, in squares.
  const double dx = bounds_.high[0] - bounds_.low[0], dy = bounds_.high[1] - bounds_.low[1];
  const double size = std::sqrt(dx * dy / static_cast<double>(triangles_.size()));
  count_ = {static_cast<int>(std::clamp(dx / size, 1.0, 4096.0)), static_cast<int>(std::clamp(dy / size, 1.0, 4096.0))};
  begin_.assign(static_cast<std::size_t>(count_[0]) * count_[1] + 1, 0);
  const auto for_buckets = [&](const Triangle& t, auto&& f) {
    std::array<int, 2> first, last;
    for (int j = 0; j < 2; ++j) {
      first[j] = bucket(std::min({t[0][j], t[1][j], t[2][j]}) - margin_, j);
      last[j] = bucket(std::max({t[0][j], t[1][j], t[2][j]}) + margin_, j);
    }
    for (int row = first[1]; row <= last[1]; ++row) {
      for (int column = first[0]; column <= last[0]; ++column) f(row * count_[0] + column);
    }
  };
  for (const auto& t : triangles_) for_buckets(t, [&](int b) { ++begin_[b + 1]; });
  std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
  entry_.resize(begin_.back());
  std::vector<int> next(begin_.begin(), begin_.end() - 1);
  for (std::size_t t = 0; t < triangles_.size(); ++t) {
    for_buckets(triangles_[t], [&](int b) { entry_[next[b]++] = static_cast<int>(t); });
  }
}

std::vector<Surface::Crossing> Surface::crossings(double x, double y) const {
  if (!(x >= bounds_.low[0] && x <= bounds_.high[0] && y >= bounds_.low[1] && y <= bounds_.high[1])) return {};
  std::vector<Crossing> found;
  const int b = bucket(y, 1) * count_[0] + bucket(x, 0);
  for (int e = begin_[b]; e < begin_[b + 1]; ++e) {
    const Triangle& t = triangles_[entry_[e]];
    const int sign = side(t[0], t[1], x, y);
    if (sign == 0 || side(t[1], t[2], x, y) != sign || side(t[2], t[0], x, y) != sign) continue;
    found.push_back({height(t, x, y), sign > 0});
  }
  std::sort(found.begin(), found.end(), [](const Crossing& a, const Crossing& c) { return a.z < c.z; });
  return found;
}

std::vector<std::array<double, 2>> Surface::vertical_cuts(double x, double y) const {
  const auto found = crossings(x, y);
  std::vector<std::array<double, 2>> cuts;
  for (std::size_t i = 0; i + 1 < found.size(); i += 2) cuts.push_back({found[i].z, found[i + 1].z});
  return cuts;
}

bool Surface::contains(const Vec<3>& x) const {
  for (const auto& cut : vertical_cuts(x[0], x[1])) {
    if (x[2] >= cut[0] && x[2] <= cut[1]) return true;
  }
  return near(x, 1e-12 * extent_);
}

bool Surface::near(const Vec<3>& x, double distance) const {
  for (int j = 0; j < 3; ++j) {
    if (!(x[j] >= bounds_.low[j] - distance && x[j] <= bounds_.high[j] + distance)) return false;
  }
  const int b = bucket(x[1], 1) * count_[0] + bucket(x[0], 0);
  for (int e = begin_[b]; e < begin_[b + 1]; ++e) {
    const Triangle& t = triangles_[entry_[e]];
    if (in_box_of(t, x, distance) && scarp::distance(t, x) <= distance) return true;
  }
  return false;
}

SolidMoments Surface::share(const Vec<3>& low, const Vec<3>& high) const {
  std::vector<int> about;
  for (int row = bucket(low[1], 1); row <= bucket(high[1], 1); ++row) {
    const int first = row * count_[0] + bucket(low[0], 0), last = row * count_[0] + bucket(high[0], 0);
    about.insert(about.end(), entry_.begin() + begin_[first], entry_.begin() + begin_[last + 1]);
  }
  std::sort(about.begin(), about.end());
  about.erase(std::unique(about.begin(), about.end()), about.end());
  // Over each point of the plan the solid's length between low and high is the sum, over the surface's crossings of
  // the vertical there, of ±(z - low), z held between low and high; + where the solid is below the surface.
  const double height = high[2] - low[2];
  double volume = 0, x = 0, y = 0, z = 0;
  for (const int t : about) {
    Facet part(triangles_[t]), kept, rest;
    for (int axis = 0; axis < 2 && part.size > 0; ++axis) {
      cut(part, axis, low[axis], rest, kept);
      cut(kept, axis, high[axis], part, rest);
    }
    if (part.size == 0) continue;
    cut(part, 2, low[2], rest, kept);
    Facet above;
    cut(kept, 2, high[2], part, above);
    if (part.size > 0) {
      const auto m = scarp::moments(part, low);
      volume += m.z, x += m.xz, y += m.yz, z += m.half_zz;
    }
    if (above.size > 0) {
      const auto m = scarp::moments(above, low);
      volume += height * m.area, x += height * m.x, y += height * m.y, z += 0.5 * height * height * m.area;
    }
  }
  if (!(volume > 0)) return {0, low};
  return {volume, {low[0] + x / volume, low[1] + y / volume, low[2] + z / volume}};
}

}  // namespace scarp
