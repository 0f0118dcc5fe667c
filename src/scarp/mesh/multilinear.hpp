// Products of linear functions along each axis: the shape functions of rectangles, quadrilaterals and their kin in
// space.
#pragma once

#include <array>

#include "scarp/base/vec.hpp"
#include "scarp/tensor/batch.hpp"

namespace scarp::detail {

/// Is local node i of a quadrilateral or hexahedron on the far side along axis d? (0,0), (1,0), (1,1), (0,1), and again
/// above.
constexpr bool far_side(int i, int d) {
  return d == 0 ? (i & 3) == 1 || (i & 3) == 2 : d == 1 ? (i & 2) != 0 : i >= 4;
}

/// Two Gauss points along each axis of the unit box, of weight 2^−Dim each: exact to the third degree along each axis.
inline constexpr double gauss_of_unit[2] = {0.21132486540518711775, 0.78867513459481288225};
template <int Dim>
constexpr Vec<Dim> gauss_of_box(int q) {
  Vec<Dim> s{};
  for (int d = 0; d < Dim; ++d) s[d] = gauss_of_unit[far_side(q, d)];
  return s;
}

/// Products of 1 − s and s on the unit box.
template <int Dim, class T>
inline void multilinear(const std::array<T, Dim>& s, std::array<T, (1 << Dim)>& N) {
  std::array<T, Dim> r;
  for (int d = 0; d < Dim; ++d) r[d] = T(1.0) - s[d];
  for (int i = 0; i < (1 << Dim); ++i) {
    T product = far_side(i, 0) ? s[0] : r[0];
    for (int d = 1; d < Dim; ++d) product = product * (far_side(i, d) ? s[d] : r[d]);
    N[i] = product;
  }
}

/// dN_i/ds_d times scale[d].
template <int Dim, class T>
inline void multilinear_gradients(const std::array<T, Dim>& s, const Vec<Dim>& scale,
                                  std::array<std::array<T, Dim>, (1 << Dim)>& dN) {
  for (int d = 0; d < Dim; ++d) {
    std::array<T, Dim> far, near;
    for (int k = 0; k < Dim; ++k) {
      far[k] = s[k];
      near[k] = T(1.0) - s[k];
    }
    far[d] = T(scale[d]);
    near[d] = T(-scale[d]);
    for (int i = 0; i < (1 << Dim); ++i) {
      T product = far_side(i, 0) ? far[0] : near[0];
      for (int k = 1; k < Dim; ++k) product = product * (far_side(i, k) ? far[k] : near[k]);
      dN[i][d] = product;
    }
  }
}

}  // namespace scarp::detail
