#include "numerics/dense.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>

namespace dygita {

EigenPairs symmetric_eigen(const Mat& a) {
  const Eigen::SelfAdjointEigenSolver<Mat> eigen(a);
  return {eigen.eigenvalues(), eigen.eigenvectors()};
}

EigenPairs generalized_symmetric_eigen(const Mat& k, const Mat& m) {
  const Eigen::GeneralizedSelfAdjointEigenSolver<Mat> eigen(k, m);
  return {eigen.eigenvalues(), eigen.eigenvectors()};
}

EigenPairs tridiagonal_eigen(const std::vector<double>& diagonal, const std::vector<double>& subdiagonal) {
  const auto n = static_cast<Eigen::Index>(diagonal.size());
  Eigen::SelfAdjointEigenSolver<Mat> eigen;
  eigen.computeFromTridiagonal(Eigen::Map<const Vec>(diagonal.data(), n),
                               Eigen::Map<const Vec>(subdiagonal.data(), n - 1));
  return {eigen.eigenvalues(), eigen.eigenvectors()};
}

Mat solve_dense(const Mat& a, const Mat& b) { return a.fullPivLu().solve(b); }

QrFactors full_qr(const Mat& a) {
  const Eigen::HouseholderQR<Mat> qr(a);
  return {qr.householderQ(), qr.matrixQR().topRows(a.cols()).triangularView<Eigen::Upper>()};
}

RankedBasis ranked_basis(const Mat& a, double threshold) {
  Eigen::ColPivHouseholderQR<Mat> qr(a);
  qr.setThreshold(threshold);
  return {qr.householderQ(), static_cast<int>(qr.rank())};
}

}  // namespace dygita
