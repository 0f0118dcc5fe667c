#include "scarp/run/cut_elements.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <vector>

#include "scarp/base/solid.hpp"
#include "scarp/mesh/build.hpp"
#include "scarp/mesh/near.hpp"
#include "scarp/mesh/shapes.hpp"

namespace scarp::run {
namespace {

constexpr double slack = 1e-6;  ///< of the least height of an element: what is this near to its side lies on it

/// Corners of an element, anticlockwise; those of a grid are no nodes where its functions are not linear.
void corners_of(const Mesh<2>& mesh, int e, Polygon& corners) {
  corners.clear();
  if (!mesh.grid) {
    for (const int n : mesh.element_nodes(e)) corners.push_back(mesh.node(n));
    return;
  }
  const auto& grid = *mesh.grid;
  const auto cell = grid.cell(e);
  for (const auto& [i, j] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}}) {
    corners.push_back(
        {grid.origin[0] + (cell[0] + i) * grid.spacing[0], grid.origin[1] + (cell[1] + j) * grid.spacing[1]});
  }
}

/// The part of the segment, as shares of its length, that lies within a convex polygon by more than `near` from its
/// edges; the first is not below the second where there is none.
std::array<double, 2> part_within(const Polygon& corners, const std::array<Vec<2>, 2>& segment, double near) {
  double from = 0, to = 1;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec<2>&a = corners[i], &b = corners[(i + 1) % corners.size()];
    const Vec<2> along = detail::minus(b, a);
    const double length = std::hypot(along[0], along[1]);
    // How far inside the edge each end of the segment is.
    const double start = detail::cross(along, detail::minus(segment[0], a)) / length - near;
    const double end = detail::cross(along, detail::minus(segment[1], a)) / length - near;
    if (start <= 0 && end <= 0) return {1, 0};
    if (start < 0) from = std::max(from, start / (start - end));
    if (end < 0) to = std::min(to, start / (start - end));
  }
  return {from, to};
}

/// Where the edges of an element meet the plane x[axis] = at, as corners of a convex polygon in the other two axes;
/// none unless it has nodes further than `near` on both sides.
template <class Shape>
Polygon section_of(const NodePositions<Shape>& x, int axis, double at, double near) {
  const auto [i, j] = section_axes(axis);
  double low = 0, high = 0;
  for (const auto& corner : x) {
    low = std::min(low, corner[axis] - at);
    high = std::max(high, corner[axis] - at);
  }
  Polygon section;
  if (low > -near || high < near) return section;
  for (int a = 0; a < Shape::nodes; ++a) {
    for (const int b : Shape::corners[a]) {
      const double from = x[a][axis] - at, to = x[b][axis] - at;
      if (!(from <= 0 && to > 0)) continue;
      const double t = from / (from - to);
      section.push_back({x[a][i] + t * (x[b][i] - x[a][i]), x[a][j] + t * (x[b][j] - x[a][j])});
    }
  }
  Vec<2> middle{};
  for (const auto& corner : section)
    for (int k = 0; k < 2; ++k) middle[k] += corner[k] / static_cast<double>(section.size());
  std::sort(section.begin(), section.end(), [&](const Vec<2>& p, const Vec<2>& q) {
    return std::atan2(p[1] - middle[1], p[0] - middle[0]) < std::atan2(q[1] - middle[1], q[0] - middle[0]);
  });
  return section;
}

}  // namespace

double nearness(const Mesh<2>& mesh, const std::array<Vec<2>, 2>& segment) {
  const double length = std::hypot(segment[1][0] - segment[0][0], segment[1][1] - segment[0][1]);
  return std::max(1e-9 * length, slack * least_size(mesh));
}

std::optional<Vec<2>> cut_element(const Mesh<2>& mesh, const std::array<Vec<2>, 2>& segment) {
  const double near = nearness(mesh, segment);
  const double length = std::hypot(segment[1][0] - segment[0][0], segment[1][1] - segment[0][1]);
  Box box;
  for (int k = 0; k < 2; ++k) std::tie(box.low[k], box.high[k]) = std::minmax(segment[0][k], segment[1][k]);
  Polygon corners;
  std::optional<Vec<2>> cut;
  for_elements_near(mesh, box, [&](int e) {
    if (cut) return;
    corners_of(mesh, e, corners);
    const auto [from, to] = part_within(corners, segment, near);
    if (!((to - from) * length > near)) return;
    const double t = 0.5 * (from + to);
    cut = Vec<2>{segment[0][0] + t * (segment[1][0] - segment[0][0]),
                 segment[0][1] + t * (segment[1][1] - segment[0][1])};
  });
  return cut;
}

std::optional<Vec<3>> cut_element(const Mesh<3>& mesh, const std::array<Vec<3>, 2>& box) {
  int flat = 0, axis = 0;
  for (int k = 0; k < 3; ++k) {
    if (box[0][k] != box[1][k]) continue;
    ++flat;
    axis = k;
  }
  if (mesh.grid || flat != 1) return {};
  const auto [i, j] = section_axes(axis);
  for (int e = 0; e < mesh.element_count(); ++e) {
    const Polygon section = with_shape<3>(mesh.type_of(e), [&]<class Shape>(Shape) {
      return section_of<Shape>(node_positions<Shape>(mesh, e), axis, box[0][axis], slack * mesh.size_of(e));
    });
    if (section.size() < 3) continue;
    const Moments part = moments(clip_to_box(section, {box[0][i], box[0][j]}, {box[1][i], box[1][j]}));
    if (!(part.area > slack * mesh.size_of(e) * mesh.size_of(e))) continue;
    Vec<3> x;
    x[axis] = box[0][axis];
    x[i] = part.centroid[0];
    x[j] = part.centroid[1];
    return x;
  }
  return {};
}

}  // namespace scarp::run
