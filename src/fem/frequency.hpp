// Upper bounds on the frequencies of an element.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

namespace dygita {

// Upper bound on the highest eigenvalue of a symmetric matrix of fixed size, positive or not.
//
// For any unit vector v, with rho = v . A v and r = A v - rho v, A is the 2 x 2 block matrix of rho, r and A restricted
// to the rest, whose norm is at most beta = (||A||_F^2 - rho^2 - 2 |r|^2)^(1/2); so its highest eigenvalue is at most
// that of [rho, |r|; |r|, beta]. Three power iterations make v nearly the eigenvector: the bound is then
// max(eigenvalue, beta), and beta is the smaller for most elements.
template <class Matrix>
double eigenvalue_bound(const Matrix& a) {
  using Vector = Eigen::Matrix<double, Matrix::RowsAtCompileTime, 1>;
  Eigen::Index start;
  a.diagonal().maxCoeff(&start);
  Vector v = a.col(start).normalized();
  for (int i = 0; i < 3; ++i) v = a.lazyProduct(v).eval().normalized();

  const Vector image = a.lazyProduct(v);
  const double rho = v.dot(image), residual2 = (image - rho * v).squaredNorm();
  const double beta = std::sqrt(std::max(0.0, a.squaredNorm() - rho * rho - 2 * residual2));
  return (rho + beta) / 2 + std::sqrt((rho - beta) * (rho - beta) / 4 + residual2);
}

// The same by the norm of A^4, dearer: exceeds the eigenvalue by rank^(1/8) at worst, 1.44 for a hex8.
template <class Matrix>
double fourth_power_bound(const Matrix& a) {
  const Matrix square = a * a, fourth = square * square;
  return std::sqrt(std::sqrt(fourth.norm()));
}

// Keeps the largest of the bounds of the elements it has seen, whatever their order: at most 1.2 times the highest
// frequency of an element. The frequencies of a mesh with lumped mass are at most those of its elements (Irons and
// Treharne).
class FrequencyBound {
 public:
  // stiffness: 3n x 3n, N/m, dof = 3 node + axis; mass: n, kg.
  template <class Stiffness, class Mass>
  void see(const Stiffness& stiffness, const Mass& mass) {
    Eigen::Matrix<double, Stiffness::RowsAtCompileTime, 1> factor;  // M^-1/2
    for (int a = 0; a < mass.size(); ++a) factor.template segment<3>(3 * a).setConstant(1 / std::sqrt(mass[a]));
    Stiffness scaled;
    for (int j = 0; j < factor.size(); ++j) scaled.col(j) = stiffness.col(j).cwiseProduct(factor[j] * factor);

    // Three bounds, each closer and dearer than the last: those that cannot raise the maximum stop early.
    double bound = scaled.norm();
    if (bound > eigenvalue_) bound = std::min(bound, eigenvalue_bound(scaled));
    if (bound > eigenvalue_) bound = std::min(bound, fourth_power_bound(scaled));
    eigenvalue_ = std::max(eigenvalue_, bound);
  }

  void see(const FrequencyBound& other) { eigenvalue_ = std::max(eigenvalue_, other.eigenvalue_); }

  double frequency() const { return std::sqrt(eigenvalue_); }  // rad/s

 private:
  double eigenvalue_ = 0.0;  // rad^2/s^2
};

}  // namespace dygita
