// The method: every step of a problem, the linear and the local stage alternating until they agree.
#pragma once

#include "solution/observer.hpp"
#include "solution/solver_figures.hpp"

namespace dygita {

// Runs every step, each from the state the last one left. `start_from`: interface fields of an earlier case, where the
// iteration of each increment starts (null: from the increment before). Throws InputError and NumericalError; not
// converging is a result.
SolverFigures solve(const Problem& problem, Observer& observer, const InterfaceFields* start_from = nullptr);

}  // namespace dygita
