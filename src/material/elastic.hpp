// Isotropic linear elasticity, its wave speeds and impedances.
#pragma once

#include <array>
#include <cmath>
#include <string>

#include "numerics/types.hpp"

namespace dygita {

struct Damping {
  double mass = 0.0;       // 1/s
  double stiffness = 0.0;  // s

  // Of critical damping at a frequency (Hz) (manual, eq. D8).
  double ratio(double frequency) const;
};

// Damping proportional to the stiffness with a ratio at a frequency (Hz) (manual, eq. D8).
Damping damping_of(double ratio, double frequency);
// Rayleigh's, with a ratio at each of two frequencies (Hz). Throws InputError where they ask for a negative mass or
// stiffness part.
Damping damping_of(const std::array<double, 2>& ratio, const std::array<double, 2>& frequency);

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
