#include "material/elastic.hpp"

namespace dygita {

Eigen::Matrix<double, 6, 6> Elastic::hooke() const {
  const double mu = shear_modulus();
  const double lambda = p_wave_modulus() - 2.0 * mu;
  Eigen::Matrix<double, 6, 6> d = Eigen::Matrix<double, 6, 6>::Zero();
  d.topLeftCorner<3, 3>().setConstant(lambda);
  d.diagonal() << lambda + 2 * mu, lambda + 2 * mu, lambda + 2 * mu, mu, mu, mu;
  return d;
}

}  // namespace dygita
