// Sides that a tie or a law holds together have one velocity when a dynamic step begins (manual, eq. S5b): what was
// thrown at what it is joined to meets it in an impact. The time scheme would answer a difference with a jump that it
// closes again and again, which creates energy.
#pragma once

#include <string>

#include "step/step_model.hpp"

namespace dygita {

// Impulses between joined sides into the velocities of the state, whose pieces have it. A law that cannot give its
// impulse within one increment lets its sides go apart, from that rate on. Collective. Returns the interface whose
// sides were furthest from each other; empty: nothing has changed.
std::string join_velocities(const StepModel& model, State& state);

}  // namespace dygita
