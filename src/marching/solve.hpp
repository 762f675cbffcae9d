// The method: every step of a problem, the linear and the local stage alternating until they agree.
#pragma once

#include "step/observer.hpp"
#include "step/shared_operators.hpp"
#include "step/solver_figures.hpp"
#include "step/trail.hpp"

namespace dygita {

// What a run is given besides its problem: pieces and how they are shared out, and what it shares with other runs,
// whose first makes it (null: nothing).
struct Setting {
  SharePlan plan;
  SharedOperators* shared = nullptr;
};

// Runs every step, each from the state the last one left. `start_from`: interface fields of an earlier case or run,
// where the iteration of each increment starts (null: from the increment before). `trail`: replayed as far as it has
// entries, appended from there on (null: none). Throws InputError and NumericalError where nothing has been computed
// before; else they end the run, and the figures hold them. Not converging is a result.
SolverFigures solve(const Problem& problem, Observer& observer, StartFields start_from = {}, Trail* trail = nullptr,
                    const Setting& setting = {});

}  // namespace dygita
