// Numbers that overflow are caught in the increment in which they do, and where.
#pragma once

#include "step/step_model.hpp"

namespace dygita {

// Energies are sums over all that there is: where one is not finite, some number in the assembly is not. Throws
// NumericalError with step, increment, time, and the substructure or else the interface whose energies they are.
// pieces: of the increment, one a piece.
void check_energies(const StepModel& model, const State& state, const std::vector<IncrementEnergy>& pieces,
                    int increment);

}  // namespace dygita
