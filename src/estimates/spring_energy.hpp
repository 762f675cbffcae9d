// What supports and interfaces store of a dynamic step's own motion, known by their energy alone.
#pragma once

#include <algorithm>
#include <cmath>

namespace dygita {

// Of linear springs the root of the energy is a norm of their extensions: with e those at the start of the step and u
// what it adds, |e + u| <= |e| + |u|, and of two instants | |a| - |b| | <= |a - b|. So both energies are lower bounds,
// exact of one spring without preload that keeps its sign.
class SpringEnergy {
 public:
  // stored: J, when the step begins, and after each increment.
  void begin(double stored) { start_ = before_ = now_ = root(stored); }
  void accept(double stored) {
    before_ = now_;
    now_ = root(stored);
  }
  // J, of the extensions since the start of the step.
  double energy() const { return square(std::max(0.0, now_ - start_)); }
  // J/s^2, of their velocities in the last increment, which took `dt` (s).
  double energy_of_velocities(double dt) const { return square((now_ - before_) / dt); }

 private:
  static double root(double stored) { return std::sqrt(std::max(0.0, stored)); }
  static double square(double x) { return x * x; }

  double start_ = 0.0, before_ = 0.0, now_ = 0.0;  // roots of J
};

}  // namespace dygita
