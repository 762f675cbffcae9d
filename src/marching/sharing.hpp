// What a run of several ranks reports about itself.
#pragma once

#include "interfaces/surfaces.hpp"
#include "partition/cut.hpp"
#include "ranks/ranks.hpp"
#include "step/solver_figures.hpp"

namespace dygita {

// Collective. What each rank had, sent and waited since `before`, to say and in the figures, whose pieces have their
// seconds where they are on this rank. Nothing where a process is alone.
void tell_ranks(const std::vector<Surface>& surfaces, const Cut& cut, const ranks::Traffic& before,
                SolverFigures& figures);

}  // namespace dygita
