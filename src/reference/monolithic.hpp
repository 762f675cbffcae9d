// The monolithic reference: the whole assembly in one implicit system, with the time scheme, meshes and laws of LATIN
// and none of its iteration (manual, "The monolithic reference"). For checks of LATIN and comparisons of speed.
#pragma once

#include <memory>

#include "step/observer.hpp"
#include "step/solver_figures.hpp"

namespace dygita {

// Runs every step, each from the state the last one left. Throws InputError (also where a step has more unknowns under
// contact, plastic and shortened interfaces than the dense matrices are made for) and NumericalError; not converging is
// a result.
SolverFigures solve_monolithic(const Problem& problem, Observer& observer);

struct AssemblyFactor;

// Its steps, one after the other; where the matrix is that of the step before so is the factor.
class MonolithicSteps {
 public:
  // All outlive this object.
  MonolithicSteps(const Problem& problem, const MonolithicSettings& settings, const std::vector<Surface>& surfaces,
                  const std::vector<Body>& bodies)
      : problem_(problem), settings_(settings), surfaces_(surfaces), bodies_(bodies) {}

  // From `state`, which is then what the step leaves; adds to `figures`.
  void run(const Step& step, State& state, Observer& observer, SolverFigures& figures);

 private:
  const Problem& problem_;
  const MonolithicSettings settings_;
  const std::vector<Surface>& surfaces_;
  const std::vector<Body>& bodies_;
  std::shared_ptr<const AssemblyFactor> factor_;
};

}  // namespace dygita
