// The method: every step of a problem, the linear and the local stage alternating until they agree.
#pragma once

#include <map>
#include <string>

#include "solution/observer.hpp"

namespace dygita {

// What a run was, step by step.
struct StepFigures {
  int increments = 0, not_converged = 0;
  long iterations = 0;
  double worst_indicator = 0.0;  // largest accepted
  double seconds = 0.0;
};

struct SolverFigures {
  std::vector<StepFigures> steps;
  bool interrupted = false;
  long n_dofs = 0, n_interface_unknowns = 0;
  double factor_bytes = 0.0;    // factors and interface operators of the largest step
  double gap_difference = 0.0;  // m, largest between the laws' gaps and the displacements'
  std::map<std::string, double> seconds;  // by phase: set up, linear, iterate, output
};

// Runs every step, each from the state the last one left. Throws InputError and NumericalError; not converging is a result.
SolverFigures solve(const Problem& problem, Observer& observer);

}  // namespace dygita
