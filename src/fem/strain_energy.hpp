// Energy of a stress.
#pragma once

#include "material/elastic.hpp"
#include "numerics/types.hpp"

namespace dygita {

// 1/2 s : C^-1 : s, J/m^3; s: xx yy zz xy yz zx, Pa.
inline double energy_density(const Elastic& material, const Eigen::Matrix<double, 6, 1>& s) {
  const double trace = s[0] + s[1] + s[2];
  const double norm2 = s.head<3>().squaredNorm() + 2 * s.tail<3>().squaredNorm();
  return 0.5 * ((1 + material.poisson) * norm2 - material.poisson * trace * trace) / material.young;
}

}  // namespace dygita
