// Products and the exponential of symmetric tensors against plain matrices.
#include "scarp/tensor/exponential.hpp"

#include <gtest/gtest.h>
#include <cmath>

#include "matrix.hpp"

namespace scarp::test {
namespace {

template <int N>
double difference(const Sym<double, N>& a, const Matrix& b) {
  return norm(a - from_matrix<N>(b));
}

template <int N>
void expect_products() {
  std::mt19937 generator(1);
  for (int i = 0; i < 50; ++i) {
    const auto a = random_tensor<N>(generator), b = random_tensor<N>(generator);
    const Matrix A = to_matrix(a), B = to_matrix(b);
    Matrix both = A * B;
    const Matrix other = B * A;
    for (std::size_t r = 0; r < 3; ++r)
      for (std::size_t c = 0; c < 3; ++c) both[r][c] = 0.5 * (both[r][c] + other[r][c]);
    EXPECT_LT(difference(symmetric_product(a, b), both), 1e-14);
    EXPECT_LT(difference(triple_product(a, b), A * B * A), 1e-14);
  }
}

TEST(Products, AreThoseOfMatrices) {
  expect_products<4>();
  expect_products<6>();
}

/// The plain series, 60 terms.
Matrix series(const Matrix& a) {
  Matrix sum{}, term{};
  for (std::size_t i = 0; i < 3; ++i) sum[i][i] = term[i][i] = 1;
  for (int k = 1; k < 60; ++k) {
    term = term * a;
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t j = 0; j < 3; ++j) {
        term[i][j] /= k;
        sum[i][j] += term[i][j];
      }
  }
  return sum;
}

template <int N>
void expect_exponential() {
  std::mt19937 generator(2);
  for (double size : {1e-4, 0.05, 0.5, 1.5}) {
    for (int i = 0; i < 50; ++i) {
      const auto a = random_tensor<N>(generator, size);
      const auto e = exponential(a);
      // The bound, which is relative to the smallest eigenvalue and so more than fair here; rounding.
      EXPECT_LT(difference(e, series(to_matrix(a))), (exponential_error(a) + 1e-14) * norm(e)) << size;
    }
  }
}

TEST(Exponential, IsItsSeriesWithinItsBound) {
  expect_exponential<4>();
  expect_exponential<6>();
}

// The bound is relative to every eigenvalue: the smallest is the worst.
TEST(Exponential, BoundHoldsForEachEigenvalue) {
  for (double x : {-4.0, -2.0, -0.7, 0.7, 2.0, 4.0}) {
    const Sym<double, 4> a{{x, 0, 0, 0}};
    EXPECT_LT(std::abs(exponential(a)[0] / std::exp(x) - 1), exponential_error(a) + 1e-15) << x;
  }
  EXPECT_LT(exponential_error(Sym<double, 4>{{0.1, 0, 0, 0}}), 1e-18);
}

}  // namespace
}  // namespace scarp::test
