// Pairs (difference of iterates, difference of their residuals) and the combination of them that explains a residual
// best.
#pragma once

#include <vector>

#include "step/interface_sums.hpp"

namespace dygita {

// The last `depth` pairs stand in fixed columns beside the Gram matrix of the residuals' differences: a pair costs one
// product with each of the others, a solve two passes over them. The same bits for any number of threads.
// Collective where the sums are.
class Differences {
 public:
  Differences(int depth, Eigen::Index length);
  Differences(int depth, Eigen::Index length, InterfaceSums sums);
  void clear();
  bool is_empty() const { return newest_first_.empty(); }
  // The oldest pair goes where there is no room. A pair without a difference is not kept. Returns |residual|^2.
  double add(const Eigen::Ref<const Vec>& q, const Vec& q_before, const Vec& residual, const Vec& residual_before);
  // The next to be taken off, where no pair comes with it. Returns |residual|^2.
  double project(const Vec& residual);
  // Both in two halves: the sums that they need, taken by the caller with others, and what follows from them. residual
  // stays what it was meanwhile.
  InterfaceSums::ToCome sums_to_add(const Vec& residual, const Vec& residual_before);
  double add(const Eigen::Ref<const Vec>& q, const Vec& q_before, const double* sums);
  InterfaceSums::ToCome sums_to_project(const Vec& residual) const;
  double project(const double* sums);
  // q <- q - dq gamma, residual <- residual - df gamma, with gamma that leaves the least |residual|: the one last added
  // or projected.
  void take_off(Eigen::Ref<Vec> q, Vec& residual);

 private:
  void solve();
  void subtract(const Mat& columns, const Vec& factors, Eigen::Ref<Vec> from) const;

  InterfaceSums sums_;
  int last_ = -1;
  Mat dq_, df_;        // length x depth, divided by the length of df
  Mat gram_, factor_;  // df^T df, and Cholesky's factor of the pairs that are used
  Vec along_, gamma_;  // df^T residual
  std::vector<int> newest_first_, used_;
};

}  // namespace dygita
