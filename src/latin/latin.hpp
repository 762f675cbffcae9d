// The method: every step of a problem, the linear and the local stage alternating until they agree.
#pragma once

#include "solution/observer.hpp"
#include "solution/solver_figures.hpp"

namespace dygita {

// Runs every step, each from the state the last one left. Throws InputError and NumericalError; not converging is a result.
SolverFigures solve(const Problem& problem, Observer& observer);

}  // namespace dygita
