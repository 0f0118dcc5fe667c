// Local coordinates in hexahedra where Newton's method from the centre fails.
#include "scarp/mesh/shapes/solid.hpp"

namespace scarp {
namespace {

/// Points as far outside as this part of an element's extent are found: more than any tolerance of a search.
constexpr double margin = 1e-5;

}  // namespace

bool H8::search_part(const Map& map, const Vec<3>& r, const Vec<3>& centre, double half, Vec<3>& xi) {
  Vec<3> low, high;
  for (int corner = 0; corner < 8; ++corner) {
    Vec<3> at = centre;
    for (int k = 0; k < 3; ++k) at[k] += (corner >> k) & 1 ? half : -half;
    const Vec<3> x = map.value(at);
    for (int k = 0; k < 3; ++k) {
      low[k] = corner == 0 ? x[k] : std::min(low[k], x[k]);
      high[k] = corner == 0 ? x[k] : std::max(high[k], x[k]);
    }
  }
  const double near = margin * std::max({high[0] - low[0], high[1] - low[1], high[2] - low[2]}) / half;
  for (int k = 0; k < 3; ++k)
    if (!(r[k] >= low[k] - near && r[k] <= high[k] + near)) return false;
  double J;
  xi = centre;
  if (newton(map, r, xi, J) && J > 0 && beyond(xi) < margin) return true;
  if (half < 0.2) return false;
  for (int part = 0; part < 8; ++part) {
    Vec<3> at = centre;
    for (int k = 0; k < 3; ++k) at[k] += (part >> k) & 1 ? 0.5 * half : -0.5 * half;
    if (search_part(map, r, at, 0.5 * half, xi)) return true;
  }
  return false;
}

Vec<3> H8::search_parts(const Map& map, const NodePositions<H8>& x_nodes, const Vec<3>& x) {
  Vec<3> xi;
  if (search_part(map, detail::minus(x, x_nodes[0]), {0, 0, 0}, 1, xi)) return xi;
  return {far, far, far};
}

}  // namespace scarp
