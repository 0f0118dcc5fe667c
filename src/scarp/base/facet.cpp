#include "scarp/base/facet.hpp"

#include <algorithm>

namespace scarp {
namespace {

/// Where the edge from a below the plane to b above it meets the plane; always computed from below, whichever way round
/// the facet runs, and never outside the edge, so that a cut facet stays convex.
Vec<3> crossing(const Vec<3>& a, const Vec<3>& b, int axis, double at) {
  const double t = (at - a[axis]) / (b[axis] - a[axis]);
  Vec<3> x;
  for (int j = 0; j < 3; ++j) {
    x[j] = std::clamp(a[j] + t * (b[j] - a[j]), std::min(a[j], b[j]), std::max(a[j], b[j]));
  }
  x[axis] = at;
  return x;
}

Vec<3> between(const Vec<3>& a, const Vec<3>& b) {
  return {0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1]), 0.5 * (a[2] + b[2])};
}

}  // namespace

void cut(const Facet& whole, int axis, double at, Facet& below, Facet& above) {
  below.size = above.size = 0;
  bool any_below = false, any_above = false;
  for (int i = 0; i < whole.size; ++i) {
    any_below = any_below || whole.corner[i][axis] < at;
    any_above = any_above || whole.corner[i][axis] > at;
  }
  if (!any_above) {
    below = whole;
    return;
  }
  if (!any_below) {
    above = whole;
    return;
  }
  for (int i = 0; i < whole.size; ++i) {
    const Vec<3>&a = whole.corner[i], &b = whole.corner[i + 1 < whole.size ? i + 1 : 0];
    if (a[axis] <= at) below.corner[below.size++] = a;
    if (a[axis] >= at) above.corner[above.size++] = a;
    if ((a[axis] < at && b[axis] > at) || (a[axis] > at && b[axis] < at)) {
      const Vec<3> x = a[axis] < at ? crossing(a, b, axis, at) : crossing(b, a, axis, at);
      below.corner[below.size++] = x;
      above.corner[above.size++] = x;
    }
  }
}

FacetMoments moments(const Facet& facet, const Vec<3>& origin) {
  FacetMoments sum;
  const auto local = [&](int i) {
    return Vec<3>{facet.corner[i][0] - origin[0], facet.corner[i][1] - origin[1], facet.corner[i][2] - origin[2]};
  };
  const Vec<3> a = local(0);
  Vec<3> b = local(1);
  for (int i = 2; i < facet.size; ++i) {
    const Vec<3> c = local(i);
    const double third = ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])) / 6;
    // The middles of the edges, each with a third of the area: exact to degree two.
    for (const Vec<3>& middle : {between(a, b), between(b, c), between(c, a)}) {
      const auto& [x, y, z] = middle;
      sum.area += third;
      sum.x += third * x;
      sum.y += third * y;
      sum.z += third * z;
      sum.xz += third * x * z;
      sum.yz += third * y * z;
      sum.half_zz += 0.5 * third * z * z;
    }
    b = c;
  }
  return sum;
}

}  // namespace scarp
