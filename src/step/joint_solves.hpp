// The solves of an increment, of several runs that take turns (base/turns.hpp): members of an ensemble, whose pieces
// share their operators. An operator is then read once for all of them. A run by itself has none of this.
#pragma once

#include "base/turns.hpp"
#include "step/step_model.hpp"

namespace dygita {

namespace joint {

// Does this run take turns with others, which wait for each other's solves?
inline bool is_joint() { return Turns::at_hand() != nullptr; }

// Of the pieces that are here: forward or backward substitution; velocities at the interfaces for data q, of the near
// unknowns. What the pieces do without those operators is done as ever.
void forward(StepModel& model);
void backward(StepModel& model);
void interface_velocities(StepModel& model, const Vec& q, Vec& velocity);
// Roughly how the velocities change with data that change by so much (Piece::rough_change).
void rough_changes(StepModel& model, const Vec& change, Vec& velocity);

}  // namespace joint

}  // namespace dygita
