// What a solver shows while it runs: every accepted increment, interiors on demand.
#pragma once

#include "solution/step_model.hpp"

namespace dygita {

struct Instant {
  const StepModel& model;
  const State& state;       // surfaces, energies and time are those of this instant; nodal fields come from the pieces
  int i_step = 0;           // index in the problem's steps
  int increment = -1;       // -1: the step's start
  int iterations = 0;
  double indicator = 0.0;
  bool converged = true;
  double interface_energy = 0.0;  // J, constitutive-relation error of the interfaces in this increment (manual, eq. Q1)

  double time() const { return state.time; }
  bool is_static() const { return model.scheme.is_static; }
  // 3 x n_nodes each: m, m/s, m/s^2 (mean over the increment).
  Points displacement(int part) const { return model.pieces[part]->displacement(); }
  Points velocity(int part) const {
    // What a static increment calls V is a displacement; the body rests.
    if (is_static()) return Points::Zero(3, model.problem->substructures[part]->mesh->n_nodes());
    return model.pieces[part]->velocity();
  }
  Points acceleration(int part) const { return model.pieces[part]->acceleration(); }
  // Force (N) on nodes of a substructure from whatever holds or moves them, mean over the increment.
  Points reactions(int part) const {
    return model.pieces[part]->reactions(interface_force(*model.surfaces, state, part));
  }
};

class Observer {
 public:
  virtual ~Observer() = default;
  virtual void begin_step(const Instant& start) = 0;
  virtual void accept(const Instant& instant) = 0;
};

}  // namespace dygita
