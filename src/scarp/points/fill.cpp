#include "scarp/points/fill.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

namespace scarp {
namespace {

Moments joined(const Moments& a, const Moments& b) {
  const double area = a.area + b.area;
  return {area,
          {(a.area * a.centroid[0] + b.area * b.centroid[0]) / area,
           (a.area * a.centroid[1] + b.area * b.centroid[1]) / area}};
}

/// The lattice over a polygon's bounding box, and the polygon's share of every cell.
class Lattice {
 public:
  Lattice(const Polygon& polygon, double spacing) : polygon_(polygon), box_(bounds(polygon)) {
    for (int j = 0; j < 2; ++j) {
      const double length = box_.high[j] - box_.low[j];
      count_[j] = std::max(1, static_cast<int>(std::lround(length / spacing)));
      step_[j] = length / count_[j];
    }
    cells_.resize(static_cast<std::size_t>(count_[0]) * count_[1]);
    for (int row = 0; row < count_[1]; ++row) fill_row(row);
  }

  double full_area() const { return step_[0] * step_[1]; }

  /// Small shares go to the neighbour with the longest common side, which is the one with the larger share of its cell.
  void merge_small_shares() {
    for (int row = 0; row < count_[1]; ++row) {
      for (int column = 0; column < count_[0]; ++column) {
        Moments& small = cell(column, row);
        if (small.area == 0 || small.area >= least_cell_share * full_area()) continue;
        if (Moments* host = host_of(column, row)) {
          *host = joined(*host, small);
          small = {};
        }
      }
    }
  }

  /// Adds every share as a point; a centroid outside the polygon (a share in two pieces) is cut in halves until inside.
  void collect(Filling& filling) const {
    for (int row = 0; row < count_[1]; ++row) {
      for (int column = 0; column < count_[0]; ++column) {
        const Moments& share = cells_[static_cast<std::size_t>(row) * count_[0] + column];
        if (share.area == 0) continue;
        if (contains(polygon_, share.centroid)) {
          filling.position.push_back(share.centroid);
          filling.volume.push_back(share.area);
        } else {
          split({edge(column, 0), edge(row, 1)}, {edge(column + 1, 0), edge(row + 1, 1)}, 0, filling);
        }
      }
    }
  }

 private:
  Moments& cell(int column, int row) { return cells_[static_cast<std::size_t>(row) * count_[0] + column]; }

  double edge(int index, int axis) const {
    return index == count_[axis] ? box_.high[axis] : box_.low[axis] + index * step_[axis];
  }

  void fill_row(int row) {
    const double low = edge(row, 1), high = edge(row + 1, 1);
    const Polygon strip = clip_to_box(polygon_, {box_.low[0], low}, {box_.high[0], high});
    if (strip.size() < 3) return;
    for (int column = 0; column < count_[0]; ++column) {
      const double left = edge(column, 0), right = edge(column + 1, 0);
      Moments share = moments(clip_to_box(strip, {left, low}, {right, high}));
      if (share.area <= 1e-14 * full_area()) share = {};
      cell(column, row) = share;
    }
  }

  /// The neighbour with the largest share whose point, joined with this one, stays inside the polygon.
  Moments* host_of(int column, int row) {
    const Moments& small = cell(column, row);
    Moments* best = nullptr;
    constexpr std::array<std::array<int, 2>, 4> ways{{{0, -1}, {-1, 0}, {1, 0}, {0, 1}}};
    for (const auto& way : ways) {
      const int c = column + way[0], r = row + way[1];
      if (c < 0 || r < 0 || c >= count_[0] || r >= count_[1]) continue;
      Moments& other = cell(c, r);
      if (other.area <= small.area || (best && other.area <= best->area)) continue;
      if (contains(polygon_, joined(other, small).centroid)) best = &other;
    }
    return best;
  }

  void split(const Vec<2>& low, const Vec<2>& high, int depth, Filling& filling) const {
    const Moments share = moments(clip_to_box(polygon_, low, high));
    if (share.area <= 0) return;
    // Deep down a share is a sliver about an edge; where its point lies no longer matters.
    if (depth >= 12 || contains(polygon_, share.centroid)) {
      filling.position.push_back(share.centroid);
      filling.volume.push_back(share.area);
      return;
    }
    const int axis = depth % 2;
    const double middle = 0.5 * (low[axis] + high[axis]);
    Vec<2> upper_low = low, lower_high = high;
    upper_low[axis] = lower_high[axis] = middle;
    split(low, lower_high, depth + 1, filling);
    split(upper_low, high, depth + 1, filling);
  }

  const Polygon& polygon_;
  Box box_;
  std::array<int, 2> count_{};
  Vec<2> step_{};
  std::vector<Moments> cells_;
};

/// Distance of a point from the nearest edge.
double depth_inside(const Polygon& polygon, const Vec<2>& x) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec<2>&a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const double dx = b[0] - a[0], dy = b[1] - a[1], length2 = dx * dx + dy * dy;
    const double t = std::clamp(((x[0] - a[0]) * dx + (x[1] - a[1]) * dy) / length2, 0.0, 1.0);
    least = std::min(least, std::hypot(x[0] - a[0] - t * dx, x[1] - a[1] - t * dy));
  }
  return least;
}

}  // namespace

Filling fill(const Polygon& polygon, double spacing) {
  Lattice lattice(polygon, spacing);
  lattice.merge_small_shares();
  Filling filling;
  lattice.collect(filling);
  return filling;
}

std::optional<Vec<2>> overlap(const Polygon& polygon, const Filling& other) {
  const Box box = bounds(polygon);
  const double round_off = 1e-9 * std::max(box.high[0] - box.low[0], box.high[1] - box.low[1]);
  for (const auto& x : other.position) {
    if (x[0] < box.low[0] || x[0] > box.high[0] || x[1] < box.low[1] || x[1] > box.high[1]) continue;
    if (contains(polygon, x) && depth_inside(polygon, x) > round_off) return x;
  }
  return {};
}

}  // namespace scarp
