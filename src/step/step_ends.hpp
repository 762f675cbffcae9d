// What a solver does before the first and after the last increment of a step.
#pragma once

#include "step/step_model.hpp"

namespace dygita {

// Gives the pieces the state the last step left; energy that a static step or a new support takes away is the scheme's,
// that of initial velocities the start's. A wall that is no longer a support lets go.
void start_step(StepModel& model, State& state);

// Writes displacements, velocities, what loads had reached and what absorbing supports hold into the state: the next
// step starts from it.
void end_step(const StepModel& model, State& state);

// Energies of an increment, one per substructure: what is stored now, what was exchanged.
void book_increment(const std::vector<IncrementEnergy>& increment, Energies& energies);

}  // namespace dygita
