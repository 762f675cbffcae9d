// Which waves, followed by which time scheme, the mass of cells keeps at their speed.
#pragma once

#include <algorithm>

namespace dygita {

struct WaveTuning {
  double speed = 0.0;  // m/s, of the waves that keep it
  double dt = 0.0;     // s, of trapezoidal steps

  // Share of the consistent mass along a length h (m): linear cells with lumped mass turn a wave by (k h)^2 / 24 too
  // little and those with consistent mass by as much too much; a trapezoidal step turns it by (w dt)^2 / 12 too little.
  double share(double h) const {
    const double cfl = speed * dt / h;
    return std::min(1.0, 0.5 + cfl * cfl);
  }
};

}  // namespace dygita
