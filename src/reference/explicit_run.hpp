// One dynamic step of the explicit reference: central differences in substeps of its dt (manual, eq. X1-X3, X13).
#pragma once

#include "reference/critical_step.hpp"
#include "reference/inertial_laws.hpp"
#include "step/observer.hpp"
#include "step/solver_figures.hpp"

namespace dygita {

// What an explicit step leaves to the next beside the state.
struct ExplicitMemory {
  Vec internal;  // elastic force of the substructures, N; empty: that of their stiffness
  Vec first;     // the same when the first of the explicit steps began that follow one another; empty: none has
  Vec moved;     // displacement since then, m; empty: none
  Vec velocity;  // of the last substep, m/s: what the bulk viscosity resists; empty: none
};

// Which surfaces hold their sides together all through a step: ties that are not let go in it.
std::vector<char> tied_surfaces(const StepModel& model, const State& start);

class ExplicitRun : public NodalFields {
 public:
  // The state is that at the step's start (start_step is done).
  ExplicitRun(StepModel& model, const std::vector<Body>& bodies, InternalForce& internal, const ExplicitMemory& memory,
              State& state, Observer& observer);

  // Throws NumericalError when energy appears from nowhere.
  void run();
  // Leaves the state to the next step.
  void finish(ExplicitMemory& memory);

  int n_substeps() const { return n_substeps_; }
  double critical() const { return critical_; }
  double hourglass_share() const { return hourglass_share_; }  // largest, of all energy
  double bytes() const;
  const StepFigures& figures() const { return figures_; }

  Points displacement(int part) const override;
  Points velocity(int part) const override { return nodal(velocity_, part); }
  Points acceleration(int part) const override;
  Points reactions(int part) const override;
  Points absorbing_force(int part) const override;

 private:
  void start(const std::vector<Body>& bodies, const ExplicitMemory& memory);
  void find_mass_damping(const std::vector<Body>& bodies);
  void find_hourglass_force(const std::vector<Body>& bodies, const ExplicitMemory& memory);
  void find_start_forces(const ExplicitMemory& memory);
  void find_substeps();
  void collect_loads();
  void solve_increment(int increment);
  void apply_loads(double from, double to);
  void kick(double tau, double theta, double motion_share, double drift);
  void damp_masses(double tau);
  void evaluate_forces(double dt, bool has_energy);
  void accept(int increment);
  void book_energies();
  void check_stability(int increment) const;
  Points nodal(const Vec& all, int part) const;
  Instant instant(int increment) const;

  StepModel& model_;
  InternalForce& internal_;
  State& state_;
  const double start_time_;  // s
  Observer& observer_;
  int i_step_;
  std::vector<PointRecord> records_;
  PenaltySprings springs_;
  SharedNodes shared_;
  InertialLaws inertial_;
  int n_substeps_ = 1;
  double substep_ = 0.0, critical_ = 0.0;

  // By dof. moved_ is the displacement since the step's start; the forces of that instant are in prestress_.
  Vec moved_, velocity_, velocity_old_, last_velocity_, force_, external_, prestress_, mass_, inverse_mass_;
  Vec load_, anchor_,
      base_external_;  // of loaded dofs, what absorbing supports hold included; these alone; what balances the start
  std::vector<int> loaded_;
  std::vector<double> load_values_;
  std::vector<double> motions_old_, motions_new_;
  Vec mass_damping_;        // 1/s; empty: none
  Vec hourglass_force_;     // N, what the hourglass control has of prestress_; empty: nothing
  Vec resisted_, elastic_;  // internal force with damping, without (stiffness damping only)
  Vec before_;              // N, of prestress_ what explicit steps before this one have brought; empty: nothing

  double start_strain_ = 0.0, start_in_branches_ = 0.0, stored_ = 0.0, spring_energy_ = 0.0, supplied_ = 0.0;
  double start_hourglass_ = 0.0, hourglass_ = 0.0;
  CellEnergy cells_;                                                // stored ones now; dissipated in the increment
  double load_work_ = 0.0, drag_work_ = 0.0, internal_work_ = 0.0;  // of the increment
  double hourglass_share_ = 0.0;
  StepFigures figures_;
};

}  // namespace dygita
