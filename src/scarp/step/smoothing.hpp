// G of docs/length.md: sums at the corners of a mesh, smoothed over the kernel exp(−r²/ℓ²), which has the variance ℓ²/2
// along each axis. What comes to the corners by functions N and goes back to points by them has been smoothed by these
// already, by var(N) on each way, so that G has the variance ℓ²/2 − 2 var(N). Two numbers at each corner; the same
// results to the last bit on any number of threads.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "scarp/base/column.hpp"
#include "scarp/mesh/mesh.hpp"

namespace scarp::step {

/// The variance along an axis, mean over the axes and over element e, of the functions of its corners about where they
/// are evaluated, [m²]: h²/6 for a square or cube of edge h. Of a grid those are the corners of its cells, whatever its
/// own functions.
template <int Dim>
double shape_variance(const Mesh<Dim>& mesh, int e);

/// On a grid, where corners are evenly spaced: weights exp(−(i h)²/ℓ_s²) along one axis after the other, for |i h| <
/// 2.5 ℓ, with ℓ_s² = ℓ² − ⅔ h².
template <int Dim>
class GridSmoothing {
 public:
  GridSmoothing(const Vec<Dim>& spacing, double length);

  /// Smooths two numbers at each of corners[0] × corners[1] (× corners[2]) corners, x fastest; `scratch` is as long.
  void operator()(const std::array<int, Dim>& corners, Column& values, Column& scratch) const;

 private:
  std::array<std::vector<double>, Dim> weights_;  ///< of i = 0, 1, ...
};

/// On any mesh: diffusion of densities for the time in which a spike gets that variance,
///
///   dc/dt = −M⁻¹ L c,   L = Σ_e (ℓ²/4 − var_e(N)) ∫ ∇N ∇Nᵀ dV,   M = Σ_e ∫ N dV,   from c(0) = sums/M to t = 1.
///
/// L has the same kernel in elements of any size and shape; elements too coarse for ℓ pass nothing on. Four steps of s
/// stages each, with s such that small elements stay stable: as explicit steps, but s² / 2 times as long (Runge–Kutta–
/// Legendre of first order: C. D. Meyer, D. S. Balsara, T. D. Aslam, J. Comput. Phys. 257 (2014)). Each step adds
/// exactly its part to the variance wherever L meets x² exactly.
template <int Dim>
class MeshSmoothing {
 public:
  MeshSmoothing(const Mesh<Dim>& mesh, double length);

  /// Smooths two sums at each node of the mesh into densities; `scratch` is as long.
  void operator()(Column& values, Column& scratch) const;

  int stages() const { return steps * stages_; }

 private:
  static constexpr int steps = 4;    ///< the kernel is nearly a Gaussian then: its excess is −3/8
  std::vector<int> begin_, column_;  ///< rows of the other nodes that a node exchanges with
  std::vector<double> share_;        ///< −L_ij / M_i in a stage
  std::vector<double> per_volume_;   ///< 1 / M_i
  int stages_ = 1;                   ///< s
};

}  // namespace scarp::step
