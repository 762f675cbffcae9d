// What a run's answer is worth, told by the run itself: errors of iteration, time step and mesh in energy norm (manual,
// eq. Q1-Q6).
//
// Each is the square root of the energy of the estimated error over that of the shock, at its worst instant.
#pragma once

#include <optional>

#include "result/carried_motion.hpp"

namespace dygita {

// Content of the velocities by octave of frequency, and the phase error that the time scheme gives each (eq. Q2-Q4): a
// trapezoidal step turns a motion of angular frequency w by (w dt)^3 / 12 too little, until it has nothing in common
// with the exact one.
class OctaveBank {
 public:
  // mass: kg, weight of each unknown. is_tuned: the cells' mass undoes the phase error to the next order, (w dt)^5
  // / 80.
  OctaveBank(Vec mass, bool is_tuned) : mass_(std::move(mass)), is_tuned_(is_tuned) {}

  void add(const Vec& velocity) { add(0, velocity); }
  // Norm (sqrt of J) of the accumulated phase error; `factor` multiplies the phases.
  double phase_error(double factor = 1.0) const;

 private:
  struct Octave {
    std::vector<Vec> last;  // up to three samples, the latest first
    long n_samples = 0;
    double content = 0.0;  // largest norm so far
    double phase = 0.0;    // sum of content x phase error of a sample
  };
  void add(size_t i_octave, const Vec& velocity);
  double norm2(const Vec& v) const { return v.dot(mass_.cwiseProduct(v)); }

  Vec mass_;
  bool is_tuned_;
  std::vector<Octave> octaves_;
};

class ErrorEstimator {
 public:
  void begin_step(const Instant& start);
  void accept(const Instant& instant);

  struct Estimate {
    double iteration = 0.0, time_step = 0.0, mesh = 0.0;  // relative, energy norm
    double interface_energy = 0.0;  // J, constitutive-relation error of the interfaces, summed over the increments
    double mean_frequency = 0.0;    // Hz, of the energy of the velocities
    double velocity = 0.0;          // m/s, at which all mass would have the energy that the errors are relative to
  };
  Estimate static_steps() const { return static_; }
  Estimate dynamic_steps() const;

 private:
  void accept_static(const Instant& instant);
  void take_velocities(const Instant& instant);
  void sample_stress(const Instant& instant);

  // Of the shock, J, relative to which errors are: twice the kinetic energy, as of a wave; of a slow motion, what is
  // stored in it; at rest, next to nothing of what was there before.
  double energy() const { return std::max({2.0 * kinetic_, shock_energy_, 1e-8 * stored_}); }

  // Of a static step so far.
  struct StaticStep {
    double loads = 0.0, balance = 0.0;  // J, work of the loads and what the balance misses, at its start
    double left = 0.0;                  // sqrt of J, sum of what its increments leave
    double work = 0.0, missing = 0.0;   // J, largest so far since its start
  };

  Estimate static_, dynamic_;
  StaticStep still_;
  std::optional<OctaveBank> bank_;           // of the step
  double before_ = 0.0, before_mesh_ = 0.0;  // phase errors (norms, sqrt of J) of the dynamic steps before
  Vec velocity_, velocity_old_, mass_;       // of all substructures' free unknowns, in their order; relative (Q0)
  Points directions_;                        // 3 x n, of the same
  std::optional<CarriedMotion> carried_;     // of the step
  double dt_ = 0.0, phase_factor_ = 1.0;
  std::vector<Points> start_;            // displacements at the start of the dynamic steps: what they add is the shock
  double kinetic_now_ = 0.0;             // J, of the relative velocities
  double kinetic_ = 0.0, stored_ = 0.0;  // J, largest so far: kinetic of the relative velocities; kinetic + strain
  double shock_energy_ = 0.0;            // J, largest of the samples: kinetic, and strain of the shock
  double stress_energy_ = 0.0;           // J, largest of the samples
  // Of the samples: stress error of the parts of linear cells (eq. Q6), and strain energy of the shock.
  double stress_sum_ = 0.0, strain_sum_ = 0.0;
  int n_stress_ = 0;
  double total_mass_ = 0.0;  // kg
  double rate_ = 0.0;        // sum of |dV / dt|^2, in the norm of the mass
  long n_rates_ = 0;
};

}  // namespace dygita
