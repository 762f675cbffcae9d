// The distance between the linear and the local stage (manual, eq. I1).
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "latin/local_stage.hpp"

namespace dygita {

struct Outcome {
  double eta = std::numeric_limits<double>::infinity();
  double size = 0.0;  // W, of the increment's fields
};

// eta^2 = distance / max(largest size so far, floor); the floor keeps quiet increments from iterating on rounding errors.
class Indicator {
 public:
  // energy: kinetic + strain + |work of loads| seen so far, J.
  void raise_floor(double energy, double dt) { floor_ = std::max(floor_, 1e-12 * energy / dt); }
  Outcome measure(const IndicatorSums& sums) const {
    const double scale = std::max({largest_, sums.size, floor_, std::numeric_limits<double>::min()});
    return {std::sqrt(sums.distance / scale), sums.size};
  }
  void accept(const Outcome& outcome) { largest_ = std::max(largest_, outcome.size); }

 private:
  double largest_ = 0.0, floor_ = 0.0;
};

}  // namespace dygita
