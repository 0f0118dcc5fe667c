// Bases: the functions N_i that carry fields from the nodes to the points of an element and back. A basis B has
// (mesh/basis_concept.hpp names what one lacks)
//   B::dim, B::nodes         the dimension and the number of local nodes that a point of an element touches
//   B::stores_local          whether points keep their local coordinates (where finding them is dear)
//   B::Cell(mesh, e)         what it knows of element e, made once per element and sweep, with
//     local(x)               local coordinates of x (where the basis does not store them); or
//     follow(x, local)       local coordinates of x from those of a point nearby; where that worked
//     inside(local, tol)     is that in the element, or beyond it by no more than tol parts of its height? tol: one
//                            number, or one for each of its B::sides: opposite node 0, 1, ... of a simplex; the lower
//                            and the upper side along each axis in turn of others (mesh/shapes.hpp: side_of)
//     shape(local, N)        N_i
//     gradients(local, N, B) N_i and B_i = dN_i/dx
//     integrals(V, g)        the element's volume V and g_i = ∫ B_i dV over it (where the basis is corrected)
//     for_gauss(f)           f(local, dV) for points that integrate x N_i and x B_i over it exactly (there, too)
// all on T: double, or a SIMD batch with a point in each lane. And it says of itself
//   B::has_domains           whether a point is a box: local(x, half) then takes half its edge [m], and what it returns
//                            goes to shape() and gradients(); local(x), without it, still to inside()
//   B::corrects              whether an element's points are made its quadrature (transfer/quadrature.hpp)
// The element is a cell of the geometry; its local nodes, Mesh::element_nodes, are those of its functions.
#pragma once

#include <array>
#include <cmath>
#include <concepts>

#include "scarp/mesh/grid_bases.hpp"
#include "scarp/mesh/mesh.hpp"
#include "scarp/mesh/multilinear.hpp"
#include "scarp/mesh/shapes.hpp"
#include "scarp/tensor/batch.hpp"

namespace scarp {

namespace detail {

/// a b − c d. Of single numbers with the first product in one rounding with the difference where the processor has
/// that: a compiler fuses either, in one sweep the one and in another the other, and an element would have two
/// determinants.
template <class T>
inline T difference_of_products(const T& a, const T& b, const T& c, const T& d) {
#if defined(__FMA__)
  if constexpr (std::is_same_v<T, double>) return std::fma(a, b, -(c * d));
#endif
  return a * b - c * d;
}

/// Inverse of the matrix J[j][k] = dx_j/dξ_k; returns det J.
template <class T>
inline T inverse(const std::array<std::array<T, 2>, 2>& J, std::array<std::array<T, 2>, 2>& I) {
  const T det = difference_of_products(J[0][0], J[1][1], J[0][1], J[1][0]), r = T(1.0) / det;
  I = {{{J[1][1] * r, -(J[0][1] * r)}, {-(J[1][0] * r), J[0][0] * r}}};
  return det;
}
template <class T>
inline T inverse(const std::array<std::array<T, 3>, 3>& J, std::array<std::array<T, 3>, 3>& I) {
  const auto minor = [&](int a, int b, int c, int d) {
    return difference_of_products(J[a][c], J[b][d], J[a][d], J[b][c]);
  };
  const T x = minor(1, 2, 1, 2), y = minor(1, 2, 2, 0), z = minor(1, 2, 0, 1);
  const T det = J[0][0] * x + J[0][1] * y + J[0][2] * z, r = T(1.0) / det;
  I = {{{x * r, minor(2, 0, 1, 2) * r, minor(0, 1, 1, 2) * r},
        {y * r, minor(2, 0, 2, 0) * r, minor(0, 1, 2, 0) * r},
        {z * r, minor(2, 0, 0, 1) * r, minor(0, 1, 0, 1) * r}}};
  return det;
}

}  // namespace detail

/// The linear functions of an element type of a mesh.
template <class Shape>
struct Linear;

namespace detail {

/// Triangles and tetrahedra: B_i are constant, and local coordinates linear in x.
template <int Dim>
struct Simplex {
  static constexpr int dim = Dim, nodes = Dim + 1, sides = Dim + 1;
  static constexpr bool stores_local = false, has_domains = false, corrects = true;

  class Cell {
   public:
    [[gnu::always_inline]] Cell(const Mesh<Dim>& mesh, int e) {
      const auto n = mesh.element_nodes(e);
      low_ = mesh.node(n[0]);
      std::array<Vec<Dim>, Dim> J;
      for (int j = 0; j < Dim; ++j) {
        for (int k = 0; k < Dim; ++k) J[j][k] = mesh.node(n[k + 1])[j] - low_[j];
      }
      det_ = inverse(J, inverse_);
      for (int j = 0; j < Dim; ++j) {
        B_[0][j] = 0;
        for (int k = 0; k < Dim; ++k) {
          B_[k + 1][j] = inverse_[k][j];
          B_[0][j] -= inverse_[k][j];
        }
      }
    }

    template <class T>
    std::array<T, Dim> local(const std::array<T, Dim>& x) const {
      std::array<T, Dim> xi;
      for (int k = 0; k < Dim; ++k) {
        xi[k] = T(inverse_[k][0]) * (x[0] - T(low_[0]));
        for (int j = 1; j < Dim; ++j) xi[k] = xi[k] + T(inverse_[k][j]) * (x[j] - T(low_[j]));
      }
      return xi;
    }

    template <class T>
    Mask<T> inside(const std::array<T, Dim>& xi, double tolerance) const {
      T sum = xi[0];
      Mask<T> yes = xi[0] >= T(-tolerance);
      for (int d = 1; d < Dim; ++d) {
        sum = sum + xi[d];
        yes = yes && (xi[d] >= T(-tolerance));
      }
      return yes && (sum <= T(1 + tolerance));
    }

    template <class T>
    Mask<T> inside(const std::array<T, Dim>& xi, const std::array<double, sides>& tolerance) const {
      T sum = xi[0];
      Mask<T> yes = xi[0] >= T(-tolerance[1]);
      for (int d = 1; d < Dim; ++d) {
        sum = sum + xi[d];
        yes = yes && (xi[d] >= T(-tolerance[d + 1]));
      }
      return yes && (sum <= T(1 + tolerance[0]));
    }

    template <class T>
    void shape(const std::array<T, Dim>& xi, std::array<T, nodes>& N) const {
      N[0] = T(1.0) - xi[0];
      for (int d = 1; d < Dim; ++d) N[0] = N[0] - xi[d];
      for (int d = 0; d < Dim; ++d) N[d + 1] = xi[d];
    }

    template <class T>
    void gradients(const std::array<T, Dim>& xi, std::array<T, nodes>& N,
                   std::array<std::array<T, Dim>, nodes>& B) const {
      shape(xi, N);
      for (int i = 0; i < nodes; ++i) {
        for (int j = 0; j < Dim; ++j) B[i][j] = T(B_[i][j]);
      }
    }

    void integrals(double& V, std::array<Vec<Dim>, nodes>& g) const {
      V = det_ / (Dim == 2 ? 2 : 6);
      for (int i = 0; i < nodes; ++i) {
        for (int j = 0; j < Dim; ++j) g[i][j] = V * B_[i][j];
      }
    }

    const Vec<Dim>& low() const { return low_; }                                  ///< node 0
    const std::array<Vec<Dim>, nodes>& constant_gradients() const { return B_; }  ///< B_i

    /// The middles of the edges, exact for quadratics (Dim = 2), or four points inside, as exact (Dim = 3).
    template <class F>
    void for_gauss(F&& f) const {
      constexpr double a = Dim == 2 ? 0.5 : 0.13819660112501051518, b = Dim == 2 ? 0.0 : 0.58541019662496845446;
      for (int q = 0; q < nodes; ++q) {
        Vec<Dim> xi;
        xi.fill(a);
        if (q > 0) xi[q - 1] = b;
        f(xi, det_ / ((Dim == 2 ? 2 : 6) * nodes));
      }
    }

   private:
    Vec<Dim> low_;
    double det_;
    std::array<Vec<Dim>, Dim> inverse_;
    std::array<Vec<Dim>, nodes> B_;
  };
};

/// Quadrilaterals and hexahedra of any shape. Points store their local coordinates, from −1 to 1.
template <int Dim>
struct Box {
  static constexpr int dim = Dim, nodes = 1 << Dim, sides = 2 * Dim;
  static constexpr bool stores_local = true, has_domains = false, corrects = true;

  class Cell {
   public:
    Cell(const Mesh<Dim>& mesh, int e) {
      const auto n = mesh.element_nodes(e);
      for (int i = 0; i < nodes; ++i) corner_[i] = mesh.lists.nodes[n[i]].data();
    }

    /// Newton's method from xi, the local coordinates of a point of the element not far from x. Convergence is
    /// quadratic: after a step of 1e-9 nothing but round-off is left. `wanted(mask)` says whether all that matter are
    /// in.
    template <class T, class F>
    Mask<T> follow(const std::array<T, Dim>& x, std::array<T, Dim>& xi, F&& wanted) const {
      std::array<T, Dim> s = unit(xi);
      Mask<T> good = s[0] != s[0];
      for (int iteration = 0; iteration < 6 && !wanted(good); ++iteration) {
        std::array<T, nodes> N;
        multilinear<Dim>(s, N);
        std::array<T, Dim> off = x;
        for (int j = 0; j < Dim; ++j) {
          for (int i = 0; i < nodes; ++i) off[j] = off[j] - N[i] * T(corner_[i][j]);
        }
        std::array<std::array<T, Dim>, nodes> dN;
        std::array<std::array<T, Dim>, Dim> I;
        good = jacobian(s, dN, I) > T(0.0);
        for (int k = 0; k < Dim; ++k) {
          T step = I[k][0] * off[0];
          for (int j = 1; j < Dim; ++j) step = step + I[k][j] * off[j];
          s[k] = s[k] + step;
          good = good && (abs(step) < T(1e-9));
        }
      }
      for (int k = 0; k < Dim; ++k) xi[k] = T(2.0) * s[k] - T(1.0);
      return good;
    }

    template <class T>
    Mask<T> inside(const std::array<T, Dim>& xi, double tolerance) const {
      Mask<T> yes = abs(xi[0]) <= T(1 + 2 * tolerance);
      for (int d = 1; d < Dim; ++d) yes = yes && (abs(xi[d]) <= T(1 + 2 * tolerance));
      return yes;
    }

    template <class T>
    Mask<T> inside(const std::array<T, Dim>& xi, const std::array<double, sides>& tolerance) const {
      return in_unit_box<Dim>(unit(xi), tolerance);
    }

    template <class T>
    void shape(const std::array<T, Dim>& xi, std::array<T, nodes>& N) const {
      multilinear<Dim>(unit(xi), N);
    }

    template <class T>
    void gradients(const std::array<T, Dim>& xi, std::array<T, nodes>& N,
                   std::array<std::array<T, Dim>, nodes>& B) const {
      const auto s = unit(xi);
      multilinear<Dim>(s, N);
      jacobian_and_gradients(s, B);
    }

    void integrals(double& V, std::array<Vec<Dim>, nodes>& g) const {
      // Two Gauss points along each axis are exact: det J dN/dx is of second degree in each local coordinate. A Gauss
      // point in each lane.
      using T = PointBatch<Dim>;
      constexpr int W = lanes_of<T>;
      constexpr std::size_t numbers = whole_batches<T>(1 + nodes * Dim);
      alignas(64) std::array<double, numbers> sums{};
      for (int first = 0; first < nodes; first += W) {
        std::array<T, Dim> s;
        for (int d = 0; d < Dim; ++d) {
          double lanes[W];
          for (int l = 0; l < W; ++l) lanes[l] = gauss_of_unit[far_side(first + l, d)];
          s[d] = T::load_unaligned(lanes);
        }
        std::array<std::array<T, Dim>, nodes> B;
        const T part = T(1.0 / nodes) * jacobian_and_gradients(s, B);
        std::array<T, numbers> values;
        values.fill(T(0.0));
        values[0] = part;
        for (int i = 0; i < nodes; ++i) {
          for (int j = 0; j < Dim; ++j) values[1 + i * Dim + j] = part * B[i][j];
        }
        add_lanes(values, sums.data());
      }
      V = sums[0];
      for (int i = 0; i < nodes; ++i) {
        for (int j = 0; j < Dim; ++j) g[i][j] = sums[1 + i * Dim + j];
      }
    }

    template <class F>
    void for_gauss(F&& f) const {
      for (int q = 0; q < nodes; ++q) {
        const Vec<Dim> s = gauss_of_box<Dim>(q);
        std::array<Vec<Dim>, nodes> B;
        Vec<Dim> xi;
        for (int d = 0; d < Dim; ++d) xi[d] = 2 * s[d] - 1;
        f(xi, jacobian_and_gradients(s, B) / nodes);
      }
    }

    const double* corner(int i) const { return corner_[i]; }  ///< position of node i, where the mesh keeps it

    /// From −1 ... 1 to 0 ... 1.
    template <class T>
    static std::array<T, Dim> unit(const std::array<T, Dim>& xi) {
      std::array<T, Dim> s;
      for (int d = 0; d < Dim; ++d) s[d] = T(0.5) * (T(1.0) + xi[d]);
      return s;
    }

   private:
    /// dN_i/ds and ds/dx at s; returns det dx/ds.
    template <class T>
    T jacobian(const std::array<T, Dim>& s, std::array<std::array<T, Dim>, nodes>& dN,
               std::array<std::array<T, Dim>, Dim>& I) const {
      Vec<Dim> one;
      one.fill(1.0);
      multilinear_gradients<Dim>(s, one, dN);
      std::array<std::array<T, Dim>, Dim> J;
      for (int j = 0; j < Dim; ++j) {
        for (int k = 0; k < Dim; ++k) {
          J[j][k] = T(corner_[0][j]) * dN[0][k];
          for (int i = 1; i < nodes; ++i) J[j][k] = J[j][k] + T(corner_[i][j]) * dN[i][k];
        }
      }
      return inverse(J, I);
    }

    template <class T>
    T jacobian_and_gradients(const std::array<T, Dim>& s, std::array<std::array<T, Dim>, nodes>& B) const {
      std::array<std::array<T, Dim>, nodes> dN;
      std::array<std::array<T, Dim>, Dim> I;
      const T det = jacobian(s, dN, I);
      for (int i = 0; i < nodes; ++i) {
        for (int j = 0; j < Dim; ++j) {
          B[i][j] = dN[i][0] * I[0][j];
          for (int k = 1; k < Dim; ++k) B[i][j] = B[i][j] + dN[i][k] * I[k][j];
        }
      }
      return det;
    }

    std::array<const double*, nodes> corner_;
  };
};

}  // namespace detail

template <>
struct Linear<T3> : detail::Simplex<2> {};
template <>
struct Linear<Q4> : detail::Box<2> {};
template <>
struct Linear<T4> : detail::Simplex<3> {};
template <>
struct Linear<H8> : detail::Box<3> {};

/// Triangles and tetrahedra: B_i are constant.
template <class B>
inline constexpr bool is_simplex = B::nodes == B::dim + 1;

/// Does the basis describe the meridian plane of a body of revolution (mesh/axisymmetric.hpp)?
template <class B>
inline constexpr bool is_axisymmetric = requires {
  B::axisymmetric;
};

}  // namespace scarp
