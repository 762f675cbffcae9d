// Free motions of many bodies: what a sparse factor counts and finds, a dense solution has too.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "numerics/pairs_below.hpp"

namespace dygita {
namespace {

// Springs between neighbours in a row of n points; between chains of `length` there is none, and none to the ground
// where `is_held` is not set.
SparseMatrix chains(int n, int length, bool is_held) {
  std::vector<Eigen::Triplet<double>> entries;
  for (int i = 0; i < n; ++i) {
    if (i % length == 0) {
      if (is_held) entries.emplace_back(i, i, 1.0);
      continue;
    }
    for (const auto& [row, column, value] :
         {std::tuple{i, i, 1.0}, {i - 1, i - 1, 1.0}, {i, i - 1, -1.0}, {i - 1, i, -1.0}})
      entries.emplace_back(row, column, value);
  }
  SparseMatrix a(n, n);
  a.setFromTriplets(entries.begin(), entries.end());
  return a;
}

TEST(PairsBelow, are_none_where_everything_is_held) {
  const EigenPairs pairs = pairs_below(chains(2000, 20, true), 1e-9);
  EXPECT_EQ(pairs.values.size(), 0);
  EXPECT_EQ(pairs.vectors.cols(), 0);
}

TEST(PairsBelow, are_one_a_chain_that_nothing_holds_and_span_what_the_dense_ones_span) {
  for (const int n : {200, 700}) {  // dense, sparse
    const SparseMatrix a = chains(n, 50, false);
    const EigenPairs pairs = pairs_below(a, 1e-9);
    ASSERT_EQ(pairs.values.size(), n / 50);
    EXPECT_LT(pairs.values.cwiseAbs().maxCoeff(), 1e-12);
    EXPECT_LT((a * pairs.vectors).cwiseAbs().maxCoeff(), 1e-12);
    EXPECT_LT((pairs.vectors.transpose() * pairs.vectors - Mat::Identity(n / 50, n / 50)).norm(), 1e-12);
    const Mat dense = symmetric_eigen(Mat(a)).vectors.leftCols(n / 50);
    EXPECT_NEAR((dense.transpose() * pairs.vectors).norm(), std::sqrt(n / 50), 1e-9);  // the same space
  }
}

// The chain's own vibrations lie on both sides of the limit: the slowest to settle.
TEST(PairsBelow, are_found_where_others_lie_just_above_the_limit) {
  const SparseMatrix a = chains(700, 700, false);
  const auto exact = [](int k) { return 2.0 - 2.0 * std::cos(k * std::numbers::pi / 700); };
  const EigenPairs pairs = pairs_below(a, 0.5 * (exact(2) + exact(3)));
  ASSERT_EQ(pairs.values.size(), 3);
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(pairs.values[k], exact(k), 1e-12);
  EXPECT_LT((a * pairs.vectors - pairs.vectors * pairs.values.asDiagonal()).norm(), 1e-10);
}

}  // namespace
}  // namespace dygita
