#include "numerics/dense.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>

#include "base/error.hpp"

extern "C" {
void dgetrf_(const int* m, const int* n, double* a, const int* lda, int* pivots, int* info);
void dgetrs_(const char* trans, const int* n, const int* n_rhs, const double* a, const int* lda, const int* pivots,
             double* b, const int* ldb, int* info);
}

namespace dygita {

EigenPairs symmetric_eigen(const Mat& a) {
  const Eigen::SelfAdjointEigenSolver<Mat> eigen(a);
  return {eigen.eigenvalues(), eigen.eigenvectors()};
}

PrincipalAxes principal_axes(const Mat3& a) {
  const Eigen::SelfAdjointEigenSolver<Mat3> eigen(a);
  return {eigen.eigenvalues(), eigen.eigenvectors()};
}

EigenPairs generalized_symmetric_eigen(const Mat& k, const Mat& m) {
  const Eigen::GeneralizedSelfAdjointEigenSolver<Mat> eigen(k, m);
  return {eigen.eigenvalues(), eigen.eigenvectors()};
}

Mat solve_dense(const Mat& a, const Mat& b) { return a.fullPivLu().solve(b); }

Mat inverse(const Mat& a) { return a.partialPivLu().inverse(); }

Mat pseudo_inverse(const Mat& a) { return a.completeOrthogonalDecomposition().pseudoInverse(); }

LeastNorm solve_least_norm(const Mat& a, const Mat& b, double threshold) {
  Eigen::CompleteOrthogonalDecomposition<Mat> solver;
  solver.setThreshold(threshold);
  solver.compute(a);
  return {solver.solve(b), static_cast<int>(solver.rank())};
}

LuFactor::LuFactor(Mat a) : lu_(std::move(a)), pivots_(static_cast<size_t>(lu_.rows())) {
  const int n = static_cast<int>(lu_.rows());
  if (n == 0) return;
  int info = 0;
  dgetrf_(&n, &n, lu_.data(), &n, pivots_.data(), &info);
  CHECK(info >= 0, "a dense matrix that LAPACK takes");
}

Vec LuFactor::solved(Vec b, char which) const {
  const int n = static_cast<int>(lu_.rows()), one = 1;
  if (n == 0) return b;
  int info = 0;
  dgetrs_(&which, &n, &one, lu_.data(), &n, pivots_.data(), b.data(), &n, &info);
  return b;
}

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
