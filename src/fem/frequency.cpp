#include "fem/frequency.hpp"

namespace dygita {

namespace {

using CellVector = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, most_cell_dofs, 1>;

// Upper bound on the highest eigenvalue of a symmetric matrix, positive or not.
//
// For any unit vector v, with rho = v . A v and r = A v - rho v, A is the 2 x 2 block matrix of rho, r and A restricted
// to the rest, whose norm is at most beta = (||A||_F^2 - rho^2 - 2 |r|^2)^(1/2); so its highest eigenvalue is at most
// that of [rho, |r|; |r|, beta]. Three power iterations make v nearly the eigenvector: the bound is then
// max(eigenvalue, beta), and beta is the smaller for most elements.
double eigenvalue_bound(const CellMatrix& a) {
  Eigen::Index start;
  a.diagonal().maxCoeff(&start);
  CellVector v = a.col(start).normalized();
  for (int i = 0; i < 3; ++i) v = a.lazyProduct(v).eval().normalized();

  const CellVector image = a.lazyProduct(v);
  const double rho = v.dot(image), residual2 = (image - rho * v).squaredNorm();
  const double beta = std::sqrt(std::max(0.0, a.squaredNorm() - rho * rho - 2 * residual2));
  return (rho + beta) / 2 + std::sqrt((rho - beta) * (rho - beta) / 4 + residual2);
}

// The same by the norm of A^4, dearer: exceeds the eigenvalue by rank^(1/8) at worst, 1.44 for a hex8.
double fourth_power_bound(const CellMatrix& a) {
  const CellMatrix square = a * a, fourth = square * square;
  return std::sqrt(std::sqrt(fourth.norm()));
}

}  // namespace

void FrequencyBound::see(const CellMatrix& stiffness, const Eigen::Ref<const Eigen::VectorXd>& mass) {
  CellVector factor(3 * mass.size());  // M^-1/2
  for (Eigen::Index a = 0; a < mass.size(); ++a) factor.segment<3>(3 * a).setConstant(1 / std::sqrt(mass[a]));
  CellMatrix scaled(stiffness.rows(), stiffness.cols());
  for (Eigen::Index j = 0; j < factor.size(); ++j) scaled.col(j) = stiffness.col(j).cwiseProduct(factor[j] * factor);

  // Three bounds, each closer and dearer than the last: those that cannot raise the maximum stop early.
  double bound = scaled.norm();
  if (bound > eigenvalue_) bound = std::min(bound, eigenvalue_bound(scaled));
  if (bound > eigenvalue_) bound = std::min(bound, fourth_power_bound(scaled));
  eigenvalue_ = std::max(eigenvalue_, bound);
}

}  // namespace dygita
