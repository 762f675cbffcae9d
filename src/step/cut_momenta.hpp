// Momenta of explicit substructures that are cut and whose mass is tuned (manual, eq. S13).
#pragma once

#include "step/step_model.hpp"

namespace dygita {

// Gives their pieces, which have the state that a step starts from, the momenta of the substructure as a whole: M z
// with (M + C) z = M V, where copies of a node have one z and share its momentum by their masses. Collective.
void start_cut_momenta(const StepModel& model);

}  // namespace dygita
