// An error in the middle of a run costs nothing of what came before it.
#pragma once

#include <exception>

#include "base/error.hpp"
#include "ranks/ranks.hpp"
#include "step/solver_figures.hpp"

namespace dygita {

// Runs a step; what ends it before its end (a load without a value, an iteration that diverges, no memory), or null.
// Throws where no increment of any step has been computed, and what an error of the program is.
template <class Run>
std::exception_ptr run_as_far_as_it_goes(Run& run, const SolverFigures& before) {
  try {
    run.run();
  } catch (const ContractError&) {
    throw;
  } catch (...) {
    if (!ranks::is_alone()) throw;  // the others do not know of it
    bool has_computed = run.figures().increments > 0;
    for (const StepFigures& step : before.steps) has_computed |= step.increments > 0;
    if (!has_computed) throw;
    return std::current_exception();
  }
  return nullptr;
}

}  // namespace dygita
