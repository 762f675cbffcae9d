#include "numerics/pairs_below.hpp"

#include <Eigen/QR>
#include <Eigen/SparseCholesky>
#include <cmath>

namespace dygita {

namespace {

constexpr Eigen::Index small = 600;  // dense takes a tenth of a second

using ColumnMatrix = Eigen::SparseMatrix<double>;
using Ldlt = Eigen::SimplicialLDLT<ColumnMatrix>;

EigenPairs dense_pairs(const SparseMatrix& a, double limit) {
  const EigenPairs all = symmetric_eigen(Mat(a));
  Eigen::Index n = 0;
  while (n < all.values.size() && all.values[n] < limit) ++n;
  return {all.values.head(n), all.vectors.leftCols(n)};
}

ColumnMatrix shifted(const SparseMatrix& a, double shift) {
  ColumnMatrix identity(a.rows(), a.rows());
  identity.setIdentity();
  return ColumnMatrix(a) + shift * identity;
}

// The same each time, and along no axis.
Mat start(Eigen::Index size, Eigen::Index n) {
  Mat x(size, n);
  for (Eigen::Index j = 0; j < n; ++j)
    for (Eigen::Index i = 0; i < size; ++i)
      x(i, j) = std::cos(static_cast<double>((i + 1) * (j + 2)) + 0.5 * static_cast<double>(j));
  return x;
}

// Inverse iteration of the columns of x to the space that the sweeps change no more; false where they still do: pairs
// on both sides of the limit lie close to each other.
bool settle(const Ldlt& above, Mat& x) {
  constexpr int least = 6, most = 200;
  constexpr double settled = 1e-12;
  double change = 1.0;
  for (int sweep = 0; sweep < most && (sweep < least || change > settled); ++sweep) {
    const Mat y = above.solve(x);
    const Mat next = Eigen::HouseholderQR<Mat>(y).householderQ() * Mat::Identity(x.rows(), x.cols());
    change = (next - x * (x.transpose() * next)).norm();
    x = next;
  }
  return change <= 1e-6;
}

}  // namespace

EigenPairs pairs_below(const SparseMatrix& a, double limit) {
  const Eigen::Index size = a.rows();
  if (size <= small) return dense_pairs(a, limit);
  const Ldlt below(shifted(a, -limit));
  if (below.info() != Eigen::Success) return dense_pairs(a, limit);
  const Eigen::Index n = (below.vectorD().array() < 0.0).count();
  if (n == 0) return {Vec(), Mat(size, 0)};
  const Ldlt above(shifted(a, limit));
  if (above.info() != Eigen::Success || 2 * n > size) return dense_pairs(a, limit);
  Mat x = start(size, n);
  if (!settle(above, x)) return dense_pairs(a, limit);
  const Mat ax = ColumnMatrix(a) * x;
  const EigenPairs small_pairs = symmetric_eigen(x.transpose() * ax);
  if (small_pairs.values[n - 1] >= limit) return dense_pairs(a, limit);
  return {small_pairs.values, x * small_pairs.vectors};
}

}  // namespace dygita
