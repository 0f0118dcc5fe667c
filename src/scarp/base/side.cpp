#include "scarp/base/side.hpp"

#include <cmath>

namespace scarp {
namespace {

/// A sum of doubles kept exactly, as an expansion of doubles that do not overlap, the largest last (J. R. Shewchuk,
/// Adaptive precision floating-point arithmetic, Discrete & Computational Geometry 18, 1997, theorem 10).
class ExactSum {
 public:
  void add(double b) {
    for (int i = 0; i < size_; ++i) {
      const double sum = b + term_[i], from = sum - b;
      term_[i] = (b - (sum - from)) + (term_[i] - from);
      b = sum;
    }
    term_[size_++] = b;
  }

  /// ± a b: the rounded product and its error.
  void add_product(double a, double b) {
    const double product = a * b;
    add(std::fma(a, b, -product));
    add(product);
  }

  int sign() const {
    for (int i = size_ - 1; i >= 0; --i) {
      if (term_[i] != 0) return term_[i] > 0 ? 1 : -1;
    }
    return 0;
  }

 private:
  double term_[12];
  int size_ = 0;
};

}  // namespace

int side_of_line(const Vec<2>& a, const Vec<2>& b, const Vec<2>& x) {
  const double left = (b[0] - a[0]) * (x[1] - a[1]), right = (b[1] - a[1]) * (x[0] - a[0]), difference = left - right;
  // Three roundings of half 2.2e-16 in each product and one of their difference: beyond this the sign is sure.
  if (std::abs(difference) > 4.5e-16 * (std::abs(left) + std::abs(right))) return difference > 0 ? 1 : -1;
  ExactSum exact;
  exact.add_product(a[0], b[1]);
  exact.add_product(-a[1], b[0]);
  exact.add_product(b[0], x[1]);
  exact.add_product(-b[1], x[0]);
  exact.add_product(x[0], a[1]);
  exact.add_product(-x[1], a[0]);
  return exact.sign();
}

}  // namespace scarp
