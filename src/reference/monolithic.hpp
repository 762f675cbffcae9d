// The monolithic reference: the whole assembly in one implicit system, with the time scheme, meshes and laws of LATIN
// and none of its iteration (manual, "The monolithic reference"). For checks of LATIN and comparisons of speed.
#pragma once

#include "solution/observer.hpp"
#include "solution/solver_figures.hpp"

namespace dygita {

// Runs every step, each from the state the last one left. Throws InputError (also where a step has more unknowns under
// contact, plastic and shortened interfaces than the dense matrices are made for) and NumericalError; not converging is
// a result.
SolverFigures solve_monolithic(const Problem& problem, Observer& observer);

// One step of it from `state`, which is then what the step leaves; adds to `figures`.
void run_monolithic_step(const Problem& problem, const Step& step, const MonolithicSettings& settings,
                         const std::vector<Surface>& surfaces, const std::vector<Body>& bodies, State& state,
                         Observer& observer, SolverFigures& figures);

}  // namespace dygita
