#include "scarp/lab/constrained.hpp"

namespace scarp::lab {

ConstraintMatrices::ConstraintMatrices(const std::array<LinearForm, 6>& forms) {
  for (int row = 0; row < 6; ++row) {
    for (int i = 0; i < 6; ++i) {
      const double once = i < 3 ? 1.0 : 1.0 / sqrt2;
      const auto& form = forms[static_cast<std::size_t>(row)];
      E(row, i) = once * form.E[static_cast<std::size_t>(i)];
      S(row, i) = once * form.S[static_cast<std::size_t>(i)];
    }
  }
}

Vector6 solve_scaled(const Matrix6& J, const Vector6& b) {
  // A row on strain is of order 1, one on stress of the order of a stiffness.
  Matrix6 A = J;
  Vector6 rhs = b;
  for (int row = 0; row < 6; ++row) {
    const double size = J.row(row).cwiseAbs().maxCoeff();
    if (!(size > 0)) continue;
    A.row(row) /= size;
    rhs[row] /= size;
  }
  Eigen::CompleteOrthogonalDecomposition<Matrix6> solver;
  solver.setThreshold(1e-11);
  solver.compute(A);
  return solver.solve(rhs);
}

bool is_rounding(const Vector6& residual, const ConstraintMatrices& c, const Vector6& eps, double stress,
                 const Vector6& b) {
  const Vector6 size = c.E.rowwise().norm() * eps.norm() + c.S.rowwise().norm() * stress + b.cwiseAbs();
  return ((residual.cwiseAbs() - 1e-11 * size).array() <= 0).all();
}

}  // namespace scarp::lab
