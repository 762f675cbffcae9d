// Small decompositions against what defines them.
#include <gtest/gtest.h>

#include "numerics/dense.hpp"

namespace dygita::test {
namespace {

// 5 x 4, of rank 3.
Mat deficient() {
  Mat left(5, 3), right(3, 4);
  left << 1, 2, 0, -1, 1, 3, 2, 0, 1, 0, 1, -2, 4, 1, 1;
  right << 2, 0, 1, -1, 1, 3, 0, 2, 0, 1, 1, 1;
  return left * right;
}

TEST(Dense, inverse_times_the_matrix_is_one) {
  Mat a(3, 3);
  a << 0, 2, 1, 1, 0, 3, 4, 1, 0;  // a pivot of zero first
  EXPECT_LT((inverse(a) * a - Mat::Identity(3, 3)).norm(), 1e-14);
}

TEST(Dense, pseudo_inverse_fulfils_the_four_conditions_of_penrose) {
  const Mat a = deficient(), p = pseudo_inverse(a);
  EXPECT_LT((a * p * a - a).norm(), 1e-13 * a.norm());
  EXPECT_LT((p * a * p - p).norm(), 1e-13 * p.norm());
  EXPECT_LT((a * p - (a * p).transpose()).norm(), 1e-13);
  EXPECT_LT((p * a - (p * a).transpose()).norm(), 1e-13);
}

TEST(Dense, least_norm_is_that_of_the_pseudo_inverse_and_knows_the_rank) {
  const Mat a = deficient();
  Mat b(5, 2);
  b << 1, 0, 2, -1, 0, 3, 1, 1, -2, 5;
  const LeastNorm found = solve_least_norm(a, b, 1e-9);
  EXPECT_EQ(found.rank, 3);
  EXPECT_LT((found.x - pseudo_inverse(a) * b).norm(), 1e-12 * found.x.norm());
  // What is below the threshold is left out, however regular the matrix.
  EXPECT_EQ(solve_least_norm(Vec3(1.0, 1e-4, 1.0).asDiagonal().toDenseMatrix(), Vec3(1, 1, 1), 1e-3).rank, 2);
}

TEST(Dense, principal_axes_are_orthonormal_and_increase) {
  Mat3 a;
  a << 2, -1, 0.5, -1, 3, 0, 0.5, 0, 1;
  const PrincipalAxes axes = principal_axes(a);
  EXPECT_LT((axes.vectors.transpose() * axes.vectors - Mat3::Identity()).norm(), 1e-14);
  EXPECT_LT((a * axes.vectors - axes.vectors * axes.values.asDiagonal()).norm(), 1e-14 * a.norm() * 10);
  EXPECT_LT(axes.values[0], axes.values[1]);
  EXPECT_LT(axes.values[1], axes.values[2]);
}

}  // namespace
}  // namespace dygita::test
