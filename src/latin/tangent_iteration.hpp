// Static steps with all pieces in one system: the linear stage takes the tangents of the laws as its search directions,
// and so knows what holds a part on the other side of its interfaces. An increment is then a few tens of iterations at
// most, however many parts are joined by contact alone (manual, eq. U1-U5).
#pragma once

#include "latin/indicator.hpp"
#include "step/assembled_system.hpp"
#include "step/tangent_steps.hpp"

namespace dygita {

// Newton's method on the interfaces, damped. Far from the solution the limits of friction are a step behind: what is
// solved in between is convex. Near it they follow.
class TangentIteration {
 public:
  // k: search directions, length n_q. The step's pieces are assembled ones. size: of the assembly, m.
  TangentIteration(const StepModel& model, LocalStage& local, const Vec& k, double size);

  // As AssembledSystem has it.
  void be_watched(std::function<void(const std::string&)> watch) { system_.be_watched(std::move(watch)); }
  // The usual linear stage: velocities for data q, F = q - k V.
  void linear_stage(const Vec& q, Vec& velocity);
  // Forgets the increment before. tolerance: of the indicator, which rounding is to leave within reach.
  void begin(double tolerance);
  // One iteration: from fields to those closer to a solution, in balance on return; the local stage's last `run` was of
  // these. outcome: their indicator.
  void advance(const Outcome& outcome, Vec& velocity, Vec& q);
  // What the last linear stage missed of the balance, of the largest force; below the indicator's tolerance it counts
  // for nothing.
  double imbalance() const { return system_.imbalance(); }
  // Gives the pieces the velocities of fields in balance, and answers their q: forces that belong to other velocities,
  // by rounding alone, would push a part that nothing holds.
  Vec finish(const Vec& velocity, const Vec& q);
  double bytes() const { return system_.bytes(); }
  // Points that answered otherwise in the last iteration than in the one before.
  int n_turned() const { return n_turned_; }
  const Vec& k() const { return k_; }

 private:
  double distance(const Vec& velocity, const Vec& q, const std::vector<double>& limits);
  void choose_tie(const Outcome& outcome);
  int take_tangents();
  void factorise();
  bool solve(Vec& velocity, Vec& force, double eta);
  void take_usual_factor();

  LocalStage* local_;
  AssembledSystem system_;
  Vec k_, image_;
  double least_;
  double factorised_softest_ = 0.0;
  double tolerance_ = 0.0;
  double tie_ = 0.0;  // stiffness of ties, for TangentBounds
  TangentSteps steps_;
  Tangents before_;      // of the last iteration; of none at the first
  Tangents factorised_;  // of the factor, of none where it is the usual one
  int n_turned_ = 0;
  int n_since_ = 0;     // points that have turned since
  int n_spent_ = 0;     // products beside it
  int most_since_ = 0;  // with so many a solve beside the factor may take fewer products than that costs
  bool has_usual_factor_ = false;
};

}  // namespace dygita
