// Bodies of revolution about the vertical axis: a plane basis in the meridian plane.
#pragma once

#include <array>

#include "scarp/mesh/basis.hpp"

namespace scarp {

/// A plane basis in the meridian plane of a body of revolution, per radian: x is the distance r from the axis. A radial
/// displacement u_r stretches the circumference by Σ u_r,i N_i / r.
template <class Plane>
struct Axisymmetric : Plane {
  static constexpr bool axisymmetric = true;
  static constexpr int nodes = Plane::nodes;

  class Cell : public Plane::Cell {
   public:
    Cell(const Mesh<2>& mesh, int e) : Plane::Cell(mesh, e) {
      mesh.for_local_positions(e, [&, i = 0](const Vec<2>& x) mutable { r_[i++] = x[0]; });
    }

    /// V = ∫ r dA, g_i = ∫ B_i r dA, and h_i = ∫ N_i dA: what N_i / r gives over the volume.
    void integrals(double& V, std::array<Vec<2>, nodes>& g, std::array<double, nodes>& h) const {
      V = 0;
      g.fill({});
      h.fill(0);
      this->for_gauss([&](const Vec<2>& local, double dA) {
        std::array<double, nodes> N;
        std::array<Vec<2>, nodes> B;
        this->gradients(local, N, B);
        double r = 0;
        for (int i = 0; i < nodes; ++i) r += N[i] * r_[i];
        V += r * dA;
        for (int i = 0; i < nodes; ++i) {
          for (int j = 0; j < 2; ++j) g[i][j] += B[i][j] * r * dA;
          h[i] += N[i] * dA;
        }
      });
    }

   private:
    std::array<double, nodes> r_;
  };
};

}  // namespace scarp
