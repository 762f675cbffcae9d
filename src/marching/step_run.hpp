// One step from its start to its end: its data, its iteration, its books.
#pragma once

#include "marching/increments.hpp"
#include "marching/solve.hpp"

namespace dygita {

class StepRun {
 public:
  // The step has been started (start_step) and its pieces have search directions k (of the assembled q).
  StepRun(const StepSettings& settings, StepModel& model, const Vec& k, const RunFiles& files);

  void run();
  const StepFigures& figures() const { return books_.figures(); }
  void add_to(SolverFigures& figures);
  // Has the user stopped it within an increment, which then does not count?
  bool is_left_unsolved() const { return is_left_unsolved_; }

 private:
  void run_increments();

  StepData step_;
  Iteration iteration_;
  StepBooks books_;
  std::unique_ptr<Increments> increments_;
  bool is_left_unsolved_ = false;
};

}  // namespace dygita
