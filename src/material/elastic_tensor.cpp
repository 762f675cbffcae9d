#include "material/elastic_tensor.hpp"

#include <Eigen/Cholesky>
#include <cmath>

#include "numerics/dense.hpp"

namespace dygita {

namespace {

// Places of a tensor's entries in a row of six.
constexpr int at[3][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}};

}  // namespace

ElasticTensor ElasticTensor::isotropic(double young, double poisson) {
  ElasticTensor tensor;
  tensor.young_ = young;
  tensor.mu_ = young / (2.0 * (1.0 + poisson));
  tensor.p_wave_ = young * (1.0 - poisson) / ((1.0 + poisson) * (1.0 - 2.0 * poisson));
  return tensor;
}

Mat6 ElasticTensor::stiffness() const {
  if (!is_isotropic_) return stiffness_;
  Mat6 d = Mat6::Zero();
  d.topLeftCorner<3, 3>().setConstant(lambda());
  d.diagonal().head<3>().setConstant(lambda() + 2 * mu_);
  d.diagonal().tail<3>().setConstant(mu_);
  return d;
}

Mat6 ElasticTensor::compliance() const { return stiffness().llt().solve(Mat6::Identity()); }

ElasticTensor ElasticTensor::turned(const Mat3& axes) const {
  if (is_isotropic_) return *this;
  Mat6 to_own;  // strains in the material's axes
  for (int p = 0; p < 3; ++p)
    for (int q = p; q < 3; ++q) {
      Mat3 gradient = Mat3::Zero();
      gradient(p, q) = 1.0;
      to_own.col(at[p][q]) = strain_of(axes.transpose() * gradient * axes);
    }
  const Mat6 turned = to_own.transpose() * stiffness_ * to_own;
  return ElasticTensor(Mat6(0.5 * (turned + turned.transpose())));
}

Vec6 ElasticTensor::general_stress(const Mat3& gradient) const { return stiffness_ * strain_of(gradient); }

double ElasticTensor::energy_density(const Vec6& s) const {
  if (!is_isotropic_) return 0.5 * s.dot(stiffness_.llt().solve(s));
  const double trace = s[0] + s[1] + s[2];
  const double norm2 = s.head<3>().squaredNorm() + 2 * s.tail<3>().squaredNorm();
  return 0.25 / mu_ * (norm2 - lambda() / (3 * lambda() + 2 * mu_) * trace * trace);
}

Mat3 ElasticTensor::acoustic(const Vec3& n) const {
  if (is_isotropic_) return mu_ * Mat3::Identity() + (p_wave_ - mu_) * n * n.transpose();
  Eigen::Matrix<double, 6, 3> strain;  // of unit motions times the phase along n
  for (int p = 0; p < 3; ++p) strain.col(p) = strain_of(Vec3::Unit(p) * n.transpose());
  return strain.transpose() * stiffness_ * strain;
}

double ElasticTensor::wave_modulus(const Vec3& normal, const Vec3& along) const {
  if (is_isotropic_) return std::abs(normal.dot(along)) > 0.5 ? p_wave_ : mu_;
  return along.dot(acoustic(normal) * along);
}

double ElasticTensor::young(const Vec3& n) const {
  if (is_isotropic_) return young_;
  Vec6 stress;
  stress << n.cwiseAbs2(), n[0] * n[1], n[1] * n[2], n[2] * n[0];
  return 0.5 / energy_density(stress);
}

double ElasticTensor::bulk_modulus() const {
  return is_isotropic_ ? p_wave_ - 4.0 / 3.0 * mu_ : stiffness_.topLeftCorner<3, 3>().sum() / 9.0;
}

Mat3 ElasticTensor::impedance(const Vec3& normal, double density) const {
  if (is_isotropic_) {
    const Mat3 along = normal * normal.transpose();
    const double z_n = density * std::sqrt(p_wave_ / density), z_t = density * std::sqrt(mu_ / density);
    return z_n * along + z_t * (Mat3::Identity() - along);
  }
  const PrincipalAxes waves = principal_axes(density * acoustic(normal));
  return waves.vectors * waves.values.cwiseMax(0.0).cwiseSqrt().asDiagonal() * waves.vectors.transpose();
}

}  // namespace dygita
