// The shape functions of structured grids: products of functions of one coordinate. Local coordinates run from 0 to 1
// in each cell.
#pragma once

#include <array>

#include "scarp/mesh/mesh.hpp"
#include "scarp/mesh/multilinear.hpp"

namespace scarp {

namespace detail {

template <int Dim, class T>
inline Mask<T> in_unit_box(const std::array<T, Dim>& s, double tolerance) {
  Mask<T> yes = (s[0] >= T(-tolerance)) && (s[0] <= T(1 + tolerance));
  for (int d = 1; d < Dim; ++d) yes = yes && (s[d] >= T(-tolerance)) && (s[d] <= T(1 + tolerance));
  return yes;
}

/// The same with a tolerance for each side: the lower and the upper one along each axis in turn.
template <int Dim, class T>
inline Mask<T> in_unit_box(const std::array<T, Dim>& s, const std::array<double, 2 * Dim>& tolerance) {
  Mask<T> yes = (s[0] >= T(-tolerance[0])) && (s[0] <= T(1 + tolerance[1]));
  for (int d = 1; d < Dim; ++d) yes = yes && (s[d] >= T(-tolerance[2 * d])) && (s[d] <= T(1 + tolerance[2 * d + 1]));
  return yes;
}

constexpr int power(int base, int exponent) {
  return exponent == 0 ? 1 : base * power(base, exponent - 1);
}

/// Π_d f[d][i_d] for the places (i_x, i_y(, i_z)) of a lattice of `Each` along each axis, x fastest.
template <int Dim, int Each, class T>
inline void products(const std::array<std::array<T, Each>, Dim>& f, std::array<T, power(Each, Dim)>& N) {
  int i = 0;
  if constexpr (Dim == 2) {
    for (int y = 0; y < Each; ++y) {
      for (int x = 0; x < Each; ++x) N[i++] = f[0][x] * f[1][y];
    }
  } else {
    for (int z = 0; z < Each; ++z) {
      for (int y = 0; y < Each; ++y) {
        const T yz = f[1][y] * f[2][z];
        for (int x = 0; x < Each; ++x) N[i++] = f[0][x] * yz;
      }
    }
  }
}

/// Values and gradients of the products of f, whose derivatives along their own axes are g.
template <int Dim, int Each, class T>
inline void products(const std::array<std::array<T, Each>, Dim>& f, const std::array<std::array<T, Each>, Dim>& g,
                     std::array<T, power(Each, Dim)>& N, std::array<std::array<T, Dim>, power(Each, Dim)>& B) {
  int i = 0;
  if constexpr (Dim == 2) {
    for (int y = 0; y < Each; ++y) {
      for (int x = 0; x < Each; ++x, ++i) {
        N[i] = f[0][x] * f[1][y];
        B[i] = {g[0][x] * f[1][y], f[0][x] * g[1][y]};
      }
    }
  } else {
    for (int z = 0; z < Each; ++z) {
      for (int y = 0; y < Each; ++y) {
        const T yz = f[1][y] * f[2][z], dy = g[1][y] * f[2][z], dz = f[1][y] * g[2][z];
        for (int x = 0; x < Each; ++x, ++i) {
          N[i] = f[0][x] * yz;
          B[i] = {g[0][x] * yz, f[0][x] * dy, f[0][x] * dz};
        }
      }
    }
  }
}

/// f(local, dV) for the Gauss points of a cell, from one over its edges.
template <std::size_t Dim, class F>
inline void for_gauss_of_box(const std::array<double, Dim>& inverse, F&& f) {
  constexpr int points = 1 << Dim;
  double dV = 1.0 / points;
  for (const double per_edge : inverse) dV /= per_edge;
  for (int q = 0; q < points; ++q) f(gauss_of_box<static_cast<int>(Dim)>(q), dV);
}

/// Where a cell of a grid is.
template <int Dim>
struct GridCell {
  std::array<int, Dim> at;
  Vec<Dim> low, inverse;  ///< its lowest corner [m], and one over its edges [1/m]

  GridCell(const Grid<Dim>& grid, int e) : at(grid.cell(e)), inverse(grid.per_spacing) {
    for (int d = 0; d < Dim; ++d) low[d] = grid.origin[d] + at[d] * grid.spacing[d];
  }

  template <class T>
  std::array<T, Dim> local(const std::array<T, Dim>& x) const {
    std::array<T, Dim> s;
    for (int d = 0; d < Dim; ++d) s[d] = (x[d] - T(low[d])) * T(inverse[d]);
    return s;
  }
};

}  // namespace detail

/// Multilinear functions on a structured grid. Local coordinates run from 0 to 1; the Jacobian is diagonal and the same
/// everywhere, so that they follow straight from x.
template <int Dim>
struct GridLinear {
  static constexpr int dim = Dim, nodes = 1 << Dim, sides = 2 * Dim;
  static constexpr bool stores_local = false, has_domains = false, corrects = true;

  class Cell {
   public:
    Cell(const Mesh<Dim>& mesh, int e)
        : low_(mesh.grid->crossing(mesh.grid->cell(e))),  // a corner's lines are numbered as its cell
          spacing_(mesh.grid->spacing),
          inverse_(mesh.grid->per_spacing) {}

    template <class T>
    std::array<T, Dim> local(const std::array<T, Dim>& x) const {
      std::array<T, Dim> s;
      for (int d = 0; d < Dim; ++d) s[d] = (x[d] - T(low_[d])) * T(inverse_[d]);
      return s;
    }

    template <class T>
    Mask<T> inside(const std::array<T, Dim>& s, const auto& tolerance) const {
      return detail::in_unit_box<Dim>(s, tolerance);
    }

    template <class T>
    void shape(const std::array<T, Dim>& s, std::array<T, nodes>& N) const {
      detail::multilinear<Dim>(s, N);
    }

    template <class T>
    void gradients(const std::array<T, Dim>& s, std::array<T, nodes>& N,
                   std::array<std::array<T, Dim>, nodes>& B) const {
      detail::multilinear<Dim>(s, N);
      detail::multilinear_gradients<Dim>(s, inverse_, B);
    }

    void integrals(double& V, std::array<Vec<Dim>, nodes>& g) const {
      V = 1;
      for (int d = 0; d < Dim; ++d) V *= spacing_[d];
      for (int i = 0; i < nodes; ++i) {
        for (int d = 0; d < Dim; ++d) {
          g[i][d] = (detail::far_side(i, d) ? V : -V) * inverse_[d] * (2.0 / nodes);
        }
      }
    }

    template <class F>
    void for_gauss(F&& f) const {
      detail::for_gauss_of_box(inverse_, f);
    }

    const Vec<Dim>& low() const { return low_; }          ///< the corner where s = 0
    const Vec<Dim>& spacing() const { return spacing_; }  ///< edges [m]
    const Vec<Dim>& inverse() const { return inverse_; }  ///< ds_d/dx_d [1/m]

   private:
    Vec<Dim> low_, spacing_, inverse_;
  };
};

/// Quadratic B-splines on open knots 0, 0, 0, 1, 2, ..., n, n, n along each axis of n cells: n + 2 functions, of which
/// cell c touches c, c + 1 and c + 2; C¹ inside, and interpolating at the grid's sides, so that control points there
/// hold the side. In a cell, from the left to the right,
///     N_c = a (1 − s)²,  N_{c+2} = b s²,  N_{c+1} = 1 − N_c − N_{c+2},
/// a = ½ (1 in the first cell), b = ½ (1 in the last): Cox and de Boor's recursion (C. de Boor, A Practical Guide to
/// Splines, 1978, ch. X). Local nodes: x fastest.
template <int Dim>
struct GridSpline {
  static constexpr int dim = Dim, each = 3, nodes = detail::power(each, Dim), sides = 2 * Dim;
  static constexpr bool stores_local = false, has_domains = false, corrects = true;

  class Cell {
   public:
    Cell(const Mesh<Dim>& mesh, int e) : cell_(*mesh.grid, e), spacing_(mesh.grid->spacing) {
      for (int d = 0; d < Dim; ++d) {
        a_[d] = cell_.at[d] == 0 ? 1.0 : 0.5;
        b_[d] = cell_.at[d] + 1 == mesh.grid->elements[d] ? 1.0 : 0.5;
      }
    }

    template <class T>
    std::array<T, Dim> local(const std::array<T, Dim>& x) const {
      return cell_.local(x);
    }

    template <class T>
    Mask<T> inside(const std::array<T, Dim>& s, const auto& tolerance) const {
      return detail::in_unit_box<Dim>(s, tolerance);
    }

    template <class T>
    void shape(const std::array<T, Dim>& s, std::array<T, nodes>& N) const {
      detail::products<Dim, each>(along_axes(s), N);
    }

    template <class T>
    void gradients(const std::array<T, Dim>& s, std::array<T, nodes>& N,
                   std::array<std::array<T, Dim>, nodes>& B) const {
      std::array<std::array<T, each>, Dim> f, g;
      along_axes(s, f, g);
      detail::products<Dim, each>(f, g, N, B);
    }

    /// The functions along each axis, and their derivatives [1/m].
    template <class T>
    void along_axes(const std::array<T, Dim>& s, std::array<std::array<T, each>, Dim>& f,
                    std::array<std::array<T, each>, Dim>& g) const {
      f = along_axes(s);
      for (int d = 0; d < Dim; ++d) {
        g[d][0] = T(-2 * a_[d] * cell_.inverse[d]) * (T(1.0) - s[d]);
        g[d][2] = T(2 * b_[d] * cell_.inverse[d]) * s[d];
        g[d][1] = -(g[d][0] + g[d][2]);
      }
    }

    /// Along an axis ∫ N_c ds = a/3, ∫ dN_c = −a, and likewise b/3 and b on the other side.
    void integrals(double& V, std::array<Vec<Dim>, nodes>& g) const {
      V = 1;
      std::array<std::array<double, each>, Dim> mean, slope;
      for (int d = 0; d < Dim; ++d) {
        V /= cell_.inverse[d];
        mean[d] = {a_[d] / 3, 1 - (a_[d] + b_[d]) / 3, b_[d] / 3};
        slope[d] = {-a_[d] * cell_.inverse[d], (a_[d] - b_[d]) * cell_.inverse[d], b_[d] * cell_.inverse[d]};
      }
      std::array<double, nodes> unused;
      detail::products<Dim, each>(mean, slope, unused, g);
      for (auto& g_i : g) {
        for (double& component : g_i) component *= V;
      }
    }

    template <class F>
    void for_gauss(F&& f) const {
      detail::for_gauss_of_box(cell_.inverse, f);
    }

    bool first(int d) const { return a_[d] == 1; }  ///< is it the first along axis d?
    bool last(int d) const { return b_[d] == 1; }
    const Vec<Dim>& spacing() const { return spacing_; }       ///< edges [m]
    const Vec<Dim>& inverse() const { return cell_.inverse; }  ///< ds_d/dx_d [1/m]

   private:
    template <class T>
    std::array<std::array<T, each>, Dim> along_axes(const std::array<T, Dim>& s) const {
      std::array<std::array<T, each>, Dim> f;
      for (int d = 0; d < Dim; ++d) {
        const T r = T(1.0) - s[d];
        f[d][0] = T(a_[d]) * r * r;
        f[d][2] = T(b_[d]) * s[d] * s[d];
        f[d][1] = T(1.0) - f[d][0] - f[d][2];
      }
      return f;
    }

    detail::GridCell<Dim> cell_;
    Vec<Dim> spacing_, a_, b_;
  };
};

/// Uniform GIMP (S. Bardenhagen and E. Kober, CMES 5 (2004) 477): the averages of the multilinear N_i and ∇N_i over the
/// point's domain, a box about it of half-edge l = ½ Ω_p^{1/Dim} of the volume that it started with, at most half a
/// cell and at most the distance to the grid's sides. So it never reaches beyond the grid or more than a cell away, the
/// functions sum to one and reproduce a linear field everywhere, and at the sides they are the linear ones: a side is
/// held by its own nodes.
/// Along an axis, λ = l/h, with m = max(λ − s, 0) and p = max(λ + s − 1, 0) of the domain in the cells before and
/// after:
///     S_{−1} = m²/4λ,  S_2 = p²/4λ,  S_0 = 1 − s − 2 S_{−1} + S_2,  S_1 = s + S_{−1} − 2 S_2,
/// the last two from Σ S_i = 1 and Σ i S_i = s. Local nodes: the lines −1, 0, 1, 2 about the cell along each axis, x
/// fastest; one beyond the grid is the line on its side, with S = 0.
template <int Dim>
struct GridGimp {
  static constexpr int dim = Dim, each = 4, nodes = detail::power(each, Dim), sides = 2 * Dim;
  // Domains overlap cells, so that those of a cell's points are no partition of it.
  static constexpr bool stores_local = false, has_domains = true, corrects = false;

  /// A point's place in the cell, and λ along each axis.
  template <class T>
  struct Local {
    using value_type = T;
    std::array<T, Dim> s, lambda;
  };

  class Cell {
   public:
    Cell(const Mesh<Dim>& mesh, int e) : cell_(*mesh.grid, e) {
      for (int d = 0; d < Dim; ++d) {
        before_[d] = cell_.at[d];
        after_[d] = mesh.grid->elements[d] - cell_.at[d];
      }
    }

    template <class T>
    std::array<T, Dim> local(const std::array<T, Dim>& x) const {
      return cell_.local(x);
    }

    template <class T>
    Local<T> local(const std::array<T, Dim>& x, const T& half) const {
      Local<T> at;
      at.s = cell_.local(x);
      for (int d = 0; d < Dim; ++d) {
        const T to_sides = min(T(before_[d]) + at.s[d], T(after_[d]) - at.s[d]);
        at.lambda[d] = max(T(0.0), min(min(half * T(cell_.inverse[d]), T(0.5)), to_sides));
      }
      return at;
    }

    template <class T>
    Mask<T> inside(const std::array<T, Dim>& s, const auto& tolerance) const {
      return detail::in_unit_box<Dim>(s, tolerance);
    }

    template <class T>
    void shape(const Local<T>& at, std::array<T, nodes>& N) const {
      std::array<std::array<T, each>, Dim> f, g;
      along_axes(at, f, g);
      detail::products<Dim, each>(f, N);
    }

    template <class T>
    void gradients(const Local<T>& at, std::array<T, nodes>& N, std::array<std::array<T, Dim>, nodes>& B) const {
      std::array<std::array<T, each>, Dim> f, g;
      along_axes(at, f, g);
      detail::products<Dim, each>(f, g, N, B);
    }

    const Vec<Dim>& inverse() const { return cell_.inverse; }  ///< ds_d/dx_d [1/m]

   private:
    template <class T>
    void along_axes(const Local<T>& at, std::array<std::array<T, each>, Dim>& f,
                    std::array<std::array<T, each>, Dim>& g) const {
      constexpr double tiny = 1e-300;  // a point without a domain has no part of it in other cells: 0 / tiny
      for (int d = 0; d < Dim; ++d) {
        const T &s = at.s[d], &lambda = at.lambda[d], whole = T(2.0) * lambda, per_whole = T(1.0) / max(whole, T(tiny));
        const T m = min(max(lambda - s, T(0.0)), whole), p = min(max(lambda + s - T(1.0), T(0.0)), whole);
        const T part_m = m * per_whole, part_p = p * per_whole;
        f[d][0] = T(0.5) * m * part_m;
        f[d][3] = T(0.5) * p * part_p;
        f[d][1] = T(1.0) - s - T(2.0) * f[d][0] + f[d][3];
        f[d][2] = s + f[d][0] - T(2.0) * f[d][3];
        const T slope(cell_.inverse[d]);
        g[d][0] = -(slope * part_m);
        g[d][3] = slope * part_p;
        g[d][1] = slope * (T(2.0) * part_m + part_p - T(1.0));
        g[d][2] = slope * (T(1.0) - part_m - T(2.0) * part_p);
      }
    }

    detail::GridCell<Dim> cell_;
    Vec<Dim> before_, after_;  ///< cells before the lower side of this one, and from there to the grid's end
  };
};

}  // namespace scarp
