// Pairs (difference of iterates, difference of their residuals) and the combination of them that explains a residual
// best.
#pragma once

#include <vector>

#include "numerics/types.hpp"

namespace dygita {

// The last `depth` pairs stand in fixed columns beside the Gram matrix of the residuals' differences: a pair costs one
// product with each of the others, a solve two passes over them, and nothing is allocated. Runs on one thread: the same
// bits for any number.
class Differences {
 public:
  Differences(int depth, Eigen::Index length);
  void clear();
  bool is_empty() const { return newest_first_.empty(); }
  // The oldest pair goes where there is no room. A pair without a difference is not kept.
  void add(const Vec& q, const Vec& q_before, const Vec& residual, const Vec& residual_before);
  // q <- q - dq gamma, residual <- residual - df gamma, with gamma that leaves the least |residual|.
  void take_off(Vec& q, Vec& residual);

 private:
  void solve(const Vec& residual);

  int last_ = -1;
  Mat dq_, df_;        // length x depth, divided by the length of df
  Mat gram_, factor_;  // df^T df, and Cholesky's factor of the pairs that are used
  Vec gamma_;
  std::vector<int> newest_first_, used_;
};

}  // namespace dygita
