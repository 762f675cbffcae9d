// The largest eigenvalue of a growing tridiagonal matrix against that of the dense one.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "numerics/dense.hpp"
#include "numerics/tridiagonal.hpp"

namespace dygita::test {
namespace {

// beside: scale of the entries beside the diagonal.
void expect_those_of_the_dense_matrix(double beside, double shift) {
  constexpr int n = 30;
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  TopOfTridiagonal top;
  Mat dense = Mat::Zero(n, n);
  for (int i = 0; i < n; ++i) {
    dense(i, i) = shift + uniform(random);
    const double own = i > 0 ? beside * uniform(random) : 0.0;
    if (i > 0) dense(i, i - 1) = dense(i - 1, i) = own;
    top.add(dense(i, i), own);
    const EigenPairs pairs = symmetric_eigen(dense.topLeftCorner(i + 1, i + 1));
    const double scale = std::abs(shift) + 1.0 + beside;
    EXPECT_NEAR(top.value(), pairs.values[i], 3e-14 * scale) << i;
    EXPECT_NEAR(top.last_entry(), std::abs(pairs.vectors(i, i)), 1e-6) << i;
  }
}

TEST(TopOfTridiagonal, is_that_of_the_dense_matrix) {
  expect_those_of_the_dense_matrix(1.0, 0.0);
  expect_those_of_the_dense_matrix(10.0, 3.0);
  expect_those_of_the_dense_matrix(1e-3, -5.0);
}

TEST(TopOfTridiagonal, of_rows_that_are_not_connected) {
  TopOfTridiagonal top;
  top.add(2.0, 0.0);
  EXPECT_EQ(top.value(), 2.0);
  EXPECT_EQ(top.last_entry(), 1.0);
  top.add(1.0, 0.0);
  EXPECT_EQ(top.value(), 2.0);
  EXPECT_EQ(top.last_entry(), 0.0);
  top.add(3.0, 0.0);
  EXPECT_EQ(top.value(), 3.0);
  EXPECT_EQ(top.last_entry(), 1.0);
}

}  // namespace
}  // namespace dygita::test
