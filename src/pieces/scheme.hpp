// The time scheme of a step.
#pragma once

#include "material/elastic.hpp"

namespace dygita {

// Coefficients of the time scheme; a static step has dt = 1, g = 0 and no mass (manual, eq. S1-S5).
struct Scheme {
  bool is_static = true;
  double dt = 1.0, g = 0.0;

  double c0(const Damping& d) const { return g * (1 - g) * dt + g * beta(d); }              // of K V0
  double c1(const Damping& d) const { return (1 - g) * (1 - g) * dt + (1 - g) * beta(d); }  // of K V1
  double alpha(const Damping& d) const { return is_static ? 0.0 : d.mass; }
  double beta(const Damping& d) const { return is_static ? 0.0 : d.stiffness; }
  double inverse_dt() const { return is_static ? 0.0 : 1.0 / dt; }  // of M (V1 - V0)
};

}  // namespace dygita
