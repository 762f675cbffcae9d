// Isotropic linear elasticity, its wave speeds and impedances.
#pragma once

#include <cmath>
#include <string>

#include "numerics/types.hpp"

namespace dygita {

struct Damping {
  double mass = 0.0;       // 1/s
  double stiffness = 0.0;  // s
};

struct Elastic {
  std::string name;
  double young = 0.0;  // Pa
  double poisson = 0.0;
  double density = 0.0;  // kg/m^3
  Damping damping;

  double shear_modulus() const { return young / (2.0 * (1.0 + poisson)); }
  double p_wave_modulus() const { return young * (1.0 - poisson) / ((1.0 + poisson) * (1.0 - 2.0 * poisson)); }
  double p_wave_speed() const { return std::sqrt(p_wave_modulus() / density); }  // m/s
  double s_wave_speed() const { return std::sqrt(shear_modulus() / density); }   // m/s

  // Hooke's matrix (6 x 6, Pa) for strains xx yy zz 2xy 2yz 2zx.
  Eigen::Matrix<double, 6, 6> hooke() const;
};

}  // namespace dygita
