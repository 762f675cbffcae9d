// What a run's answer is worth, told by the run itself: errors of iteration, time step and mesh in energy norm (manual,
// eq. Q1-Q6).
//
// Each is the square root of the energy of the estimated error over that of the shock, at its worst instant.
#pragma once

#include <optional>

#include "estimates/octaves.hpp"
#include "estimates/spring_energy.hpp"
#include "fem/free_surface.hpp"
#include "watch/carried_motion.hpp"
#include "watch/linked_parts.hpp"
#include "watch/part_views.hpp"

namespace dygita {

// Every rank has the velocities and the stress error of its own pieces; the estimates are the same on all. Sums are
// taken piece by piece, in their order.
class ErrorEstimator {
 public:
  ErrorEstimator(const Problem& problem, PartViews& views);
  // Both are collective.
  void begin_step(const Instant& start);
  void accept(const Instant& instant);

  // Of a substructure, of its own motion: what the work that the iteration leaves at its points is of its energy, and
  // the velocity (m/s) at which all of its mass would have that (eq. Q17).
  struct OfPart {
    double imbalance = 0.0, velocity = 0.0;
  };
  struct Estimate {
    double iteration = 0.0, time_step = 0.0, mesh = 0.0;  // relative, energy norm
    double interface_energy = 0.0;  // J, constitutive-relation error of the interfaces, summed over the increments
    double mean_frequency = 0.0;    // Hz, of the energy of the velocities
    double velocity = 0.0;          // m/s, at which all mass would have the energy that the errors are relative to
    double main_frequency = 0.0;    // Hz, that step_frequency is of
    // Apart (eq. Q14): relative errors of the mean frequency, and of amplitudes, in energy norm.
    double step_frequency = 0.0, mesh_frequency = 0.0, mesh_amplitude = 0.0;
    // Of mesh_frequency: what goes with the frequency, and what all frequencies have alike.
    double mesh_dispersion = 0.0, mesh_shift = 0.0;
    double imbalance = 0.0;  // of the energy of the motion, what its balance misses: who keeps the books says so
    // Of the time step, in the last dynamic step: about these frequencies (Hz) velocities are off by so much (m/s).
    std::vector<std::pair<double, double>> lags;
    std::vector<OfPart> parts;   // all of them, where there is an iteration
    OfPart seen;                 // of the part that a spectrum is of
    bool joints_change = false;  // in the shock contacts touch, open or slide, or laws yield: who watches them says so
  };
  Estimate static_steps() const { return static_; }
  Estimate dynamic_steps() const;
  // J, what a scene at rest, or carried along by a static step, has of rounding and of what an iteration leaves: shares
  // of less say nothing.
  double energy_at_rest() const { return at_rest_; }
  // J, of the displacements since the start of a dynamic step, where the last increment has been sampled.
  const std::optional<double>& strain_of_motion() const { return strain_now_; }

 private:
  // Energies (J): of the stress error of all substructures, within them and at their free surfaces, and the strain
  // energy of the same displacements.
  struct StressEnergies {
    double within = 0.0, at_surface = 0.0, strain = 0.0;
    double error() const { return within + at_surface; }
  };
  // Strain energies of the displacements since the start of the step (J), of all substructures and of each, and of the
  // velocities (J/s^2).
  struct StrainEnergies {
    double of_motion = 0.0, of_velocities = 0.0;
    std::vector<double> of_parts;
  };
  // What a piece that is here has of a dynamic step.
  struct PieceMotion {
    int piece = 0;
    Vec mass;                      // kg, of its unknowns
    Points directions;             // 3 x n, of the same
    Vec velocity;                  // m/s, of the same; relative (Q0)
    Vec3 momentum = Vec3::Zero();  // kg m/s, where the carried motion asks for it, or parts that are not linked
    Points start;                  // m, displacements at the start of the step
    Points before;                 // m, since then, an increment before one that is sampled
    OctaveSamples octaves;
  };

  // Relative errors of frequencies that the mesh makes: at the mean frequency, with the square of the frequency; and of
  // all frequencies (eq. Q14).
  struct FrequencyShares {
    double dispersion = 0.0, of_all = 0.0;
  };

  // Of a substructure in the dynamic steps.
  struct PartMotion {
    double mass = 0.0;                   // kg
    double kinetic = 0.0, energy = 0.0;  // J, relative: now; largest so far, twice the kinetic or with the strain
    double left = 0.0, most_left = 0.0;  // J, work that the iteration leaves at its points, so far; largest
  };

  void accept_static(const Instant& instant);
  void watch_parts(const Instant& instant);
  std::vector<OfPart> of_parts(double energy) const;
  void take_velocities(const Instant& instant);
  void sample(const Instant& instant);
  void sample_strain(const Instant& instant, bool is_regular);
  void sample_stress(const Instant& instant, double strain, double weight);
  StrainEnergies strain_energies(const Instant& instant) const;
  StressEnergies stress_energies(const Instant& instant, double strain);
  double lumping_energy(const Instant& instant);
  FrequencyShares frequency_shares() const;
  void find_free_surfaces(const Instant& start);
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
  std::vector<PartMotion> parts_;  // in the dynamic steps
  bool starts_strained_ = false;   // the step
  double dt_ = 0.0, phase_factor_ = 1.0;
  PartViews* views_;
  std::vector<std::vector<Facet>> boundary_;  // of each substructure, once it has been asked for
  std::vector<std::vector<FreeCell>> free_;   // of its view, in the step
  std::vector<Points> start_;            // displacements of the views at the start of the dynamic step: what it adds is
                                         // the shock; empty in static ones
  double kinetic_now_ = 0.0;             // J, of the relative velocities, without parts in flight
  double kinetic_ = 0.0, stored_ = 0.0;  // J, largest so far: kinetic of the relative velocities; kinetic + strain
  double shock_energy_ = 0.0;            // J, largest of the samples: kinetic, and strain of the shock
  double stress_energy_ = 0.0;           // J, largest of the samples
  std::optional<double> strain_now_;     // J, of the shock, where the increment was sampled
  // Of the samples: energies of the stress error and of the shock (eq. Q6), and what of the kinetic energy is that of
  // lumped masses alone.
  StressEnergies sums_;
  double kinetic_sum_ = 0.0, lumping_sum_ = 0.0;
  double total_mass_ = 0.0;  // kg
  double lag_ = 0.0;         // s^2, of the diagonal mass of cells of order two (eq. Q12)
  // Sums over the same instants: of kinetic and strain energy of the motion (J), of strain energy of the velocities
  // (J/s^2).
  double moving_ = 0.0, strained_ = 0.0, rate_ = 0.0;
  int n_strained_ = 0;
  // Of springs (law, support) in the motion: now; sums over the same instants as moving_ and rate_; as kinetic_sum_.
  SpringEnergy springs_;
  double sprung_ = 0.0, sprung_rate_ = 0.0, sprung_sum_ = 0.0;
  double strain_at_stress_ = 0.0;  // J, of the step, the largest that the stress error has been sampled with
};

}  // namespace dygita
