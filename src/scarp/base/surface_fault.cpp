// Are triangles the surface of a solid?
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <utility>

#include "scarp/base/surface.hpp"

namespace scarp {
namespace {

std::string shown(const Vec<3>& x) {
  return fmt::format("({:g}, {:g}, {:g})", x[0], x[1], x[2]);
}

Vec<3> minus(const Vec<3>& a, const Vec<3>& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

double dot(const Vec<3>& a, const Vec<3>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

Vec<3> cross(const Vec<3>& a, const Vec<3>& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

std::optional<SurfaceFault> without_area(std::span<const Triangle> triangles) {
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const auto& [a, b, c] = triangles[t];
    const Vec<3> ab = minus(b, a), bc = minus(c, b), ca = minus(a, c), normal = cross(ab, bc);
    const double longest2 = std::max({dot(ab, ab), dot(bc, bc), dot(ca, ca)});
    if (std::sqrt(dot(normal, normal)) > 1e-12 * longest2) continue;
    return SurfaceFault{"a triangle of the surface has no area",
                        fmt::format("corners {}, {}, {}", shown(a), shown(b), shown(c)),
                        "remove triangles without area where the surface was made, and write it again", t};
  }
  return {};
}

/// One side of a triangle, from its corner `side` to the next; its ends numbered over the surface.
struct Edge {
  int low, high, triangle, side;
  bool upward;  ///< runs from the lower number to the higher
};

/// Sorted so that the sides along the same edge stand together.
std::vector<Edge> edges_of(std::span<const Triangle> triangles) {
  std::map<Vec<3>, int> number;
  std::vector<Edge> edges;
  edges.reserve(3 * triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    std::array<int, 3> corner;
    for (int i = 0; i < 3; ++i)
      corner[i] = number.try_emplace(triangles[t][i], static_cast<int>(number.size())).first->second;
    for (int i = 0; i < 3; ++i) {
      const int a = corner[i], b = corner[(i + 1) % 3];
      edges.push_back({std::min(a, b), std::max(a, b), static_cast<int>(t), i, a < b});
    }
  }
  std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) {
    return std::array{a.low, a.high, a.triangle} < std::array{b.low, b.high, b.triangle};
  });
  return edges;
}

/// Every edge has two triangles, which pass it in opposite ways.
std::optional<SurfaceFault> bad_edge(std::span<const Triangle> triangles, const std::vector<Edge>& edges) {
  for (std::size_t first = 0, next; first < edges.size(); first = next) {
    for (next = first;
         next < edges.size() && edges[next].low == edges[first].low && edges[next].high == edges[first].high;) {
      ++next;
    }
    const std::size_t count = next - first;
    if (count == 2 && edges[first].upward != edges[first + 1].upward) continue;
    const Edge& edge = edges[next - 1];
    const auto& triangle = triangles[edge.triangle];
    const auto value =
        fmt::format("{} at the edge {}-{}", count == 1 ? "one triangle" : fmt::format("{} triangles", count),
                    shown(triangle[edge.side]), shown(triangle[(edge.side + 1) % 3]));
    const auto at = static_cast<std::size_t>(edge.triangle);
    if (count == 1)
      return SurfaceFault{"the surface is not closed: each of its edges has two triangles", value,
                          "close its holes; corners that belong together must have the same coordinates to the last "
                          "digit",
                          at};
    if (count > 2)
      return SurfaceFault{"more than two triangles of the surface meet at an edge", value,
                          "remove triangles that are there twice; give parts that touch along an edge as regions of "
                          "their own",
                          at};
    return SurfaceFault{"neighbouring triangles of the surface are turned against each other", value,
                        "list the corners of all triangles anticlockwise seen from outside", at};
  }
  return {};
}

/// Six times the volume of a tetrahedron, or 0 within round-off.
double orientation(const Vec<3>& a, const Vec<3>& b, const Vec<3>& c, const Vec<3>& d) {
  const Vec<3> ab = minus(b, a), ac = minus(c, a), ad = minus(d, a);
  const double six = dot(cross(ab, ac), ad);
  return six * six > 1e-24 * dot(ab, ab) * dot(ac, ac) * dot(ad, ad) ? six : 0.0;
}

/// Does the segment p-q pass through the inside of the triangle?
bool pierces(const Vec<3>& p, const Vec<3>& q, const Triangle& t) {
  if (!(orientation(t[0], t[1], t[2], p) * orientation(t[0], t[1], t[2], q) < 0)) return false;
  const double a = orientation(p, q, t[0], t[1]), b = orientation(p, q, t[1], t[2]), c = orientation(p, q, t[2], t[0]);
  return (a > 0 && b > 0 && c > 0) || (a < 0 && b < 0 && c < 0);
}

bool pass_through(const Triangle& s, const Triangle& t) {
  for (int i = 0; i < 3; ++i) {
    if (pierces(s[i], s[(i + 1) % 3], t) || pierces(t[i], t[(i + 1) % 3], s)) return true;
  }
  return false;
}

BoxOf<3> bounds_of(const Triangle& t) {
  BoxOf<3> box;
  for (int j = 0; j < 3; ++j) {
    box.low[j] = std::min({t[0][j], t[1][j], t[2][j]});
    box.high[j] = std::max({t[0][j], t[1][j], t[2][j]});
  }
  return box;
}

/// Sweeps along x over the triangles' bounding boxes.
std::optional<SurfaceFault> self_crossing(std::span<const Triangle> triangles) {
  std::vector<BoxOf<3>> box;
  for (const auto& triangle : triangles) box.push_back(bounds_of(triangle));
  std::vector<int> order(triangles.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](int a, int b) { return box[a].low[0] < box[b].low[0]; });
  for (std::size_t i = 0; i < order.size(); ++i) {
    const auto& a = box[order[i]];
    for (std::size_t k = i + 1; k < order.size() && box[order[k]].low[0] <= a.high[0]; ++k) {
      const auto& b = box[order[k]];
      if (a.low[1] > b.high[1] || b.low[1] > a.high[1] || a.low[2] > b.high[2] || b.low[2] > a.high[2]) continue;
      const Triangle &s = triangles[order[i]], &t = triangles[order[k]];
      if (!pass_through(s, t)) continue;
      return SurfaceFault{"two triangles of the surface pass through each other",
                          fmt::format("{}, {}, {} and {}, {}, {}", shown(s[0]), shown(s[1]), shown(s[2]), shown(t[0]),
                                      shown(t[1]), shown(t[2])),
                          "make one surface of parts that overlap (their union), and write it again",
                          static_cast<std::size_t>(std::max(order[i], order[k]))};
    }
  }
  return {};
}

/// The part of the surface that each triangle belongs to, as one of its triangles.
std::vector<int> parts_of(std::size_t count, const std::vector<Edge>& edges) {
  std::vector<int> part(count);
  std::iota(part.begin(), part.end(), 0);
  const auto root = [&](int t) {
    while (part[t] != t) t = part[t] = part[part[t]];
    return t;
  };
  for (std::size_t e = 0; e + 1 < edges.size(); e += 2) part[root(edges[e].triangle)] = root(edges[e + 1].triangle);
  for (std::size_t t = 0; t < count; ++t) part[t] = root(static_cast<int>(t));
  return part;
}

/// Parts side by side are turned alike, one inside another against it: a vertical line goes in and out by turns.
std::optional<SurfaceFault> bad_part(std::span<const Triangle> triangles, const std::vector<Edge>& edges) {
  std::map<int, std::pair<double, std::size_t>> flattest;  // of each part: the largest area in plan, and whose it is
  const auto part = parts_of(triangles.size(), edges);
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const auto& [a, b, c] = triangles[t];
    const double area = std::abs(cross(minus(b, a), minus(c, a))[2]);
    auto& [largest, whose] = flattest[part[t]];
    if (area > largest) largest = area, whose = t;
  }
  if (flattest.size() < 2) return {};
  const Surface surface({triangles.begin(), triangles.end()});
  for (const auto& [root, found] : flattest) {
    const auto& [a, b, c] = triangles[found.second];
    bool inside = false;
    for (const auto& crossing : surface.crossings((a[0] + b[0] + c[0]) / 3, (a[1] + b[1] + c[1]) / 3)) {
      if (crossing.leaves == inside) {
        inside = !inside;
        continue;
      }
      return SurfaceFault{"a part of the surface is turned against the others, or inside one that is turned like it",
                          fmt::format("a vertical line through {} that does not go in and out by turns", shown(a)),
                          "turn all triangles of that part; those of a cavity face its inside", found.second};
    }
  }
  return {};
}

}  // namespace

std::optional<SurfaceFault> surface_fault(std::span<const Triangle> triangles) {
  if (triangles.empty()) return SurfaceFault{"the surface has triangles", "none", "write a closed surface", 0};
  if (auto fault = without_area(triangles)) return fault;
  const auto edges = edges_of(triangles);
  if (auto fault = bad_edge(triangles, edges)) return fault;
  if (auto fault = self_crossing(triangles)) return fault;
  return bad_part(triangles, edges);
}

}  // namespace scarp
