#include "scarp/mesh/shapes/valid.hpp"

namespace scarp {
namespace {

/// Values at -1, 0, 1 of a polynomial of second degree to its Bernstein coefficients on [-1, 1].
void to_bernstein(double& low, double& middle, double& high) {
  middle = 2 * middle - 0.5 * (low + high);
}

bool positive_in_part(const H8::Map& map, const Vec<3>& centre, double half, double least) {
  std::array<double, 27> J;
  bool positive = true;
  for (int i = 0; i < 27; ++i) {
    const Vec<3> xi = {centre[0] + half * (i % 3 - 1), centre[1] + half * (i / 3 % 3 - 1),
                       centre[2] + half * (i / 9 - 1)};
    const std::array<Vec<3>, 3> by = map.derivative(xi);
    J[i] = detail::dot(by[0], detail::cross(by[1], by[2]));
    positive = positive && J[i] > least;
  }
  if (!positive) return false;
  for (int stride : {1, 3, 9})
    for (int i = 0; i < 27; ++i)
      if (i / stride % 3 == 0) to_bernstein(J[i], J[i + stride], J[i + 2 * stride]);
  if (*std::min_element(J.begin(), J.end()) > least) return true;
  if (half < 0.04) return false;
  for (int part = 0; part < 8; ++part) {
    Vec<3> at = centre;
    for (int k = 0; k < 3; ++k) at[k] += (part >> k) & 1 ? 0.5 * half : -0.5 * half;
    if (!positive_in_part(map, at, 0.5 * half, least)) return false;
  }
  return true;
}

}  // namespace

bool positive_throughout(const NodePositions<H8>& x_nodes) {
  double longest = 0;
  for (int i = 0; i < H8::nodes; ++i)
    for (int j : H8::corners[i]) longest = std::max(longest, detail::norm(detail::minus(x_nodes[j], x_nodes[i])));
  return positive_in_part(H8::Map(x_nodes), {0, 0, 0}, 1, 1e-6 * 0.125 * longest * longest * longest);
}

}  // namespace scarp
