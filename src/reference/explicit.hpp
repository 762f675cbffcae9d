// The classic explicit code (manual, "The explicit reference"): a rival of LATIN and an independent check. Static
// steps are the monolithic solver's.
#pragma once

#include "step/observer.hpp"
#include "step/solver_figures.hpp"

namespace dygita {

// Runs every step, each from the state the last one left. Throws InputError, NumericalError.
SolverFigures solve_explicit(const Problem& problem, Observer& observer);

// What a dynamic step would take.
struct ExplicitSize {
  int n_substeps = 0;     // of each increment
  double critical = 0.0;  // s
  double bytes = 0.0;
};
ExplicitSize predict_explicit(const Problem& problem, const Step& step, const std::vector<Surface>& surfaces,
                              const std::vector<Body>& bodies, const State& start);

}  // namespace dygita
