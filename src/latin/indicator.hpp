// The distance between the linear and the local stage (manual, eq. I1).
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "latin/local_stage.hpp"

namespace dygita {

struct Outcome {
  double eta = std::numeric_limits<double>::infinity();
  double size = 0.0, force_size = 0.0;  // W, of the increment's fields
};

// eta^2 = distance / max(largest size so far, floor); the floor keeps quiet increments from iterating on rounding
// errors. A static step asks more: a body that has flown off has velocities beside which no force would count, so the
// forces must also agree among themselves, to a hundred times the tolerance.
class Indicator {
 public:
  // largest_motion: sum k L^2 of a static step over the size L of the assembly, what a velocity size can be in earnest;
  // 0: dynamic.
  // force_share: of the forces' own agreement, in the indicator.
  explicit Indicator(double largest_motion, double force_share = 1e-2)
      : largest_motion_(largest_motion), force_share_(force_share) {}
  // energy: kinetic + strain + |work of loads| seen so far, J.
  void raise_floor(double energy, double dt) { floor_ = std::max(floor_, 1e-12 * energy / dt); }
  // The same when a static step starts: one that does nothing has not to settle what the tolerance has left of those
  // before. Its forces are right to the tolerance of a thousandth of theirs.
  void start_from(double energy) { floor_ = std::max(floor_, 1e-6 * energy); }
  // The same when a dynamic step starts, on what steps before have stored (J): of that, rounding leaves about 1e-12.
  void start_motion(double energy, double dt, double tolerance) {
    const double finest = std::max(1e-6, 1e-12 / tolerance);
    floor_ = std::max(floor_, finest * finest * energy / dt);
  }
  // sum k U^2 / 2 of where a static increment starts: forces of what has moved are no closer than its rounding.
  void start_displaced(double size) { displaced_ = size; }
  Outcome measure(const IndicatorSums& sums) const {
    constexpr double tiny = std::numeric_limits<double>::min();
    const double size = sums.force_size + sums.velocity_size;
    double eta = std::sqrt((sums.force_distance + sums.velocity_distance) / std::max({largest_, size, floor_, tiny}));
    if (largest_motion_ > 0.0) {
      const double motion = std::min(std::max(sums.velocity_size, displaced_), largest_motion_);
      const double forces = std::max({largest_force_, sums.force_size, 4e-15 * motion, floor_, tiny});
      eta = std::max(eta, force_share_ * std::sqrt(sums.force_distance / forces));
    }
    return {eta, size, sums.force_size};
  }
  // Fields that grow beyond any proportion to what a dynamic increment began with (W), along what nothing determines,
  // make the distance no smaller: the indicator of what they may be at most, where that is above the tolerance.
  std::optional<double> of_runaway(const IndicatorSums& sums, double beginning, double tolerance) const {
    constexpr double most = 1e4;
    const double size = sums.force_size + sums.velocity_size, bound = most * std::max({largest_, floor_, beginning});
    if (!(size > bound) || bound == 0.0) return {};
    const double eta = std::sqrt((sums.force_distance + sums.velocity_distance) / bound);
    return eta > tolerance ? std::optional(eta) : std::nullopt;
  }
  // Changes below this (W) are far below what the indicator sees: a hundredth of the tolerance.
  double quiet(double tolerance) const { return std::pow(1e-2 * tolerance, 2) * largest_; }
  double largest() const { return largest_; }
  void accept(const Outcome& outcome) {
    largest_ = std::max(largest_, outcome.size);
    largest_force_ = std::max(largest_force_, outcome.force_size);
  }

 private:
  double largest_motion_, force_share_;
  double largest_ = 0.0, largest_force_ = 0.0, floor_ = 0.0, displaced_ = 0.0;
};

}  // namespace dygita
