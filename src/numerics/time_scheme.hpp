// The time scheme of a step: how motion follows from velocity, what of the start and of the end is in an increment's
// balance, how long an increment may be, and how large its error is. Nobody else knows its weights.
#pragma once

#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <vector>

namespace dygita {

// A spring in series with a damper, beside the stiffness K of a body: the force strength K e, with e' = u' - rate e
// (manual, eq. D22).
struct Branch {
  double strength = 0.0;  // as a share of K
  double rate = 0.0;      // 1/s, one over the relaxation time

  bool operator==(const Branch&) const = default;
};

// What is left of a branch's elongation after a time (s), and what a velocity that lasts so long adds to it (s).
struct Relaxation {
  double left = 1.0, gain = 0.0;
  Relaxation() = default;
  Relaxation(double rate, double time)
      : left(std::exp(-rate * time)), gain(rate > 0.0 ? -std::expm1(-rate * time) / rate : time) {}
};

// Damping in proportion to mass and stiffness (manual, eq. D8), or the same at all frequencies of a band by branches.
struct Damping {
  double mass = 0.0;       // 1/s
  double stiffness = 0.0;  // s
  std::vector<Branch> branches = {};
  std::optional<std::array<double, 2>> band = {};  // Hz, of the branches

  bool operator==(const Damping&) const = default;
  bool is_none() const { return *this == Damping(); }
  // Do forces on nodes depend on how the cells around them are strained in time?
  bool is_of_strain() const { return stiffness > 0.0 || !branches.empty(); }

  // Of critical damping at a frequency (Hz).
  double ratio(double frequency) const {
    constexpr double pi = std::numbers::pi;
    return mass / (4.0 * pi * frequency) + pi * frequency * stiffness + ratio_of_branches(frequency);
  }
  double ratio_of_branches(double frequency) const {
    return std::sin(0.5 * std::atan2(loss(frequency), storage(frequency)));
  }
  // The stiffness of a vibration at a frequency (Hz) as a share of the static one, in phase with the motion and a
  // quarter of a period ahead of it (manual, eq. D23); that of a sudden motion.
  double storage(double frequency) const {
    const double w = 2.0 * std::numbers::pi * frequency;
    double sum = 1.0;
    for (const Branch& b : branches) sum += b.strength * (b.rate > 0.0 ? w * w / (w * w + b.rate * b.rate) : 1.0);
    return sum;
  }
  double loss(double frequency) const {
    const double w = 2.0 * std::numbers::pi * frequency;
    double sum = 0.0;
    for (const Branch& b : branches)
      if (b.rate > 0.0) sum += b.strength * w * b.rate / (w * w + b.rate * b.rate);
    return sum;
  }
  double of_sudden_motion() const {
    double sum = 1.0;
    for (const Branch& b : branches) sum += b.strength;
    return sum;
  }
};

// A mean over an increment takes the start with weight g and the end with 1 - g (manual, eq. S1-S5). In a static step
// velocities are increments: dt is 1, g is 0, and nothing has mass. X: a number, or a vector or matrix of its own
// memory.
class TimeScheme {
 public:
  bool is_static = true;
  double dt = 1.0;  // s

  TimeScheme() = default;  // of a static step
  static TimeScheme implicit(double dt, double numerical_damping = 0.0) {
    return weighted(dt, 0.5 * (1.0 - numerical_damping));
  }
  static TimeScheme weighted(double dt, double start) { return {false, dt, start}; }
  // The same increment where there is no mass: its motion and its force are those of the end (manual, eq. S7).
  TimeScheme of_end() const { return {is_static, dt, 0.0}; }

  // What start and end add to a mean; the mean of two velocities; the motion of an increment between them.
  template <class X>
  X from_start(const X& x) const {
    return g_ * x;
  }
  template <class X>
  X from_end(const X& x) const {
    return (1.0 - g_) * x;
  }
  template <class X>
  X mean(const X& start, const X& end) const {
    return g_ * start + (1.0 - g_) * end;
  }
  template <class X>
  X motion(const X& start, const X& end) const {
    return dt * (g_ * start + (1.0 - g_) * end);
  }
  // The end of what has this mean.
  template <class X>
  X end_of(const X& mean, const X& start) const {
    return (mean - g_ * start) / (1.0 - g_);
  }
  // Velocity of the end, the other way, that takes back what the start's moves.
  template <class X>
  X undoing(const X& start) const {
    return g_ / (1.0 - g_) * start;
  }
  // What works over an increment, of a force as the balance has it: that of the end in a static step, of which the
  // force grows from the last one's, and the mean in a dynamic one.
  template <class X>
  X working(const X& last, const X& now) const {
    if (is_static) return 0.5 * (last + now);
    return now;
  }

  // The balance of an increment (manual, eq. S2):
  // inertia_of_end M V1 + c1 K V1 = inertia_of_start M V0 - K (U0 + c0 V0) + forces.
  double c0(const Damping& d) const { return g_ * (1 - g_) * dt * stiffening(d) + g_ * beta(d); }
  double c1(const Damping& d) const { return (1 - g_) * (1 - g_) * dt * stiffening(d) + (1 - g_) * beta(d); }
  // The mean elongation of a branch is `kept` of the sum of that at the start and (1-g) dt times the mean velocity, so
  // that K counts so many times in an increment (manual, eq. D24).
  double kept(const Branch& b) const { return 1.0 / (1.0 + (1 - g_) * dt * b.rate); }
  double stiffening(const Damping& d) const {
    double sum = 1.0;
    if (is_static) return sum;
    for (const Branch& b : d.branches) sum += b.strength * kept(b);
    return sum;
  }
  double inertia_of_start(const Damping& d) const { return inverse_dt() - g_ * alpha(d); }  // 1/s
  double inertia_of_end(const Damping& d) const { return inverse_dt() + (1 - g_) * alpha(d); }
  double alpha(const Damping& d) const { return is_static ? 0.0 : d.mass; }
  double beta(const Damping& d) const { return is_static ? 0.0 : d.stiffness; }
  double inverse_dt() const { return is_static ? 0.0 : 1.0 / dt; }

  // Does it dissipate what nothing else does? Energy (J) so lost, of dU.K dU + dV.M dV over an increment (manual, E2).
  bool dissipates() const { return g_ != 0.5; }
  double loss(double change) const { return (0.5 - g_) * change; }
  double numerical_damping() const { return 1.0 - 2.0 * g_; }

  // Order of the error of a motion in time: that of both schemes, without numerical damping.
  static constexpr double order = 2.0;
  // Trapezoidal increments turn a motion too little: angle (rad) of one that should turn by `turn`, and as a share of
  // its frequency (manual, eq. Q2). Mass that is tuned to them leaves the next order.
  static double phase_lag(double turn, bool is_tuned) {
    return is_tuned ? std::pow(turn, 5) / 80.0 : std::pow(turn, 3) / 12.0;
  }
  static double frequency_lag(double turn2, bool is_tuned) { return is_tuned ? turn2 * turn2 / 80.0 : turn2 / 12.0; }
  // Central differences turn it half as much too far.
  static constexpr double lag_of_central_differences = 0.5;
  // Longest stable increment (s) of central differences for a squared angular frequency, stiffness damping taken at the
  // velocity of the increment's start (manual, eq. S11, S14). The implicit scheme has no limit up to g = 1/2.
  static double longest_of_central_differences(double omega2) {
    return omega2 > 0.0 ? 2.0 / std::sqrt(omega2) : std::numeric_limits<double>::infinity();
  }
  static double longest_damped(double longest, const Damping& d) {
    if (!std::isfinite(longest)) return longest;
    return std::sqrt(d.stiffness * d.stiffness + longest * longest / d.of_sudden_motion()) - d.stiffness;
  }

 private:
  TimeScheme(bool stands, double length, double g) : is_static(stands), dt(length), g_(g) {}

  double g_ = 0.0;  // weight of the start
};

}  // namespace dygita
