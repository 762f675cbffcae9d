// Stress of strain at one place: the one home of lambda, mu and the 21 others. Kernels take it.
#pragma once

#include "numerics/types.hpp"

namespace dygita {

using Mat6 = Eigen::Matrix<double, 6, 6>;  // of strains xx yy zz 2xy 2yz 2zx and stresses xx yy zz xy yz zx
using Vec6 = Eigen::Matrix<double, 6, 1>;

// Strain of a displacement gradient d u_p / d x_q.
inline Vec6 strain_of(const Mat3& g) {
  return {g(0, 0), g(1, 1), g(2, 2), g(0, 1) + g(1, 0), g(1, 2) + g(2, 1), g(2, 0) + g(0, 2)};
}

// Of a plane wave with this normal and motion, and of a bar pulled along a direction, moduli in Pa.
class ElasticTensor {
 public:
  ElasticTensor() = default;
  static ElasticTensor isotropic(double young, double poisson);
  // Positive definite and symmetric, Pa.
  explicit ElasticTensor(const Mat6& stiffness) : is_isotropic_(false), stiffness_(stiffness) {}

  bool is_isotropic() const { return is_isotropic_; }
  // Pa; of an isotropic one alone: others have no such pair.
  double lambda() const { return p_wave_ - 2 * mu_; }
  double mu() const { return mu_; }

  Mat6 stiffness() const;
  Mat6 compliance() const;  // 1/Pa
  // The same material with its axes along the columns (manual, eq. Y2).
  ElasticTensor turned(const Mat3& axes) const;

  // Pa, of a displacement gradient d u_p / d x_q.
  Vec6 stress(const Mat3& g) const {
    if (!is_isotropic_) return general_stress(g);
    const double pressure = lambda() * (g(0, 0) + (g(1, 1) + g(2, 2)));
    return {2 * mu_ * g(0, 0) + pressure, 2 * mu_ * g(1, 1) + pressure, 2 * mu_ * g(2, 2) + pressure,
            mu_ * (g(0, 1) + g(1, 0)),    mu_ * (g(1, 2) + g(2, 1)),    mu_ * (g(2, 0) + g(0, 2))};
  }
  // 1/2 s : C^-1 : s, J/m^3, of a stress (Pa).
  double energy_density(const Vec6& stress) const;

  // Pa, Christoffel's matrix of plane waves with a unit normal (manual, eq. Y3): eigenvalues are density x speed^2.
  Mat3 acoustic(const Vec3& normal) const;
  // Pa, of its diagonal along a unit vector that is the normal or at right angles to it.
  double wave_modulus(const Vec3& normal, const Vec3& along) const;
  double young(const Vec3& along) const;  // Pa, of a bar along a unit vector
  double bulk_modulus() const;            // Pa, of equal strains
  // Traction (N s/m^3) against the velocity of a face with this unit normal, where waves leave (manual, eq. Y4).
  Mat3 impedance(const Vec3& normal, double density) const;

 private:
  Vec6 general_stress(const Mat3& gradient) const;

  bool is_isotropic_ = true;
  double young_ = 0.0, mu_ = 0.0, p_wave_ = 0.0;  // Pa
  Mat6 stiffness_ = Mat6::Zero();                 // Pa, of one that is not isotropic
};

}  // namespace dygita
