#include "scarp/lab/constrained.hpp"

#include <algorithm>

namespace scarp::lab {
namespace {

/// Solves J x = b by rows of equal size; the shortest solution where several remain.
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

}  // namespace

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

Search::Search(const ConstraintMatrices& constraints, const Vector6& b, std::function<Answer(const Vector6&)> response,
               const Scales& scales)
    : c_(constraints), b_(b), response_(std::move(response)), scales_(scales) {
  weight_ = (c_.E.rowwise().norm() + scales.stiffness * c_.S.rowwise().norm()).cwiseInverse();
}

Search::Point Search::at(const Vector6& d) const {
  const auto answer = response_(d);
  const Vector6 residual = c_.E * d + c_.S * answer.stress - b_;
  return {d, answer.stress, residual, weight_.cwiseProduct(residual).norm(), answer.sound};
}

bool Search::met(const Point& point, double share) const {
  const double strain = point.d.norm();
  const Vector6 size =
      c_.E.rowwise().norm() * strain + c_.S.rowwise().norm() * (scales_.stiffness * strain) + b_.cwiseAbs();
  const Vector6 allowed = share * size + scales_.rounding * c_.S.rowwise().norm();
  return ((point.residual.cwiseAbs() - allowed).array() <= 0).all();
}

/// ∂Δσ/∂d by differences, exact but for rounding on a linear branch.
Matrix6 Search::tangent(const Point& point) const {
  const double h = std::max(scales_.difference * point.d.norm(), scales_.smallest);
  Matrix6 D;
  for (int i = 0; i < 6; ++i) {
    Vector6 moved = point.d;
    moved[i] += h;
    D.col(i) = (response_(moved).stress - point.stress) / h;
  }
  return D;
}

/// One step of Newton's method: a whole one, or the largest of its halves where the law can be evaluated at all, and
/// the residual is less if `downhill`.
std::optional<Search::Point> Search::next(const Point& point, bool downhill) const {
  constexpr int most_halves = 10;
  const Matrix6 J = c_.E + c_.S * tangent(point);
  if (!J.allFinite()) return {};
  Vector6 step = solve_scaled(J, point.residual);
  // A tangent that is singular but for rounding would leap into nonsense.
  const double longest = 100 * (point.d.norm() + point.merit);
  if (step.norm() > longest) step *= longest / step.norm();
  for (int half = 0; half < most_halves; ++half) {
    const auto trial = at(point.d - step);
    if (std::isfinite(trial.merit) && (!downhill || trial.merit < point.merit)) return trial;
    step *= 0.5;
  }
  return {};
}

/// A law is nearly linear in the strain on each of its branches (elastic, plastic), so that whole steps end after a
/// few: with an answer on the branch that they assumed, or going round between branches. Then only steps that lead
/// downhill are left.
std::optional<Vector6> Search::from(const Vector6& d) const {
  constexpr double enough = 1e-11;  // rounding
  constexpr int whole_steps = 8, most_steps = 20;
  std::optional<Point> point = at(d);
  if (!std::isfinite(point->merit)) return {};
  for (int i = 0; i < most_steps; ++i) {
    if (met(*point, enough)) break;
    const auto trial = next(*point, i >= whole_steps);
    const bool stands = !trial || trial->merit > 0.5 * point->merit;
    if (stands && met(*point, scales_.coarse)) break;
    if (!trial) return {};
    point = trial;
  }
  if (point->sound && met(*point, scales_.coarse)) return point->d;
  return {};
}

}  // namespace scarp::lab
