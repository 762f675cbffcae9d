// What a run's answer is worth, told by the run itself: errors of iteration, time step and mesh in energy norm (manual,
// eq. Q1-Q6).
//
// Each is the square root of the energy of the estimated error over that of the shock, at its worst instant.
#pragma once

#include <array>
#include <optional>
#include <span>

#include "result/carried_motion.hpp"
#include "result/linked_parts.hpp"
#include "result/part_views.hpp"

namespace dygita {

// The velocities of a piece by octave of frequency (eq. Q2): what each sample has in the middle of an octave.
class OctaveSamples {
 public:
  // Samples the velocities. Writes the square of the content of each octave that it completes, from octave 0 on, and
  // says how many these are: the same for pieces that have been given as many samples. mass: kg, weights.
  int add(const Vec& mass, const Vec& velocity, double* content2);
  // The velocities last added; null: none yet.
  const Vec* latest() const { return octaves_.empty() ? nullptr : &octaves_.front().last[0]; }
  static constexpr int most_octaves = 32;

 private:
  struct Octave {
    std::array<Vec, 3> last;  // samples, the latest first
    long n_samples = 0;
  };
  std::vector<Octave> octaves_;
  std::array<Vec, 2> smooth_;  // on its way to the octave below
};

// Content of the velocities of the assembly by octave of frequency, and the phase error that the time scheme gives each
// (eq. Q2-Q4): a trapezoidal step turns a motion of angular frequency w by (w dt)^3 / 12 too little, until it has
// nothing in common with the exact one.
class OctaveBank {
 public:
  // is_tuned: the cells' mass undoes the phase error to the next order, (w dt)^5 / 80.
  explicit OctaveBank(bool is_tuned) : is_tuned_(is_tuned) {}

  // Squares of the contents of the first octaves in a sample.
  void add(std::span<const double> content2);
  // Norm (sqrt of J) of the accumulated phase error; `factor` multiplies the phases.
  double phase_error(double factor = 1.0) const;

 private:
  struct Octave {
    double content = 0.0;  // largest norm so far
    double phase = 0.0;    // sum of content x phase error of a sample
  };
  bool is_tuned_;
  std::vector<Octave> octaves_;
};

// Every rank has the velocities and the stress error of its own pieces; the estimates are the same on all. Sums are
// taken piece by piece, in their order.
class ErrorEstimator {
 public:
  ErrorEstimator(const Problem& problem, PartViews& views);
  // Both are collective.
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
  // J, what a scene at rest, or carried along by a static step, has of rounding and of what an iteration leaves: shares
  // of less say nothing.
  double energy_at_rest() const { return at_rest_; }
  // J, of the displacements since the start of a dynamic step, where the last increment has been sampled.
  const std::optional<double>& strain_of_motion() const { return strain_now_; }

 private:
  // Energies (J) of the stress error of all substructures, of those of linear cells alone, and the strain energy of the
  // same displacements.
  struct StressEnergies {
    double error = 0.0, of_linear = 0.0, strain = 0.0;
  };
  // What a piece that is here has of a dynamic step.
  struct PieceMotion {
    int piece = 0;
    Vec mass;                      // kg, of its unknowns
    Points directions;             // 3 x n, of the same
    Vec velocity;                  // m/s, of the same; relative (Q0)
    Vec3 momentum = Vec3::Zero();  // kg m/s, where the carried motion asks for it, or parts that are not linked
    Points start;                  // m, displacements at the start of the step
    OctaveSamples octaves;
  };

  void accept_static(const Instant& instant);
  void take_velocities(const Instant& instant);
  void sample_stress(const Instant& instant);
  StressEnergies stress_energies(const Instant& instant);
  double energy_when_carried(const Instant& instant) const;

  // Of the shock, J, relative to which errors are: twice the kinetic energy, as of a wave, without that of parts which
  // fly as a whole and have touched nothing; of a slow motion, what is stored in it; at rest, next to nothing of what
  // was there before.
  double energy() const { return std::max({2.0 * kinetic_, shock_energy_, 1e-8 * stored_}); }

  // Of a static step so far.
  struct StaticStep {
    double loads = 0.0, strain = 0.0, balance = 0.0;  // J, work of the loads and what the balance misses, at its start
    double left = 0.0;                                // sqrt of J, sum of what its increments leave
    double work = 0.0, missing = 0.0;                 // J, largest so far since its start
  };

  Estimate static_, dynamic_;
  StaticStep still_;
  std::vector<double> volume_;            // m^3, of the substructures
  double at_rest_ = 0.0;                  // J
  double most_strain_ = 0.0;              // J, when static steps began and ended
  std::optional<OctaveBank> bank_;        // of the step
  double before_ = 0.0;                   // phase error (norm, sqrt of J) of the dynamic steps before
  std::vector<PieceMotion> pieces_;       // that are here, in a dynamic step
  std::optional<CarriedMotion> carried_;  // of the step
  LinkedParts linked_;
  double dt_ = 0.0, phase_factor_ = 1.0;
  PartViews* views_;
  std::vector<Points> start_;            // displacements of the views at the start of the dynamic step: what it adds is
                                         // the shock; empty in static ones
  double kinetic_now_ = 0.0;             // J, of the relative velocities, without parts in flight
  double kinetic_ = 0.0, stored_ = 0.0;  // J, largest so far: kinetic of the relative velocities; kinetic + strain
  double shock_energy_ = 0.0;            // J, largest of the samples: kinetic, and strain of the shock
  double stress_energy_ = 0.0;           // J, largest of the samples
  std::optional<double> strain_now_;     // J, of the shock, where the increment was sampled
  // Of the samples: stress error of the parts of linear cells (eq. Q6), and strain energy of the shock.
  double stress_sum_ = 0.0, strain_sum_ = 0.0;
  int n_stress_ = 0;
  double total_mass_ = 0.0;  // kg
  double lag_ = 0.0;         // s^2, of the diagonal mass of cells of order two (eq. Q12)
  double rate_ = 0.0;        // sum of |dV / dt|^2, in the norm of the mass
  long n_rates_ = 0;
  bool has_old_ = false;  // of the step: velocities of an increment before
};

}  // namespace dygita
